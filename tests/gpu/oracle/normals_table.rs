//! How far off each way to find normals is, and what it costs: the table of `docs/normals.md`.
//!
//! `MANDELIGHT_BLESS=1 cargo test --release --test gpu normals_table` writes it anew.

use std::{fmt::Write, fs, time::Instant};

use mandelight::{
    formula::mandelbulb::Mandelbulb,
    gpu::device::in_parallel,
    render::{
        Region, frame,
        integrator::DIRECT,
        pass,
        recorder::{Dispatches, Recorder},
        schedule::{Points, Stage, Trace, Work},
        targets::Targets,
        uniforms::Inputs,
    },
    scene::{Normals, Scene},
};
use mandelight_test_support::{
    device::pipelines,
    oracle::{normals, rays, views},
    statistics::quantile,
};

use super::pictures::{draw, pixels, point_at};

/// Each way: its value in a document, and the distance estimates it takes.
const WAYS: [(Normals, &str, &str); 6] = [
    (Normals::None, "none", "0"),
    (Normals::Three, "three", "4"),
    (Normals::Six, "six", "6"),
    (Normals::Eighteen, "eighteen", "18"),
    (Normals::TwentySix, "twenty_six", "26"),
    (Normals::Analytic, "analytic", "1, with derivatives"),
];

/// The table's columns.
const VIEWS: [&str; 7] = [
    "power 8",
    "power 8 at 0.15",
    "power 8 at 0.01",
    "power 8 at 0.001",
    "power 2",
    "power 3",
    "Julia 8",
];

/// A figure may differ by this part of itself, and by so many degrees, between drivers.
const TOLERANCE: (f64, f64) = (0.1, 0.1);

/// Median and 95th percentile of the angles between normals and gradients, degrees.
type Off = [f64; 2];

/// Every way's error on one view.
fn errors(scene: &Scene) -> Vec<Off> {
    let pictures = WAYS.map(|(way, ..)| {
        let mut scene = scene.clone();
        scene.quality.normals = way;
        draw(&scene).samples
    });
    let indexed: Vec<_> = pixels().into_iter().zip(0..).collect();
    let gradients = in_parallel(&indexed, |&(pixel, index): &([u32; 2], usize)| {
        let depth = pictures[0].depth[index];
        let point = point_at(scene, pixel, depth);
        let spacing = rays::hit_distance(scene, views::SIZE, depth.into());
        let gradient = (depth > 0.0)
            .then(|| normals::gradient(&Mandelbulb::of(&scene.fractal), point, spacing));
        gradient.flatten().filter(|gradient| gradient.uncertain_deg < 0.01)
    });
    let known = gradients.iter().flatten().count();
    let hits = pictures[0].depth.iter().filter(|depth| **depth > 0.0).count();
    assert!(known * 10 > hits * 9, "{known} gradients of {hits} are known well");
    let off = |samples: &mandelight::render::gbuffer::Samples| {
        let pairs = gradients.iter().zip(&samples.normal);
        let angle = |(gradient, normal): (&Option<normals::Direction>, &glam::Vec3)| {
            Some(normals::angle_deg(normal.as_dvec3(), gradient.as_ref()?.unit))
        };
        let angles: Vec<_> = pairs.filter_map(angle).collect();
        [quantile(angles.clone(), 0.5), quantile(angles, 0.95)]
    };
    pictures.iter().map(off).collect()
}

