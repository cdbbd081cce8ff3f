//! What the kernels make of a film, against the oracle: mean, histogram, tone curves, bloom.

use glam::DVec3;
use mandelight::{
    render::{Eyes, Region},
    scene::{Bloom, BloomOrder, Scene, Tone, ToneChannels, ToneCurve, ToneMean},
};
use mandelight_test_support::{
    oracle::{bloom, light::srgb, tone},
    random::Random,
};

use super::film::Film;

/// Sizes that mip levels by halves get wrong, and a few that they get right.
const SIZES: [[u32; 2]; 7] = [[1, 1], [5, 1], [1, 9], [7, 3], [16, 16], [101, 67], [129, 65]];

const CURVES: [ToneCurve; 5] = [
    ToneCurve::Linear,
    ToneCurve::Reinhard,
    ToneCurve::Aces,
    ToneCurve::Agx,
    ToneCurve::KhronosNeutral,
];

fn toned_by(tone: Tone, bloom: Bloom) -> Scene {
    Scene { tone, bloom, ..Scene::default() }
}

fn count(size_px: [u32; 2]) -> usize {
    (size_px[0] * size_px[1]) as usize
}

/// Colours over twelve stops, brighter to the right, with some black and some much brighter.
fn varied(size_px: [u32; 2]) -> Vec<[f32; 3]> {
    let mut random = Random(0xC0_10_12);
    (0..count(size_px))
        .map(|i| {
            let right = f64::from(i as u32 % size_px[0]) / f64::from(size_px[0]);
            let level = match i % 53 {
                7 => 0.0,
                29 => 60.0,
                _ => (8.0 * right + 4.0 * random.unit() - 9.0).exp2(),
            };
            [0; 3].map(|_| (level * (0.5 + random.unit())) as f32)
        })
        .collect()
}

fn wide(color: &[f32; 3]) -> DVec3 {
    DVec3::from_array(color.map(f64::from))
}

fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

#[test]
fn the_mean_is_that_of_all_pixels_whatever_the_size() {
    for size_px in SIZES {
        let colors = varied(size_px);
        let found = Film::new(size_px).tone(&Scene::default(), &colors).statistics;
        let n = colors.len() as f64;
        let mean = colors.iter().map(wide).sum::<DVec3>() / n;
        for (found, expected) in wide(&found.mean).to_array().into_iter().zip(mean.to_array()) {
            let error = (found - expected).abs();
            assert!(error <= 1e-5 * expected, "{size_px:?}: {found} for {expected}");
        }
        let log2 = colors.iter().map(|c| (luminance(wide(c)) + 1e-4).log2()).sum::<f64>() / n;
        assert!((f64::from(found.mean_log2) - log2).abs() < 1e-4, "{size_px:?}");
    }
}

/// Wrong weights at the right and lower edges would let pixels there count for more, or less.
#[test]
fn a_bright_pixel_counts_the_same_wherever_it_is() {
    for size_px in SIZES {
        let film = Film::new(size_px);
        let [width, height] = size_px.map(|side| side as usize);
        let places = |side: usize| {
            let mut places = vec![0, 1, 3, 4, side / 2, side.saturating_sub(2), side - 1];
            places.retain(|place| *place < side);
            places.dedup();
            places
        };
        let expected = 1000.0 / count(size_px) as f64;
        for y in places(height) {
            for x in places(width) {
                let mut colors = vec![[0.0; 3]; count(size_px)];
                colors[y * width + x] = [1000.0; 3];
                let mean = film.tone(&Scene::default(), &colors).statistics.mean[1];
                let error = (f64::from(mean) / expected - 1.0).abs();
                assert!(error < 1e-5, "{size_px:?} at {x}, {y}: {mean} for {expected}");
            }
        }
    }
}

#[test]
fn auto_exposure_brings_the_mean_to_the_key() {
    let size_px = [101, 67];
    let (film, colors) = (Film::new(size_px), varied(size_px));
    let wide: Vec<_> = colors.iter().map(wide).collect();
    let n = wide.len() as f64;
    for (mean, expected) in [
        (ToneMean::Arithmetic, luminance(wide.iter().sum::<DVec3>() / n)),
        (
            ToneMean::Logarithmic,
            (wide.iter().map(|c| (luminance(*c) + 1e-4).ln()).sum::<f64>() / n).exp(),
        ),
    ] {
        for key in [0.01, 0.18, 1.0] {
            let tone = Tone { auto_exposure: true, mean, key, ..Tone::default() };
            let found = film.tone(&toned_by(tone, Bloom::default()), &colors).statistics;
            let factor = f64::from(found.adapted_stops).exp2();
            assert!((factor * expected / key - 1.0).abs() < 1e-4, "{mean:?}, key {key}");
        }
    }
}

