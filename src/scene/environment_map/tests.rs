//! Tests of an environment map's light against independent sums, and of hand-made files.

use std::{
    f64::consts::{PI, TAU},
    io::{Cursor, Write as _},
};

use exr::prelude::{Compression, WritableImage as _};
use glam::{DVec3, Vec3};
use mandelight_fuzzing::OPENEXR_COMPRESSIONS as COMPRESSIONS;
use proptest::prelude::*;

use super::*;

/// Pseudo-random numbers, 0 to 1.
fn noise(seed: u64) -> f64 {
    let mut bits = seed.wrapping_add(0x9e37_79b9_7f4a_7c15).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((bits ^ (bits >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A map of noise; 1 % of its pixels are 1000 times as bright.
fn speckled(size_px: [u32; 2]) -> EnvironmentMap {
    let mut i = 0;
    EnvironmentMap::from_fn("speckled", size_px, |_| {
        i += 3;
        let bright = if noise(i) > 0.99 { 1000.0 } else { 1.0 };
        DVec3::new(noise(i), noise(i + 1), noise(i + 2)) * bright
    })
}

/// A map's energy, with each pixel's solid angle integrated by Simpson's rule.
fn energy_of(environment_map: &EnvironmentMap) -> DVec3 {
    let [width, height] = environment_map.size_px();
    let (step, parts) = (PI / f64::from(height), 64);
    let sine = |y: f64| (y * step).sin();
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .map(|(x, y)| {
            let part = 1.0 / f64::from(parts);
            let sines: f64 = (0..parts)
                .map(|i| f64::from(y) + f64::from(i) * part)
                .map(|top| sine(top) + 4.0 * sine(top + part / 2.0) + sine(top + part))
                .sum();
            let solid_angle = sines * (step * part / 6.0) * TAU / f64::from(width);
            environment_map.pixels()[(y * width + x) as usize].as_dvec3() * solid_angle
        })
        .sum()
}

/// The largest relative error of a channel of `a` against `b`.
fn relative_error(a: DVec3, b: DVec3) -> f64 {
    ((a - b) / b).abs().max_element()
}

#[test]
fn uv_and_direction_conversions_are_inverse() {
    for (uv, direction) in [
        ([0.5, 0.5], DVec3::Y),
        ([0.75, 0.5], DVec3::X),
        ([0.25, 0.5], DVec3::NEG_X),
        ([0.5, 0.0], DVec3::Z),
        ([0.5, 1.0], DVec3::NEG_Z),
    ] {
        assert!((direction_from_uv(uv) - direction).length() < 1e-12, "{uv:?}");
    }
    for i in 0..100 {
        let uv = [noise(i), noise(i + 1000) * 0.98 + 0.01];
        let back = uv_from_direction(direction_from_uv(uv));
        assert!((0..2).all(|k| (uv[k] - back[k]).abs() < 1e-12), "{uv:?} {back:?}");
    }
}

#[test]
fn a_cut_preserves_the_maps_energy_for_every_count() {
    for size_px in [[64, 32], [7, 5], [1, 1], [200, 1], [1, 30]] {
        let environment_map = speckled(size_px);
        let whole = energy_of(&environment_map);
        assert!(relative_error(environment_map.energy(), whole) < 1e-6, "{size_px:?}");
        for count in (1..=64).chain([200, 5000]) {
            let lights = environment_map.cut(count);
            let sum: DVec3 = lights.iter().map(|light| light.energy).sum();
            assert!(relative_error(sum, environment_map.energy()) < 1e-5, "{size_px:?} in {count}");
            let pixels = (size_px[0] * size_px[1]) as usize;
            assert!(lights.len() == count.min(pixels), "{} of {count}", lights.len());
            assert!(lights.iter().all(|light| (light.direction.length() - 1.0).abs() < 1e-9));
        }
    }
}

#[test]
fn a_white_map_lights_every_orientation_equally() {
    let white = EnvironmentMap::from_fn("white", [256, 128], |_| DVec3::ONE);
    let irradiance = |count: usize, normal: DVec3| {
        let lights = white.cut(count);
        lights
            .iter()
            .map(|light| light.energy.x * normal.dot(light.direction).max(0.0))
            .sum::<f64>()
    };
    let worst = |count: usize| {
        (0..200)
            .map(|i| direction_from_uv([noise(i), (1.0 - 2.0 * noise(i + 500)).acos() / PI]))
            .map(|normal| (irradiance(count, normal) / PI - 1.0).abs())
            .fold(0.0, f64::max)
    };
    // The irradiance is π for every normal. A light crosses the horizon at once, its region
    // gradually, so few lights have a larger error.
    assert!(worst(64) < 0.03, "{}", worst(64));
    assert!(worst(16) < 0.2, "{}", worst(16));
}

#[test]
fn a_small_sun_gets_exactly_one_light_within_a_pixel() {
    let size_px = [512, 256];
    for (x, y) in [(100, 60), (0, 128), (511, 20), (300, 250)] {
        let sun = direction_from_uv([(f64::from(x) + 0.5) / 512.0, (f64::from(y) + 0.5) / 256.0]);
        let environment_map = EnvironmentMap::from_fn("sun", size_px, |direction| {
            let is_sun = direction.dot(sun) > 1.0 - 1e-9;
            DVec3::splat(if is_sun { 50_000.0 } else { 0.2 })
        });
        let sun_energy = 50_000.0 * environment_map.pixel_solid_angle(y);
        for count in [8, 16, 64] {
            let lights = environment_map.cut(count);
            let near: Vec<_> = lights
                .iter()
                .filter(|light| (light.direction - sun).length() < PI / 256.0)
                .collect();
            assert_eq!(near.len(), 1, "{count} lights, sun at {x}, {y}");
            assert!(near[0].energy.x > 0.99 * sun_energy && near[0].energy.x < 1.3 * sun_energy);
        }
    }
}

/// A pixel at a pole has a smaller solid angle than a pixel at the equator.
#[test]
fn pixels_near_the_poles_are_weighted_by_their_solid_angle() {
    let white = EnvironmentMap::from_fn("white", [256, 128], |_| DVec3::ONE);
    let near_pole = |lights: &[CutLight]| {
        lights.iter().filter(|l| l.direction.z > 0.866).map(|l| l.energy.x).sum::<f64>()
    };
    // The cap within 30 degrees of the pole has 6.7 % of the sphere, but 16.7 % of the rows.
    let part = near_pole(&white.cut(64)) / (4.0 * PI);
    assert!((part - 0.067).abs() < 0.035, "{part}");
    // A bright cap's energy must equal the integral, not the share of its pixels.
    let cap = EnvironmentMap::from_fn("cap", [64, 32], |direction| {
        DVec3::splat(if direction.z > 0.9 { 10.0 } else { 0.0 })
    });
    let rows = (0..32).filter(|y| (PI * (f64::from(*y) + 0.5) / 32.0).cos() > 0.9).count() as f64;
    let expected = 10.0 * TAU * (1.0 - (PI * rows / 32.0).cos());
    let sum: DVec3 = cap.cut(16).iter().map(|light| light.energy).sum();
    assert!(relative_error(sum, DVec3::splat(expected)) < 1e-5, "{sum} {expected}");
}

#[test]
fn black_pixels_give_no_lights() {
    let black = EnvironmentMap::from_fn("black", [16, 8], |_| DVec3::ZERO);
    assert!(black.cut(16).is_empty());
    let one = EnvironmentMap::from_fn("one", [16, 8], |direction| {
        if direction.dot(direction_from_uv([8.5 / 16.0, 2.5 / 8.0])) > 0.999 {
            DVec3::X
        } else {
            DVec3::ZERO
        }
    });
    assert_eq!(one.cut(16).len(), 1);
    assert!(speckled([8, 4]).cut(0).is_empty());
}

#[test]
fn downsampling_preserves_the_energy() {
    for source_px in [[4096, 2048], [3000, 1500], [2049, 1025], [2048, 1024], [5000, 3]] {
        let mut downsampler = Downsampler::new(source_px);
        let mut expected = DVec3::ZERO;
        for y in 0..source_px[1] {
            let polar = |y: f64| (y / f64::from(source_px[1]) * PI).cos();
            let solid_angle =
                (polar(y.into()) - polar(f64::from(y) + 1.0)) * TAU / f64::from(source_px[0]);
            let mut row = Vec::new();
            for x in 0..source_px[0] {
                let seed = u64::from(y) * 8192 + u64::from(x);
                let pixel = DVec3::new(noise(seed), noise(seed + 1), 1.0).as_vec3();
                row.push(pixel);
                expected += pixel.as_dvec3() * solid_angle;
            }
            // In two pieces, as tiles come.
            let (left, right) = row.split_at(row.len() / 3);
            downsampler.add_row([left.len() as u32, y], right.iter().copied());
            downsampler.add_row([0, y], left.iter().copied());
        }
        let environment_map = downsampler.finish("large");
        assert!((0..2).all(|i| environment_map.size_px()[i] == source_px[i].min(MAX_SIZE_PX[i])));
        assert!(relative_error(environment_map.energy(), expected) < 1e-5, "{source_px:?}");
        // A constant channel stays constant: the weights of every target pixel sum to 1.
        assert!(environment_map.pixels().iter().all(|pixel| (pixel.z - 1.0).abs() < 1e-5));
    }
}

/// An uncompressed Radiance file from each pixel's mantissas and exponent.
fn flat_radiance(size_px: [u32; 2], header: &str, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Vec<u8> {
    let [width, height] = size_px;
    let mut bytes = Vec::new();
    write!(bytes, "#?{header}\n\n-Y {height} +X {width}\n").unwrap();
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (x, y)))
        .for_each(|(x, y)| bytes.extend(pixel(x, y)));
    bytes
}

fn exr_file(
    size: [usize; 2],
    compression: Compression,
    pixel: impl Fn(usize, usize) -> (f32, f32, f32) + Sync,
) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let channels =
        exr::prelude::SpecificChannels::rgb(|at: exr::prelude::Vec2<usize>| pixel(at.x(), at.y()));
    let encoding = exr::prelude::Encoding {
        compression,
        blocks: exr::prelude::Blocks::ScanLines,
        line_order: exr::prelude::LineOrder::Increasing,
    };
    let name = exr::prelude::LayerAttributes::named("environment map");
    let layer = exr::prelude::Layer::new((size[0], size[1]), name, encoding, channels);
    exr::prelude::Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

#[test]
fn a_radiance_file_decodes_to_its_values() {
    // mantissa / 256 · 2^(exponent − 128)
    let bytes = flat_radiance([20, 10], "RADIANCE\nFORMAT=32-bit_rle_rgbe", |x, y| {
        [128, x as u8 * 10, 64, 129 + (y % 3) as u8]
    });
    let environment_map = decode("a.hdr", &bytes).unwrap();
    assert_eq!((environment_map.name(), environment_map.size_px()), ("a.hdr", [20, 10]));
    for (i, pixel) in environment_map.pixels().iter().enumerate() {
        let (x, y) = (i % 20, i / 20);
        let scale = f32::from(2u8.pow((y % 3) as u32));
        let expected = Vec3::new(1.0, x as f32 * 10.0 / 128.0, 0.5) * scale;
        assert!((*pixel - expected).length() < 1e-4 * scale, "{x}, {y}: {pixel} {expected}");
    }
    // EXPOSURE divides the stored values; the signature RGBE is accepted too.
    let scaled = flat_radiance([2, 1], "RGBE\nEXPOSURE=4", |_, _| [128, 128, 128, 129]);
    assert_eq!(decode("b.hdr", &scaled).unwrap().pixels(), [Vec3::splat(0.25); 2]);
}

#[test]
fn an_openexr_file_decodes_to_its_values() {
    let value = |x: usize, y: usize| (x as f32 * 0.5, y as f32 + 0.25, 1000.0);
    for compression in COMPRESSIONS {
        let environment_map = decode("a.exr", &exr_file([12, 6], compression, value)).unwrap();
        assert_eq!(environment_map.size_px(), [12, 6]);
        for (i, pixel) in environment_map.pixels().iter().enumerate() {
            let (r, g, b) = value(i % 12, i / 12);
            // PXR24 keeps 24 bits of each number; DWAA and DWAB are lossy by perceptual criteria.
            let is_lossy = matches!(compression, Compression::DWAA(_) | Compression::DWAB(_));
            let tolerance = if is_lossy { 30.0 } else { 0.02 };
            let off = (*pixel - Vec3::new(r, g, b)).length();
            assert!(off < tolerance, "{compression}, {i}: {pixel}");
        }
    }
}

#[test]
fn nan_negative_and_infinite_values_are_clamped() {
    let odd = [f32::NAN, -3.0, f32::INFINITY, 2.0];
    let bytes = exr_file([4, 1], Compression::ZIP16, |x, _| (odd[x], odd[x], 1.0));
    let environment_map = decode("odd.exr", &bytes).unwrap();
    let kept: Vec<f32> = environment_map.pixels().iter().map(|pixel| pixel.x).collect();
    assert!(
        kept.iter()
            .zip([0.0, 0.0, MAX_RADIANCE, 2.0])
            .all(|(a, b)| (a - b).abs() < 1e-2 * b.max(0.1)),
        "{kept:?}"
    );
    assert!(environment_map.energy().is_finite());
}

#[test]
fn decoding_errors_name_the_files_fault() {
    let huge = b"#?RADIANCE\n\n-Y 100000 +X 100000\n";
    assert_eq!(decode("h", huge), Err(DecodeError::Size([100_000, 100_000])));
    assert!(matches!(decode("h", b"#?RADIANCE\n\n-Y 0 +X 7\n"), Err(DecodeError::Size(_))));
    assert_eq!(decode("h", b"GIF89a"), Err(DecodeError::Format));
    assert_eq!(decode("h", b""), Err(DecodeError::Format));
    for header in ["RADIANCE\nEXPOSURE=0", "RADIANCE\nEXPOSURE=-1", "RADIANCE\nEXPOSURE=inf"] {
        let bytes = flat_radiance([2, 1], header, |_, _| [1; 4]);
        assert!(matches!(decode("h", &bytes), Err(DecodeError::Unreadable(_))), "{header}");
    }
    let whole = flat_radiance([20, 10], "RADIANCE", |x, y| [x as u8, y as u8, 9, 128]);
    let error = decode("h", &whole[..whole.len() - 1]).unwrap_err();
    assert!(error.to_string().starts_with("the picture cannot be read"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn damaged_files_decode_or_fail_without_a_panic(
        compression in 0..2 * COMPRESSIONS.len(),
        length in 0.0..=1.0_f64,
        changes in proptest::collection::vec((0.0..1.0_f64, any::<u8>()), 0..6),
    ) {
        let mut bytes = if let Some(compression) = COMPRESSIONS.get(compression) {
            exr_file([9, 5], *compression, |x, y| (x as f32, y as f32, 0.5))
        } else {
            flat_radiance([9, 5], "RADIANCE", |x, y| [x as u8, y as u8, 9, 128])
        };
        for (at, value) in changes {
            let at = (at * bytes.len() as f64) as usize;
            bytes[at] = value;
        }
        bytes.truncate((length.sqrt() * bytes.len() as f64).ceil() as usize);
        let decoded = decode("damaged", &bytes);
        if let Err(error) = &decoded {
            // What a panic of the crate becomes; on the web it would end the page.
            prop_assert!(!error.to_string().contains("cannot be unpacked"));
        }
        if let Ok(environment_map) = decoded {
            prop_assert!(environment_map.energy().is_finite());
            let [width, height] = environment_map.size_px();
            prop_assert_eq!(environment_map.pixels().len(), (width * height) as usize);
        }
    }
}

#[test]
fn maps_of_pixels_are_clamped_and_have_as_many_as_their_size_says() {
    let map = |size_px, pixels| EnvironmentMap::from_pixels("a", size_px, pixels);
    let pixels = vec![Vec3::new(f32::NAN, -1.0, f32::INFINITY), Vec3::ONE];
    let clamped = map([2, 1], pixels.clone()).expect("a map");
    assert_eq!(clamped.pixels(), [Vec3::new(0.0, 0.0, MAX_RADIANCE), Vec3::ONE]);
    for size_px in [[1, 1], [2, 2], [0, 2], [1 << 16, 1 << 16], [u32::MAX, u32::MAX]] {
        assert_eq!(map(size_px, pixels.clone()), None, "{size_px:?}");
    }
}
