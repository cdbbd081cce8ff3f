//! Hybrids, sets that section planes cut open, and two layers of colours.

use super::{
    parts::{camera, gradient, lit, new_scene, of_formula, stops},
    preset::Preset,
};
use crate::{
    formula::{
        Fractal, HybridSteps,
        hybrid::{self, find_step},
        section::SectionPlane,
    },
    precise::PrecisePoint,
    scene::{
        description::Scene,
        surface::{Axis, ColorSource, Coloring, SecondLayer, SectionColors, Surface},
    },
};

/// The scenes of hybrids, of cuts and of two layers of colours.
pub fn mixes() -> &'static [Preset] {
    &[
        Preset {
            name: "Mandelbrot slice",
            blurb: "Power 2 cut at half height: the Mandelbrot set, with its bands of equal iterations.",
            scene: || new_scene(slice()),
        },
        Preset {
            name: "Star chamber",
            blurb: "A Menger sponge cut across its diagonal: every hole is a star.",
            scene: || new_scene(star_chamber()),
        },
        Preset {
            name: "Agate",
            blurb: "A quaternion Julia set cut in half, banded like a stone.",
            scene: || new_scene(agate()),
        },
        Preset {
            name: "Woven bulb",
            blurb: "One step of Amazing Surf before each of the bulb: threads round a ball.",
            scene: || new_scene(woven()),
        },
        Preset {
            name: "Football",
            blurb: "Mirrors of an icosahedron before the bulb's power: bulbs on a ball.",
            scene: || new_scene(football()),
        },
        Preset {
            name: "Scaffold",
            blurb: "Two steps of the Menger sponge, then the bulb: a lattice of beads.",
            scene: || new_scene(scaffold()),
        },
        Preset {
            name: "Snail colony",
            blurb: "The bulb and the quaternion square in turn: shells on a ball.",
            scene: || new_scene(snails()),
        },
        Preset {
            name: "Rotunda",
            blurb: "A Menger sponge about an axis of eight: a tower of windows.",
            scene: || new_scene(rotunda()),
        },
        Preset {
            name: "Snow line",
            blurb: "Two layers of colours: rock by its orbits, snow where it faces up.",
            scene: || new_scene(snow_line()),
        },
    ]
}

/// A scene seen from `eye` with the gradient called `name`, its surface coloured by the orbits' distance to the origin.
fn seen_from(eye: [f64; 3], fractal: Fractal, name: &str, repeats: f64) -> Scene {
    let coloring = Coloring { repeats, ..Coloring::default() };
    let surface = Surface { coloring, gradient: gradient(name), ..Surface::default() };
    lit(fractal, camera(eye, [0.0; 3], 40.0), surface)
}

/// A hybrid of steps with their repeats; a test checks the ids.
fn hybrid_of(steps: &[(&str, u32)]) -> Fractal {
    let step = |&(id, repeats): &(&str, u32)| {
        let mut step = hybrid::step(find_step(id)?).ok()?;
        step.repeats = repeats;
        Some(step)
    };
    let steps = steps.iter().filter_map(step).collect();
    hybrid::fractal(HybridSteps { steps, loop_start: 0 }).unwrap_or_default()
}

/// The fractal of a formula, cut by a plane through the origin.
fn cut(mut fractal: Fractal, direction: [f64; 3], band_reach: f64) -> Fractal {
    let point = PrecisePoint::ORIGIN;
    fractal.section_planes = vec![SectionPlane { point, direction, band_reach }];
    fractal
}

fn slice() -> Scene {
    let mut fractal = cut(of_formula("mandelbulb"), [0.0, 0.0, 1.0], 0.07);
    fractal.set("power", 2.0);
    fractal.iterations = 40;
    let eye = [-0.6, -2.35, 1.55];
    let mut scene = seen_from(eye, fractal, "Ice", 1.2);
    scene.camera = camera(eye, [-0.47, -0.05, -0.12], 42.0);
    scene.surface.sections = SectionColors { repeats: 0.22, inside: [0.02, 0.02, 0.03] };
    scene
}

fn star_chamber() -> Scene {
    let diagonal = 1.0 / 3.0_f64.sqrt();
    let fractal = cut(of_formula("menger_sponge"), [diagonal, -diagonal, diagonal], 0.0);
    let mut scene = seen_from([2.25, -2.9, 2.5], fractal, "Brass", 1.4);
    scene.surface.sections.inside = [0.55, 0.48, 0.36];
    scene
}

fn agate() -> Scene {
    let mut fractal = cut(of_formula("quaternion_julia"), [0.0, -1.0, 0.0], 0.12);
    fractal.set("constant", [-0.2, 0.8, 0.0, 0.0]);
    let mut scene = seen_from([1.7, -3.3, 1.3], fractal, "Orchid", 1.0);
    scene.surface.sections = SectionColors { repeats: 0.35, inside: [0.10, 0.03, 0.12] };
    scene
}

fn woven() -> Scene {
    let fractal = hybrid_of(&[("amazing_surf", 1), ("mandelbulb", 1)]);
    seen_from([0.18, -0.42, 0.18], fractal, "Dawn", 1.4)
}

fn football() -> Scene {
    let fractal = hybrid_of(&[("kaleidoscopic_icosahedron", 3), ("mandelbulb", 1)]);
    seen_from([1.15, -2.55, 1.15], fractal, "Moss", 1.4)
}

fn scaffold() -> Scene {
    let fractal = hybrid_of(&[("menger_sponge", 2), ("mandelbulb", 1)]);
    seen_from([2.1, -3.5, 1.9], fractal, "Dawn", 1.4)
}

fn snails() -> Scene {
    let fractal = hybrid_of(&[("mandelbulb", 1), ("quaternion_mandelbrot", 1)]);
    seen_from([1.2, -3.0, 1.0], fractal, "Ember", 1.2)
}

fn rotunda() -> Scene {
    let fractal = hybrid_of(&[("polar_repeat", 1), ("menger_sponge", 1)]);
    seen_from([2.0, -3.9, 2.4], fractal, "Brass", 1.4)
}

fn snow_line() -> Scene {
    let mut scene = seen_from([1.45, -3.2, 1.4], of_formula("benesi_pine_tree"), "Brass", 1.3);
    scene.surface.second_layer = SecondLayer {
        amount: 0.75,
        coloring: Coloring { source: ColorSource::Normal, axis: Axis::Z, ..Coloring::default() },
        gradient: stops(&[
            (0.0, [0.05, 0.03, 0.03]),
            (0.66, [0.14, 0.09, 0.07]),
            (0.74, [0.86, 0.92, 0.98]),
            (0.97, [0.95, 0.98, 1.0]),
        ]),
    };
    scene
}