/// Nothing of a film can keep exposure from being a number.
#[test]
fn black_and_blinding_films_are_exposed_within_bounds() {
    let film = Film::new([9, 6]);
    for mean in [ToneMean::Arithmetic, ToneMean::Logarithmic] {
        for value in [0.0, 1e-30, 1e28] {
            let tone = Tone { auto_exposure: true, mean, ..Tone::default() };
            let scene = toned_by(tone, Bloom { strength: 0.5, ..Bloom::default() });
            let toned = film.tone(&scene, &[[value; 3]; 54]);
            assert!(toned.statistics.adapted_stops.abs() <= 20.0, "{value}");
            let white = if value > 1.0 { 255.0 } else { 0.0 };
            assert!(toned.display.iter().all(|c| (c.x - white).abs() <= 1.0), "{mean:?} {value}");
        }
    }
}

/// One pixel that is no number spoils neither exposure nor the light around it.
#[test]
fn a_pixel_that_is_no_number_stays_alone() {
    let size_px = [40, 24];
    let film = Film::new(size_px);
    let tone = Tone { auto_exposure: true, ..Tone::default() };
    let scene = toned_by(tone, Bloom { strength: 0.5, threshold: 0.0, ..Bloom::default() });
    let mut colors = varied(size_px);
    colors[500] = [0.0; 3];
    let expected = film.tone(&scene, &colors);
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        colors[500] = [bad; 3];
        let found = film.tone(&scene, &colors);
        assert_eq!(found.statistics, expected.statistics, "{bad}");
        assert_eq!(found.display[..500], expected.display[..500], "{bad}");
        assert_eq!(found.display[501..], expected.display[501..], "{bad}");
    }
}

#[test]
fn the_histogram_counts_every_pixel_in_its_bin() {
    for size_px in SIZES {
        let mut random = Random(0xB1_45);
        let mut expected = [0_u32; 128];
        let colors: Vec<_> = (0..count(size_px))
            .map(|_| {
                // Inside of a bin, so that no rounding moves it into the next.
                let bin = (random.unit() * 140.0 - 6.0).floor();
                let stops = (bin + 0.2 + 0.6 * random.unit()) / 5.0 - 14.0;
                expected[bin.clamp(0.0, 127.0) as usize] += 1;
                [stops.exp2() as f32; 3]
            })
            .collect();
        let found = *Film::new(size_px).tone(&Scene::default(), &colors).statistics.bins;
        assert_eq!(found, expected, "{size_px:?}");
        assert_eq!(found.iter().sum::<u32>() as usize, count(size_px));
    }
}

/// What each curve makes of colours, as f32: in squares of 4×4 pixels, whose means the bloom's
/// finest level holds when all light spreads and the kernel is narrower than an element.
fn mapped(tone: Tone, colors: &[DVec3]) -> Vec<DVec3> {
    let bloom =
        Bloom { strength: 1.0, order: BloomOrder::After, radius: 0.005, threshold: 0.0, passes: 1 };
    let size_px = [4 * colors.len() as u32, 4];
    let row = colors.iter().flat_map(|c| [c.as_vec3().to_array(); 4]);
    let pixels: Vec<_> = std::iter::repeat_n(row, 4).flatten().collect();
    let mut mips = Film::new(size_px).tone(&toned_by(tone, bloom), &pixels).mips;
    mips.truncate(colors.len());
    mips
}

fn tones() -> impl Iterator<Item = Tone> {
    CURVES.into_iter().flat_map(|curve| {
        [ToneChannels::Luminance, ToneChannels::PerChannel].map(|channels| Tone {
            curve,
            channels,
            ..Tone::default()
        })
    })
}

#[test]
fn tone_curves_are_those_of_their_definitions() {
    let mut random = Random(0x70_4E);
    let colors: Vec<_> = (0..1000)
        .map(|_| {
            let level = (random.unit() * 24.0 - 14.0).exp2();
            DVec3::from_array([0; 3].map(|_| level * random.unit())).as_vec3().as_dvec3()
        })
        .collect();
    for settings in tones() {
        for (color, found) in colors.iter().zip(mapped(settings.clone(), &colors)) {
            let expected = tone::curve(&settings, *color);
            let error = (found - expected).abs().max_element();
            assert!(
                error < 1e-4,
                "{:?}, {:?}: {color} became {found} for {expected}",
                settings.curve,
                settings.channels
            );
        }
    }
}

