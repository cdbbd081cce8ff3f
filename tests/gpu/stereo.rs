//! Pictures for two eyes: the geometry of a viewer in front of a screen, and how the files put
//! both eyes' pictures together.

use std::ops::ControlFlow;

use glam::DVec3;
use mandelight::{
    export::{ExportError, Eye, PictureFormat, StillJob, StillOptions},
    render::{Eyes, Pace, Region, View},
    scene::{Camera, Scene, Stereo, StereoLayout},
};
use mandelight_test_support::{
    device::pipelines,
    picture::Picture,
    stereo::{glowing, scene, sheet},
    view::{finished_in, rgb, settle},
};

/// Odd sides, so that there is a pixel in the middle.
const SIZE: [u32; 2] = [151, 101];

fn view(scene: &Scene, size_px: [u32; 2], eyes: Eyes) -> View {
    finished_in(scene, Region { eyes, ..Region::whole(size_px) }, Pace::Still)
}

/// The points that an eye sees, centimetres from the middle between the eyes: right, up, ahead.
/// From a viewer in front of a screen, and depths alone.
fn points(scene: &Scene, eyes: Eyes) -> Vec<Option<DVec3>> {
    let stereo = &scene.camera.stereo;
    let cm = stereo.eye_distance_cm / scene.camera.view_unit();
    let aside = 0.5 * stereo.eye_separation_cm;
    let eye = DVec3::X * if eyes == Eyes::Left { -aside } else { aside };
    let samples = view(scene, SIZE, eyes).gbuffer().expect("the G-buffer");
    let depths = samples.depth.iter().enumerate();
    depths
        .map(|(i, &depth)| {
            let on_screen = screen_cm(stereo, i % SIZE[0] as usize, i / SIZE[0] as usize);
            (depth > 0.0).then(|| eye + (on_screen - eye).normalize() * f64::from(depth) * cm)
        })
        .collect()
}

/// A pixel's width on the screen, centimetres.
fn pixel_cm(stereo: &Stereo) -> f64 {
    stereo.screen_height_cm / f64::from(SIZE[1])
}

/// The middle of a pixel on the screen.
fn screen_cm(stereo: &Stereo, x: usize, y: usize) -> DVec3 {
    let from_middle = |at: usize, side: u32| at as f64 + 0.5 - 0.5 * f64::from(side);
    let [right, down] = [from_middle(x, SIZE[0]), from_middle(y, SIZE[1])];
    DVec3::new(right * pixel_cm(stereo), -down * pixel_cm(stereo), stereo.eye_distance_cm)
}

/// How many of the points that the left eye sees the right one sees too, so far to the right of
/// the left one's pixel as `disparity_cm` of their distance says.
fn agreeing(
    stereo: &Stereo,
    [left, right]: &[Vec<Option<DVec3>>; 2],
    disparity_cm: impl Fn(f64) -> f64,
) -> f64 {
    let width = SIZE[0] as usize;
    let (mut agree, mut all) = (0, 0);
    for (i, point) in left.iter().enumerate() {
        let (x, y) = (i % width, i / width);
        let Some(point) = point else { continue };
        let at = x as f64 + disparity_cm(point.z) / pixel_cm(stereo);
        // The two pixels whose middles are about the place.
        let [before, after] = [at.floor(), at.floor() + 1.0];
        if before < 0.0 || after >= width as f64 {
            continue;
        }
        let seen = [before, after].map(|x| right[y * width + x as usize]);
        all += 1;
        if let [Some(a), Some(b)] = seen {
            let footprint = pixel_cm(stereo) * point.z / stereo.eye_distance_cm;
            let (low, high) = (a.z.min(b.z) - footprint, a.z.max(b.z) + footprint);
            agree += usize::from((low..=high).contains(&point.z) && high - low < 8.0 * footprint);
        }
    }
    assert!(all > 3000, "{all} points");
    agree as f64 / all as f64
}