/// The time of each way's pass over that of six samples, on a view that the bulb fills.
fn costs(scene: &Scene) -> Vec<f64> {
    let pipelines = pipelines();
    const PICTURE_PX: [u32; 2] = [384, 256];
    let points = Points::Level(0);
    let grid = points.grid(PICTURE_PX);
    let trace = Trace::whole(points, Stage::March, 0, PICTURE_PX);
    let targets = Targets::new(&pipelines.layouts, Region::whole(PICTURE_PX));
    let mut dispatches = Dispatches::default();
    let mut millis = |way: Option<Normals>| {
        let mut scene = scene.clone();
        scene.quality.normals = way.unwrap_or(Normals::None);
        let inputs = Inputs::new(&scene, Region::whole(PICTURE_PX));
        pipelines.specialize(&scene);
        let passes = pipelines.of_frame(&inputs);
        targets.upload(&pipelines.gpu.queue, &inputs);
        let mut recorder =
            Recorder::new(&pipelines.layouts, &passes, &targets, &inputs, &mut dispatches);
        match way {
            Some(_) => pass::normal::record(&mut recorder, &trace, &grid),
            None => frame::record(&DIRECT, &mut recorder, Work::Trace(trace)),
        }
        let commands = recorder.finish();
        let start = Instant::now();
        pipelines.gpu.queue.submit([commands]);
        pipelines.gpu.wait();
        start.elapsed().as_secs_f64() * 1e3
    };
    // Depths for all of them.
    millis(None);
    let mut rounds: Vec<Vec<f64>> = vec![Vec::new(); WAYS.len()];
    for _ in 0..9 {
        for (times, (way, ..)) in rounds.iter_mut().zip(WAYS) {
            times.push(millis(Some(way)));
        }
    }
    let medians: Vec<_> = rounds.into_iter().map(|times| quantile(times, 0.5)).collect();
    medians.iter().map(|ms| ms / medians[2]).collect()
}

fn table(views: &[Vec<Off>], costs: &[f64]) -> String {
    let mut text = format!("| value | estimates | time | {} |\n", VIEWS.join(" | "));
    text += &format!("|{}\n", "---|".repeat(VIEWS.len() + 3));
    for (row, (_, name, estimates)) in WAYS.iter().enumerate() {
        write!(text, "| `{name}` | {estimates} | {:.2} |", costs[row]).unwrap();
        for view in views {
            write!(text, " {:.2} / {:.2} |", view[row][0], view[row][1]).unwrap();
        }
        text.push('\n');
    }
    text
}

/// The angles that a table tells, row by row.
fn figures(table: &str) -> Vec<Off> {
    let rows = table.lines().filter(|line| line.starts_with("| `"));
    let cells = rows.flat_map(|row| row.split('|').skip(4));
    cells
        .filter_map(|cell| {
            let (median, most) = cell.split_once('/')?;
            Some([median.trim().parse().ok()?, most.trim().parse().ok()?])
        })
        .collect()
}

#[test]
fn the_docs_tell_how_far_off_normals_are() {
    let all = views::all();
    let scene = |name: &str| &all.iter().find(|view| view.name == name).expect("a view").scene;
    let found: Vec<_> = VIEWS.iter().map(|name| errors(scene(name))).collect();
    for (name, view) in VIEWS.iter().zip(&found) {
        let [.., six, _, _, analytic] = view[..] else { unreachable!("six ways") };
        assert!(analytic[0] <= six[0] && analytic[1] <= six[1], "{name}: {analytic:?}, {six:?}");
    }
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/normals.md");
    let text = fs::read_to_string(file).expect("docs/normals.md");
    let (before, rest) = text.split_once("<!-- errors -->\n").expect("the mark before the table");
    let (told, after) = rest.split_once("<!-- end of errors -->").expect("the mark after it");
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        let new = table(&found, &costs(scene("power 8 at 0.15")));
        let text = format!("{before}<!-- errors -->\n{new}<!-- end of errors -->{after}");
        fs::write(file, text).expect("docs/normals.md");
        return;
    }
    let told = figures(told);
    assert_eq!(told.len(), WAYS.len() * VIEWS.len());
    for (row, (_, name, _)) in WAYS.iter().enumerate() {
        for (column, view) in found.iter().enumerate() {
            for (told, found) in told[row * VIEWS.len() + column].iter().zip(view[row]) {
                let allowed = TOLERANCE.0 * found + TOLERANCE.1;
                assert!(
                    (told - found).abs() <= allowed,
                    "{name}, {}: {found}, the docs tell {told}",
                    VIEWS[column]
                );
            }
        }
    }
}