#[test]
fn tone_curves_rise_from_black_to_white_and_leave_greys_grey() {
    let mut levels: Vec<_> = (0..900).map(|i| (f64::from(i) / 40.0 - 13.0).exp2()).collect();
    levels.insert(0, 0.0);
    let greys: Vec<_> = levels.iter().map(|level| DVec3::splat(*level)).collect();
    for settings in tones() {
        let name = format!("{:?}, {:?}", settings.curve, settings.channels);
        let mapped = mapped(settings, &greys);
        assert!(mapped[0].abs().max_element() < 1e-6, "{name}: black is {}", mapped[0]);
        let white = mapped[mapped.len() - 1];
        assert!(white.min_element() > 0.97, "{name}: {} is {white}", greys[greys.len() - 1]);
        for (grey, pair) in greys.iter().skip(1).zip(mapped.windows(2)) {
            assert!(
                pair[1].min_element() >= pair[0].min_element() - 1e-6,
                "{name} falls at {grey}"
            );
            assert!(pair[1].max_element() <= 1.0);
            let tint = pair[1].max_element() - pair[1].min_element();
            assert!(tint < 3e-5, "{name} tints {grey}: {}", pair[1]);
        }
    }
}

/// The interface says from which luminance on the display shows white.
#[test]
fn each_curve_has_its_white_point() {
    for settings in tones() {
        let at = |level: f64| tone::curve(&settings, DVec3::splat(level)).x;
        let white = settings.white();
        let step = 1.0 / 255.0;
        assert!(srgb(at(white)) > 1.0 - step, "{:?}: {}", settings.curve, at(white));
        assert!(srgb(at(0.6 * white)) < 1.0 - step, "{:?}: much darker is white", settings.curve);
    }
}

fn assert_shown(film: &Film, size_px: [u32; 2], scene: &Scene, colors: &[[f32; 3]]) {
    let found = film.tone(scene, colors);
    let automatic = if scene.tone.auto_exposure { found.statistics.adapted_stops } else { 0.0 };
    let factor = (scene.tone.exposure + f64::from(automatic)).exp2();
    let exposed: Vec<_> = colors.iter().map(|c| wide(c) * factor).collect();
    let size_px = size_px.map(|side| side as usize);
    let expected = bloom::shown(&scene.tone, &scene.bloom, size_px, &exposed);
    for (i, (found, expected)) in found.display.iter().zip(expected).enumerate() {
        let expected = DVec3::from_array(expected.to_array().map(|v| 255.0 * srgb(v)));
        // Half a step of dither; 0.6 of rounding, as Direct3D and Vulkan allow.
        let error = (*found - expected).abs().max_element();
        assert!(error < 1.15, "{:?} at {i}: {found} for {expected}", scene.bloom);
    }
}

#[test]
fn bloom_is_that_of_its_definition() {
    for size_px in [[101, 67], [64, 96], [5, 3]] {
        let film = Film::new(size_px);
        let colors = varied(size_px);
        for order in [BloomOrder::Before, BloomOrder::After] {
            for (radius, passes) in [(0.005, 1), (0.04, 3), (0.1, 1), (0.25, 1), (0.25, 4)] {
                for threshold in [0.0, 0.5, 5.0] {
                    let bloom = Bloom { strength: 0.7, order, radius, threshold, passes };
                    let tone = Tone {
                        exposure: -1.0,
                        auto_exposure: passes == 3,
                        curve: CURVES[passes as usize],
                        ..Tone::default()
                    };
                    assert_shown(&film, size_px, &toned_by(tone, bloom), &colors);
                }
            }
        }
    }
}

/// Light that spreads is neither lost nor made, as long as none of it would leave the picture,
/// and it spreads as far as the radius says.
#[test]
fn a_halo_holds_the_light_of_what_it_surrounds() {
    let size_px = [128, 128];
    let film = Film::new(size_px);
    for passes in 1..=4 {
        let bloom =
            Bloom { strength: 1.0, radius: 0.1, threshold: 0.0, passes, order: BloomOrder::Before };
        let mut colors = vec![[0.0; 3]; count(size_px)];
        colors[66 * 128 + 62] = [300.0, 100.0, 20.0];
        let scene = toned_by(Tone::default(), bloom.clone());
        let found = film.tone(&scene, &colors);
        let side = 128 >> found.statistics.bloom_level;
        let start = found.statistics.bloom_start as usize;
        let elements = &found.mips[start..start + (side * side) as usize];
        let pixels = f64::from(1 << (2 * found.statistics.bloom_level));
        let sum = elements.iter().sum::<DVec3>() * pixels;
        assert!((sum - DVec3::new(300.0, 100.0, 20.0)).abs().max_element() < 1e-3, "{sum}");
        // Of a uniform distribution from −R to R the variance is R²/3.
        let spacing = f64::from(1 << found.statistics.bloom_level);
        let place = |i: usize| (i % side as usize) as f64 * spacing;
        let weigh = |f: &dyn Fn(f64) -> f64| -> f64 {
            elements.iter().enumerate().map(|(i, color)| color.y * f(place(i))).sum()
        };
        let mean = weigh(&|x| x) / weigh(&|_| 1.0);
        let variance = weigh(&|x| (x - mean).powi(2)) / weigh(&|_| 1.0);
        let spread_px = (3.0 * variance).sqrt();
        assert!((spread_px / 12.8 - 1.0).abs() < 0.15, "{passes} passes spread {spread_px} px");
    }
}