#[test]
fn disparities_are_those_of_a_viewer_in_front_of_a_screen() {
    for (eye_distance_cm, eye_separation_cm) in [(60.0, 6.4), (90.0, 12.0)] {
        let mut scene = scene(StereoLayout::SideBySide);
        let stereo = &mut scene.camera.stereo;
        (stereo.eye_distance_cm, stereo.eye_separation_cm) = (eye_distance_cm, eye_separation_cm);
        let stereo = stereo.clone();
        let points = [Eyes::Left, Eyes::Right].map(|eyes| points(&scene, eyes));
        let of = |sign: f64| {
            let (e, d) = (stereo.eye_separation_cm, stereo.eye_distance_cm);
            agreeing(&stereo, &points, |z| sign * e * (1.0 - d / z))
        };
        let (right, none, wrong) = (of(1.0), of(0.0), of(-1.0));
        assert!(right > 0.9, "{right} agree");
        assert!(none < 0.5 && wrong < 0.3, "{none} agree without, {wrong} with the opposite");
    }
}

#[test]
fn what_lies_at_the_pivot_is_seen_on_the_screen() {
    let mut scene = scene(StereoLayout::SideBySide);
    // Without a separation both eyes see the middle of the surface.
    let mut one_eyed = scene.clone();
    one_eyed.camera.stereo.eye_separation_cm = 0.0;
    let middle = (SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize;
    let depth = view(&one_eyed, SIZE, Eyes::Left).gbuffer().unwrap().depth[middle];
    let eye = scene.camera.position.to_dvec3();
    let stereo = scene.camera.stereo.clone();
    let pivot = eye + scene.camera.forward() * f64::from(depth);
    scene.camera = Camera::looking_at(eye, pivot, DVec3::Z);
    scene.camera.stereo = stereo.clone();
    for eyes in [Eyes::Left, Eyes::Right] {
        let point = points(&scene, eyes)[middle].expect("the surface");
        let off = point - DVec3::Z * stereo.eye_distance_cm;
        assert!(off.length() < 2.0 * pixel_cm(&stereo), "{eyes:?}: {off}");
    }
}

#[test]
fn without_a_separation_both_eyes_see_what_the_camera_does() {
    let mut flat = scene(StereoLayout::SideBySide);
    flat.camera.stereo.eye_separation_cm = 0.0;
    let [left, right] = [Eyes::Left, Eyes::Right].map(|eyes| rgb(&view(&flat, SIZE, eyes)));
    assert_eq!(left, right);
    let mut mono = flat.clone();
    mono.camera.stereo.layout = StereoLayout::Off;
    mono.camera.vertical_fov_deg = 2.0 * flat.camera.stereo.half_height().atan().to_degrees();
    let mono = rgb(&view(&mono, SIZE, Eyes::Camera));
    let different = mono.iter().zip(&left).filter(|(a, b)| a != b).count();
    // The field of view comes a last bit different out of its tangent.
    assert!(different * 100 < mono.len(), "{different} pixels differ");
}

#[test]
fn swapped_eyes_see_each_others_pictures() {
    let straight = scene(StereoLayout::SideBySide);
    let mut swapped = straight.clone();
    swapped.camera.stereo.swap_eyes = true;
    let pictures = [&straight, &swapped]
        .map(|scene| [Eyes::Left, Eyes::Right].map(|eyes| rgb(&view(scene, SIZE, eyes))));
    let [[left, right], [swapped_left, swapped_right]] = &pictures;
    assert!(left != right);
    assert!(left == swapped_right && right == swapped_left);
}

fn still(scene: &Scene, options: StillOptions) -> ([u32; 2], Vec<[u8; 3]>) {
    let job = StillJob::new(pipelines(), scene, options, Vec::new()).unwrap();
    let picture = Picture::of(&job.run(|_| ControlFlow::Continue(())).unwrap());
    (picture.size_px, picture.rgb())
}

const STILL_SIZE: [u32; 2] = [61, 43];

/// A file for each eye.
fn pair(scene: &Scene) -> [Vec<[u8; 3]>; 2] {
    Eye::BOTH.map(|eye| {
        let options = StillOptions { eye: Some(eye), ..StillOptions::new(STILL_SIZE) };
        let (size_px, picture) = still(scene, options);
        assert_eq!(size_px, STILL_SIZE);
        picture
    })
}

#[test]
fn sheets_hold_the_pictures_of_a_pair() {
    let [width, height] = STILL_SIZE;
    for (layout, size_px) in [
        (StereoLayout::SideBySide, [2 * width, height]),
        (StereoLayout::TopBottom, [width, 2 * height]),
    ] {
        let scene = glowing(layout);
        let eyes = pair(&scene);
        assert!(eyes[0] != eyes[1]);
        let expected = sheet(&eyes, width as usize, layout);
        for tile_px in [[2048, 256], [25, 17], [61, 10]] {
            let options = StillOptions { tile_px, ..StillOptions::new(STILL_SIZE) };
            let found = still(&scene, options);
            assert!(found == (size_px, expected.clone()), "{layout:?} in {tile_px:?}");
        }
        // The view that shows both at once, and finds out about the film by itself.
        let live = rgb(&view(&scene, STILL_SIZE, Eyes::of(layout)));
        assert!(part_that_differs(&live, &expected) < 0.02, "{layout:?}: the live view differs");
    }
}

/// The part of the pixels that differ by more than a few steps: where two eyes share a film, rays
/// of the second go in other cones than alone, and those that graze the surface end a little
/// otherwise.
fn part_that_differs(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let differs = |(a, b): (&[u8; 3], &[u8; 3])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 12);
    a.iter().zip(b).filter(|pair| differs(*pair)).count() as f64 / a.len() as f64
}

