//! Gradient files of each program, and bad ones.

use super::*;
use crate::scene::{
    MAX_GRADIENT_STOPS,
    color::{gradient_at, srgb_from_linear},
};

/// The sRGB colour of a gradient, 0 to 255.
fn at(gradient: &NamedGradient, u: f64) -> [i32; 3] {
    gradient_at(&gradient.stops, u)
        .map(|channel| (255.0 * srgb_from_linear(channel)).round() as i32)
}

#[track_caller]
fn assert_color(gradient: &NamedGradient, u: f64, expected: [i32; 3]) {
    let found = at(gradient, u);
    let is_near = (0..3).all(|i| (found[i] - expected[i]).abs() <= 2);
    assert!(is_near, "{found:?} at {u}, expected {expected:?}");
}

#[test]
fn maps_have_a_colour_in_each_line() {
    let smooth: String = (0..256).map(|i| format!("{i} {} 40 comment\n", 255 - i)).collect();
    let [map] = &read(smooth.as_bytes(), "smooth").unwrap()[..] else { panic!("one gradient") };
    assert_eq!(map.name, "smooth");
    assert!(map.stops.len() < MAX_GRADIENT_STOPS, "{} stops", map.stops.len());
    for i in [0, 17, 100, 200, 255] {
        assert_color(map, f64::from(i) / 256.0, [i, 255 - i, 40]);
    }
    let [two] = &read(b"255 0 0\r\n0 0 255\r\n", "two").unwrap()[..] else { panic!("one") };
    assert_color(two, 0.0, [255, 0, 0]);
    assert_color(two, 0.5, [0, 0, 255]);
}

#[test]
fn palettes_have_names_and_comments() {
    let text = "GIMP Palette\nName: Two tones\nColumns: 2\n# made by hand\n  0 128 255\tSky\n255 128   0\n";
    let [palette] = &read(text.as_bytes(), "file").unwrap()[..] else { panic!("one") };
    assert_eq!((palette.name.as_str(), palette.stops.len()), ("Two tones", 2));
    assert_color(palette, 0.0, [0, 128, 255]);
    assert_color(palette, 0.5, [255, 128, 0]);
}

#[test]
fn segments_blend_as_their_kind_says() {
    // Linear with its middle at a quarter, then a step, then from red to blue around the hues.
    let text = "GIMP Gradient\nName: Three\n3\n\
        0.0 0.125 0.5 0 0 0 1 1 1 1 1 0 0 0 0\n\
        0.5 0.6 0.75 1 0 0 1 0 1 0 1 5 0 0 0\n\
        0.75 0.875 1.0 1 0 0 1 0 0 1 1 0 1 0 0\n";
    let [gradient] = &read(text.as_bytes(), "file").unwrap()[..] else { panic!("one") };
    assert_eq!(gradient.name, "Three");
    assert_color(gradient, 0.125, [128, 128, 128]);
    assert_color(gradient, 0.3125, [191, 191, 191]);
    assert_color(gradient, 0.55, [255, 0, 0]);
    assert_color(gradient, 0.7, [0, 255, 0]);
    // A third of the way around is green: halfway to blue by way of yellow, green and cyan.
    assert_color(gradient, 0.875, [0, 255, 0]);
}

#[test]
fn control_points_wrap_at_400() {
    let text = "first {\ngradient:\n  title=\"First\" smooth=no\n  index=100 color=255\n  index=300 color=16711680\n\
        opacity:\n  smooth=no index=0 opacity=255\n}\nsecond {\ngradient:\n index=-200 color=65280\n}\n";
    let found = read(text.as_bytes(), "file").unwrap();
    let names: Vec<_> = found.iter().map(|gradient| gradient.name.as_str()).collect();
    assert_eq!(names, ["first", "second"]);
    assert_color(&found[0], 0.25, [255, 0, 0]);
    assert_color(&found[0], 0.75, [0, 0, 255]);
    // The same distance from both, before and behind the seam.
    assert_color(&found[0], 0.5, [128, 0, 128]);
    assert_color(&found[0], 0.0, [128, 0, 128]);
    assert_color(&found[1], 0.9, [0, 255, 0]);
}

#[test]
fn bad_files_give_an_error_that_names_the_line() {
    let message = |text: &str| read(text.as_bytes(), "file").unwrap_err().to_string();
    assert!(message("").starts_with("no gradient found"));
    assert!(message("{ \"version\": 2 }").starts_with("no gradient found"));
    assert_eq!(message("1 2 3\n4 5 x\n"), "line 2: expected three numbers from 0 to 255");
    assert_eq!(message("1 2 3\n4 5 256\n"), "line 2: expected three numbers from 0 to 255");
    assert!(message("GIMP Gradient\n1\n0 0.5 0.2 0 0 0 1 1 1 1 1 0 0").starts_with("line 3: "));
    assert!(message(&"1 2 3\n".repeat(257)).starts_with("line 257: "));
    assert!(matches!(
        read(&vec![b' '; MAX_FILE_BYTES + 1], "file"),
        Err(GradientFileError::TooLarge(_))
    ));
}

#[test]
fn colours_beyond_the_stops_still_fit_roughly() {
    let noise: String = (0..256_u32)
        .map(|i| format!("{} {} {}\n", i * 97 % 256, i * 57 % 256, i * 31 % 256))
        .collect();
    let found = read(noise.as_bytes(), "noise").unwrap();
    assert_eq!(found[0].stops.len(), MAX_GRADIENT_STOPS);
}

#[test]
fn neighbouring_segments_share_their_ends() {
    // Of these decimals, left + (right - left) is greater than right.
    let text = "GIMP Gradient\nName: Narrow\n3\n\
        0.0 0.0005 0.001 0 0 0 1 0 0 0 1 0 0\n\
        0.001 0.005 0.009 0 0 0 1 1 1 1 1 0 0\n\
        0.009 0.5 1.0 1 1 1 1 0 0 0 1 0 0\n";
    let found = read(text.as_bytes(), "file");
    assert!(found.is_ok(), "{found:?}");
}

#[test]
fn long_files_are_refused_by_their_line() {
    let palette = "GIMP Palette\n".to_owned() + &"1 2 3\n".repeat(MAX_COLORS + 1);
    let segments = "GIMP Gradient\n1\n".to_owned()
        + &"0.5 0.5 0.5 0 0 0 1 1 1 1 1 0 0\n".repeat(MAX_SEGMENTS + 1);
    for (text, line, most) in
        [(palette, MAX_COLORS + 2, MAX_COLORS), (segments, MAX_SEGMENTS + 3, MAX_SEGMENTS)]
    {
        let error = read(text.as_bytes(), "file").expect_err("too long");
        assert!(error.to_string().starts_with(&format!("line {line}:")), "{error}");
        assert!(error.to_string().contains(&format!("at most {most} ")), "{error}");
    }
}