/// A kernel that counted the outside as black would darken the edges.
#[test]
fn a_uniform_film_blooms_uniformly() {
    for size_px in SIZES {
        for radius in [0.02, 0.25] {
            let bloom = Bloom { strength: 1.0, radius, threshold: 0.0, ..Bloom::default() };
            let scene = toned_by(Tone { curve: ToneCurve::Linear, ..Tone::default() }, bloom);
            let toned = Film::new(size_px).tone(&scene, &vec![[0.25; 3]; count(size_px)]);
            let expected = 255.0 * srgb(0.5);
            for color in toned.display {
                assert!((color - expected).abs().max_element() < 1.05, "{size_px:?}: {color}");
            }
        }
    }
}

/// The columns `left..left + width` of rows of `stride` pixels, and so on for rows.
fn part<T: Copy>(all: &[T], stride: usize, at: [usize; 2], size: [usize; 2]) -> Vec<T> {
    let rows = all.chunks(stride).skip(at[1]).take(size[1]);
    rows.flat_map(|row| &row[at[0]..at[0] + size[0]]).copied().collect()
}

/// Two eyes that share a film bloom as if each were alone: what is bright at one's edge leaves the
/// other's picture dark. Their mean is that of both.
#[test]
fn the_light_of_one_eye_does_not_reach_the_other() {
    for (eyes, size_px) in
        [(Eyes::Beside, [37, 22]), (Eyes::Below, [37, 22]), (Eyes::Beside, [101, 67])]
    {
        let region = Region { eyes, ..Region::whole(size_px) };
        let (film_px, second) = (region.film_px(), region.second_eye_at().map(|at| at as usize));
        let mut colors = varied(film_px);
        let [width, height] = size_px.map(|side| side as usize);
        // The right eye's picture is dark, and the left one's bright where they meet.
        let stride = film_px[0] as usize;
        for (i, color) in colors.iter_mut().enumerate() {
            let (x, y) = (i % stride, i / stride);
            if x >= second[0] && y >= second[1] {
                *color = [0.0; 3];
            } else if x + 1 == width || y + 1 == height {
                *color = [900.0, 400.0, 200.0];
            }
        }
        for order in [BloomOrder::Before, BloomOrder::After] {
            for radius in [0.03, 0.25] {
                let bloom = Bloom { strength: 1.0, radius, threshold: 0.0, passes: 3, order };
                let scene = toned_by(Tone::default(), bloom);
                let both = Film::of(region).tone(&scene, &colors);
                for at in [[0, 0], second] {
                    let own = part(&colors, stride, at, [width, height]);
                    let alone = Film::new(size_px).tone(&scene, &own).display;
                    let found = part(&both.display, stride, at, [width, height]);
                    assert_eq!(found, alone, "{eyes:?} at {at:?}");
                    assert_eq!(at == second, alone.iter().all(|color| *color == DVec3::ZERO));
                }
            }
        }
        let statistics = Film::of(region).tone(&Scene::default(), &colors).statistics;
        let sum: f64 = colors.iter().map(|color| f64::from(color[0])).sum();
        let expected = sum / colors.len() as f64;
        assert!((f64::from(statistics.mean[0]) / expected - 1.0).abs() < 1e-5);
        assert_eq!(statistics.bins.iter().sum::<u32>() as usize, colors.len());
    }
}

/// What is filled in between the pixels of a sparse lattice is of one eye, too.
#[test]
fn a_sparse_lattice_does_not_mix_the_eyes() {
    for (eyes, size_px) in
        [(Eyes::Beside, [37, 22]), (Eyes::Below, [37, 21]), (Eyes::Beside, [64, 31])]
    {
        let region = Region { eyes, ..Region::whole(size_px) };
        let (stride, second) = (region.film_px()[0] as usize, region.second_eye_at());
        let is_second =
            |i: usize| i % stride >= second[0] as usize && i / stride >= second[1] as usize;
        let colors: Vec<_> = (0..count(region.film_px()))
            .map(|i| if is_second(i) { [0.0; 3] } else { [0.25; 3] })
            .collect();
        let scene = Scene::default();
        let complete = Film::of(region).tone(&scene, &colors).display;
        for level in 1..=8 {
            let filled = Film::of(region).show(&scene, &colors, level).display;
            assert_eq!(filled, complete, "{eyes:?}, {size_px:?}, level {level}");
        }
    }
}
