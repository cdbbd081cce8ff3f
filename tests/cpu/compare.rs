//! The comparison of pictures: it finds one small wrong patch wherever that lies, and lets rounding
//! and a few grazing rays pass.

use mandelight_test_support::{
    compare::{SAME, complaint},
    random::Random,
};

const SIZE: [u32; 2] = [61, 43];

/// A smooth picture.
fn picture() -> Vec<u8> {
    let pixel = |i: u32| {
        let (x, y) = (i % SIZE[0], i / SIZE[0]);
        [60 + 2 * x as u8, 40 + 3 * y as u8, (x + y) as u8, 255]
    };
    (0..SIZE[0] * SIZE[1]).flat_map(pixel).collect()
}

/// The picture with `steps` added to a square of `side` pixels at `at`.
fn patched([left, top]: [u32; 2], side: u32, steps: u8) -> Vec<u8> {
    let mut bytes = picture();
    for (y, x) in (top..top + side).flat_map(|y| (left..left + side).map(move |x| (y, x))) {
        bytes[4 * (y * SIZE[0] + x) as usize] += steps;
    }
    bytes
}

fn corners(side: u32) -> impl Iterator<Item = [u32; 2]> {
    let [right, bottom] = SIZE.map(|length| length - side);
    (0..=bottom).flat_map(move |y| (0..=right).map(move |x| [x, y]))
}

#[test]
fn a_patch_of_three_by_three_wrong_pixels_is_found_wherever_it_lies() {
    for at in corners(3).step_by(7) {
        assert!(complaint(&picture(), &patched(at, 3, 20), SIZE, SAME).is_some(), "{at:?}");
    }
}

#[test]
fn a_slightly_wrong_region_is_found_wherever_it_lies() {
    // No pixel of it differs notably.
    for at in corners(8).step_by(7) {
        let found = complaint(&picture(), &patched(at, 8, 12), SIZE, SAME);
        assert!(found.is_some_and(|text| text.contains(" 0 that differ notably")), "{at:?}");
    }
}

#[test]
fn many_scattered_wrong_pixels_are_found() {
    let mut bytes = picture();
    for i in (0..bytes.len()).step_by(4 * 80) {
        bytes[i] ^= 0x80;
    }
    let found = complaint(&picture(), &bytes, SIZE, SAME).expect("a complaint");
    assert!(found.contains("of 2623 pixels"), "{found}");
}

#[test]
fn rounding_and_a_few_grazing_rays_pass() {
    let (mut bytes, mut random) = (picture(), Random(0x9A5_5E5));
    for byte in &mut bytes {
        *byte -= (3.0 * random.unit()) as u8;
    }
    for i in [200, 1300, 2500] {
        bytes[4 * i + 1] = 255;
    }
    assert_eq!(complaint(&picture(), &bytes, SIZE, SAME), None);
}

#[test]
fn pictures_of_different_sizes_differ() {
    assert!(complaint(&picture(), &picture()[4..], SIZE, SAME).is_some());
}
