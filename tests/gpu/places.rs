//! Places as pictures: sixty dives and the ways of a wheel, held to measures of what is worth seeing.
//!
//! The ignored tests render hundreds of pictures; their contact sheets are in `docs/sheets/`:
//! `MANDELIGHT_BLESS=1 cargo test --release --test gpu places:: -- --ignored --nocapture`

use std::{fs::File, io::BufWriter};

use glam::DVec2;
use image::{
    RgbImage,
    codecs::jpeg::JpegEncoder,
    imageops::{self, FilterType},
};
use mandelight::{
    fractal::{
        FractalModel,
        places::{Place, PlaceSearch, SearchArea},
    },
    gpu::device::in_parallel,
    render::Pace,
    scene::{Camera, Scene},
};
use mandelight_test_support::{
    beauty::Beauty,
    descent::{opening_views, sixteen_pixels, wheel_in},
    view::{finished, rgb, sampled},
};

const SIZE_PX: [u32; 2] = [144, Beauty::HEIGHT_PX];
const ASPECT: f64 = 1.5;
const SAMPLES: u32 = 2;
const DEPTHS: [f64; 4] = [1e-3, 1e-6, 1e-10, 1e-20];
/// Size of a shot on a contact sheet.
const SHEET_SHOT_PX: [u32; 2] = [96, 64];
/// Gap between groups of shots.
const SHEET_GAP_PX: u32 = 8;
/// Quality of a contact sheet's JPEG, 1 to 100.
const SHEET_QUALITY: u8 = 80;
/// Depth of the zooms without a place, for comparison.
const BLIND_DEPTH: f64 = 1e-6;
/// Dives of each of the twelve opening views.
const DIVES: usize = 5;

/// A rendered picture with its measures.
struct Shot {
    pixels: Vec<[u8; 3]>,
    beauty: Beauty,
}

fn shot(scene: &Scene, camera: &Camera) -> Shot {
    let scene = Scene { camera: camera.clone(), ..scene.clone() };
    let pixels = rgb(&finished(&sampled(scene, SAMPLES), SIZE_PX, Pace::Still));
    let beauty = Beauty::of(&pixels, SIZE_PX[0] as usize);
    Shot { pixels, beauty }
}

/// The best endless places of the view.
fn places_of(scene: &Scene, count: usize) -> Vec<Place> {
    let model = FractalModel::new(&scene.fractal);
    let area = SearchArea { has_copies: false, ..SearchArea::PICTURE };
    let mut places = PlaceSearch::new(&model, &scene.camera, ASPECT, area).finish();
    places.truncate(count);
    places
}

/// Zooms at the pixel without guidance.
fn blind(scene: &Scene, pixel: DVec2, depth: f64) -> Camera {
    let way = wheel_in(scene, pixel, depth, false);
    way[way.len() - 1].clone()
}

/// Rows of shots as one picture in `docs/sheets/`, if pictures are to be replaced.
///
/// A gap follows every `group` shots of a row.
fn contact_sheet(name: &str, rows: &[Vec<Shot>], group: usize) {
    if std::env::var_os("MANDELIGHT_BLESS").is_none() {
        return;
    }
    let [width, height] = SHEET_SHOT_PX;
    let left = |column: usize| column as u32 * width + (column / group) as u32 * SHEET_GAP_PX;
    let columns = rows.iter().map(Vec::len).max().expect("a row");
    let mut sheet = RgbImage::new(left(columns - 1) + width, rows.len() as u32 * height);
    for (row, shots) in rows.iter().enumerate() {
        for (column, shot) in shots.iter().enumerate() {
            let pixels = shot.pixels.as_flattened().to_vec();
            let picture = RgbImage::from_raw(SIZE_PX[0], SIZE_PX[1], pixels).expect("all pixels");
            let small = imageops::resize(&picture, width, height, FilterType::Triangle);
            imageops::replace(
                &mut sheet,
                &small,
                left(column).into(),
                (row as u32 * height).into(),
            );
        }
    }
    let path = format!("{}/docs/sheets/{name}.jpg", env!("CARGO_MANIFEST_DIR"));
    let file = BufWriter::new(File::create(path).expect("a file"));
    JpegEncoder::new_with_quality(file, SHEET_QUALITY).encode_image(&sheet).expect("a picture");
}

#[test]
#[ignore = "renders 300 pictures, ten minutes"]
fn sixty_dives_are_worth_seeing_at_every_depth() {
    let views = opening_views();
    let found = in_parallel(&views, |(_, scene)| places_of(scene, DIVES));
    let (mut good, mut rows) = (0, Vec::new());
    for ((name, scene), places) in views.iter().zip(&found) {
        assert_eq!(places.len(), DIVES, "{name}");
        let mut row = Vec::new();
        for place in places {
            let mut is_good = true;
            for depth in DEPTHS {
                let camera = place.camera(&scene.camera, depth).expect("a vantage");
                let shot = shot(scene, &camera);
                println!("{name} {:.2?} {depth:e}: {}", place.ndc, shot.beauty);
                is_good &= shot.beauty.is_good();
                row.push(shot);
            }
            let blind_camera = blind(scene, place.ndc, BLIND_DEPTH);
            let blind = shot(scene, &blind_camera);
            println!(
                "{name} {:.2?} blind {:.1e}: {}",
                place.ndc,
                blind_camera.view_unit(),
                blind.beauty
            );
            row.push(blind);
            println!("{name} {:.2?}: {}", place.ndc, if is_good { "good" } else { "FAILS" });
            good += usize::from(is_good);
        }
        rows.push(row);
    }
    contact_sheet("sixty-dives", &rows, DEPTHS.len() + 1);
    assert!(good >= 57, "{good} of 60");
}

#[test]
#[ignore = "renders 200 pictures, ten minutes"]
fn a_wheel_from_sixteen_pixels_passes_only_views_worth_seeing() {
    let views = opening_views();
    let (_, scene) = views.iter().find(|(name, _)| name == "power 8").expect("the view");
    let pixels = sixteen_pixels(scene);
    let ways = in_parallel(&pixels, |pixel| wheel_in(scene, *pixel, 1e-12, true));
    let (mut bad, mut rows) = (Vec::new(), Vec::new());
    for (pixel, way) in pixels.iter().zip(&ways) {
        let mut row = Vec::new();
        for camera in way.iter().step_by(12) {
            let shot = shot(scene, camera);
            println!("{pixel:.2} {:.1e}: {}", camera.view_unit(), shot.beauty);
            // The whole bulb before a dark background is another kind of picture.
            if !shot.beauty.is_good() && camera.view_unit() < 1.0 {
                bad.push(format!("{pixel:.2} {:.1e}: {}", camera.view_unit(), shot.beauty));
            }
            row.push(shot);
        }
        rows.push(row);
    }
    contact_sheet("wheel", &rows, usize::MAX);
    assert!(bad.is_empty(), "{} fail:\n{}", bad.len(), bad.join("\n"));
}

#[test]
fn dives_of_every_opening_view_are_worth_seeing() {
    let views = opening_views();
    let found = in_parallel(&views, |(_, scene)| places_of(scene, 1));
    for ((name, scene), places) in views.iter().zip(&found) {
        for depth in [1e-6, 1e-20] {
            let camera =
                places.first().expect(name).camera(&scene.camera, depth).expect("a vantage");
            let Shot { beauty, .. } = shot(scene, &camera);
            println!("{name} {depth:e}: {beauty}");
            assert!(beauty.is_good(), "{name} at {depth:e}: {beauty}");
        }
    }
}
