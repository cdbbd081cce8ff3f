//! Radiance pictures: environment maps.

use mandelight::scene::environment_map::{EnvironmentMap, MAX_RADIANCE, MAX_SIZE_PX, decode};

use crate::{FuzzTarget, InputFormat, Outcome, promises::refused};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "radiance",
    check,
    seeds,
    format: InputFormat::Radiance,
    hundreds: 110,
    most_work: 64 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    match decode("a", bytes) {
        Ok(map) => {
            map_holds(&map);
            Outcome::Read
        }
        Err(error) => refused(&error),
    }
}

/// A map that was read is within its limits, and every value is a number.
pub fn map_holds(map: &EnvironmentMap) {
    let [width, height] = map.size_px();
    assert!((1..=MAX_SIZE_PX[0]).contains(&width) && (1..=MAX_SIZE_PX[1]).contains(&height));
    assert_eq!(map.pixels().len(), width as usize * height as usize);
    let is_radiance = |value: f32| (0.0..=MAX_RADIANCE).contains(&value);
    assert!(map.pixels().iter().all(|pixel| pixel.to_array().into_iter().all(is_radiance)));
}

/// Pictures of each way to store pixels.
fn seeds() -> Vec<Vec<u8>> {
    let flat = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 3\n".to_vec();
    let flat = [flat, (0..24).map(|i| 100 + i * 3).collect()].concat();
    let exposed =
        b"#?RGBE\n# by hand\nEXPOSURE=2.5\nGAMMA=1\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    let exposed = [&exposed[..], &[1, 2, 3, 128, 9, 8, 7, 130]].concat();
    // A pixel, and twice how often it is repeated.
    let repeated = b"#?RADIANCE\n\n-Y 1 +X 514\n".to_vec();
    let repeated = [repeated, vec![9, 8, 7, 130, 1, 1, 1, 1, 1, 1, 1, 2]].concat();
    let mut runs = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 20\n".to_vec();
    for row in 0..3 {
        runs.extend([2, 2, 0, 20]);
        for channel in 0..4 {
            // A run of 12, then 8 single values.
            runs.extend([128 + 12, 120 + row + channel, 8]);
            runs.extend((0..8).map(|i| 110 + 3 * i));
        }
    }
    vec![flat, exposed, repeated, runs]
}