/// In a window an anaglyph has half the columns, each twice as wide: it shows what the whole
/// window would.
#[test]
fn a_shared_anaglyph_is_not_stretched() {
    let mut scene = glowing(StereoLayout::Anaglyph);
    scene.bloom.strength = 0.0;
    scene.quality.samples = 16;
    let window = [2 * STILL_SIZE[0], 2 * STILL_SIZE[1]];
    let region = Region::whole(window).shared_by(StereoLayout::Anaglyph);
    let mut shared = View::new(pipelines(), region, Pace::Still);
    assert_eq!(shared.region().display_px(), [window[0] / 2, window[1]]);
    shared.set_scene(&scene, false);
    settle(&mut shared);
    let halved = |pixels: &[[u8; 3]], [width, height]: [u32; 2], [by, down]: [u32; 2]| {
        let mean = move |x: u32, y: u32, channel: usize| {
            let cells =
                (0..down).flat_map(move |j| (0..by).map(move |i| (x * by + i, y * down + j)));
            let sum: u32 =
                cells.map(|(x, y)| u32::from(pixels[(y * width + x) as usize][channel])).sum();
            f64::from(sum) / f64::from(by * down)
        };
        let size = [width / by, height / down];
        let rows = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        rows.flat_map(|(x, y)| [0, 1, 2].map(|channel| mean(x, y, channel))).collect::<Vec<f64>>()
    };
    let whole = halved(&rgb(&view(&scene, window, Eyes::Anaglyph)), window, [2, 2]);
    let shared = halved(&rgb(&shared), [window[0] / 2, window[1]], [1, 2]);
    let off: f64 = whole.iter().zip(&shared).map(|(a, b)| (a - b).abs()).sum();
    let off = off / whole.len() as f64;
    // Half as many columns are sampled, so not quite the same.
    assert!(off < 4.0, "mean difference {off}");
}

#[test]
fn an_anaglyph_is_red_for_the_left_eye_and_cyan_for_the_right_one() {
    let scene = glowing(StereoLayout::Anaglyph);
    let [left, right] = pair(&scene);
    let expected: Vec<_> = left.iter().zip(right).map(|(l, r)| [l[0], r[1], r[2]]).collect();
    for tile_px in [[2048, 256], [25, 17]] {
        let options = StillOptions { tile_px, ..StillOptions::new(STILL_SIZE) };
        let (size_px, found) = still(&scene, options);
        assert_eq!(size_px, STILL_SIZE);
        assert!(part_that_differs(&found, &expected) < 0.02, "{tile_px:?}");
    }
    let live = rgb(&view(&scene, STILL_SIZE, Eyes::Anaglyph));
    assert!(part_that_differs(&live, &expected) < 0.02);
}

#[test]
fn what_no_file_can_hold_is_refused() {
    let refused = |layout, options| {
        StillJob::new(pipelines(), &scene(layout), options, Vec::new()).err().expect("an error")
    };
    let wide = StillOptions::new([8193, 10]);
    let error = refused(StereoLayout::SideBySide, wide);
    assert!(matches!(error, ExportError::Sheet { sheet_px: [16_386, 10], .. }), "{error}");
    let linear = StillOptions { format: PictureFormat::Exr, ..StillOptions::new([8, 8]) };
    let error = refused(StereoLayout::Anaglyph, linear);
    assert!(matches!(error, ExportError::RedCyanExr), "{error}");
}
