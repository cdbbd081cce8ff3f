//! One scene for each formula of `formulas/`, called by the formula's name.
//!
//! In: nothing. Out: scenes whose pictures also stand for the formulas in the panel that chooses one.

use super::{
    parts::{camera, gradient, lit, new_scene, of_formula},
    preset::Preset,
};
use crate::{
    formula::table::Value,
    scene::{
        description::Scene,
        surface::{ColorSource, Coloring, Surface},
    },
};

/// What a formula's scene has of its own.
#[derive(Clone, Copy)]
struct Row {
    formula: &'static str,
    eye: [f64; 3],
    pivot: [f64; 3],
    vertical_fov_deg: f64,
    gradient: &'static str,
    source: ColorSource,
    repeats: f64,
    values: fn() -> Vec<(&'static str, Value)>,
}

/// A row with the usual values.
const ROW: Row = Row {
    formula: "",
    eye: [1.0, -2.0, 1.0],
    pivot: [0.0; 3],
    vertical_fov_deg: 40.0,
    gradient: "Dawn",
    source: ColorSource::PointTrap,
    repeats: 1.2,
    values: Vec::new,
};

fn scene(row: &Row) -> Scene {
    let mut fractal = of_formula(row.formula);
    for (name, value) in (row.values)() {
        fractal.set(name, value);
    }
    let surface = Surface {
        coloring: Coloring { source: row.source, repeats: row.repeats, ..Coloring::default() },
        gradient: gradient(row.gradient),
        ..Surface::default()
    };
    new_scene(lit(fractal, camera(row.eye, row.pivot, row.vertical_fov_deg), surface))
}

/// A preset of a row, whose missing fields are the usual ones.
macro_rules! formula_scene {
    ($name:literal, $blurb:literal, $($field:ident: $value:expr),* $(,)?) => {
        Preset {
            name: $name,
            blurb: $blurb,
            scene: || {
                const OWN: Row = Row { $($field: $value,)* ..ROW };
                scene(&OWN)
            },
        }
    };
}

/// The formulas' scenes, by name.
pub fn formulas() -> &'static [Preset] {
    const FORMULAS: &[Preset] = &[
        formula_scene!("Aexion", "A quadratic set of crossed pairs: four towers on a terrace.",
            formula: "aexion", eye: [0.31, -0.62, 0.36], gradient: "Brass", repeats: 1.6),
        formula_scene!("Amazing Box mod", "A Mandelbox that turns at every step: seals in carved stone.",
            formula: "amazing_box_mod", eye: [2.6, -4.6, 2.4], gradient: "Stone", repeats: 1.5,
            values: || vec![("scale", (-1.7).into()), ("rotation", [0.0, 0.0, 14.0].into()), ("inner_radius", 0.4.into())]),
        formula_scene!("Amazing Surf", "An arena on an island, folded in two directions.",
            formula: "amazing_surf", eye: [1.5, -3.2, 2.1], pivot: [0.0, 0.0, 0.1], vertical_fov_deg: 45.0, gradient: "Moss", repeats: 2.0,
            values: || vec![("scale", (-1.5).into()), ("rotation", [10.0, 0.0, 0.0].into()), ("inner_radius", 0.35.into())]),
        formula_scene!("Apollonian", "Spheres in the gaps between spheres, among walls of stars.",
            formula: "apollonian", eye: [0.5, -0.5, 0.5], vertical_fov_deg: 60.0, gradient: "Orchid", repeats: 2.0, source: ColorSource::AxisTrap,
            values: || vec![("extent", 8.0.into()), ("inversion", 1.0.into())]),
        formula_scene!("Benesi pine tree", "A square about the x axis: branches in tiers.",
            formula: "benesi_pine_tree", eye: [1.45, -3.2, 1.4], gradient: "Moss"),
        formula_scene!("Bicomplex Mandelbrot", "Two complex numbers squared as one: cut like a crystal.",
            formula: "bicomplex_mandelbrot", eye: [-2.2, -1.4, 1.15], pivot: [-0.9, 0.0, 0.05], gradient: "Ice", repeats: 1.6),
        formula_scene!("Box-fold bulb", "A fold before the square: a cathedral of organs.",
            formula: "box_fold_bulb", eye: [2.2, -4.6, 2.2], gradient: "Ember", repeats: 1.5,
            values: || vec![("inner_radius", 0.8.into())]),
        formula_scene!("Bristorbrot", "A shell that is torn and mended.",
            formula: "bristorbrot", eye: [-1.9, -3.1, 1.6], pivot: [-0.5, 0.0, 0.0]),
        formula_scene!("Burning ship bulb", "A square of absolute values: a ship with masts, in flames.",
            formula: "burning_ship_bulb", eye: [-2.2, -2.6, 1.4], pivot: [-0.4, -0.2, 0.0], gradient: "Ember", source: ColorSource::AxisTrap),
        formula_scene!("Coastalbrot", "Sines of sines: a block of ice with caves.",
            formula: "coastalbrot", eye: [0.8, -1.9, 0.9], gradient: "Ice",
            values: || vec![("power", 6.0.into())]),
        formula_scene!("Juliabulb", "One constant for all points: a coral in layers.",
            formula: "juliabulb", eye: [1.35, -2.4, 1.15]),
        formula_scene!("Kaleidoscopic icosahedron", "A ball of flowers with five petals.",
            formula: "kaleidoscopic_icosahedron", eye: [0.95, -2.0, 1.05], gradient: "Orchid", repeats: 1.4),
        formula_scene!("Kaleidoscopic octahedron", "A snow crystal that grows into space.",
            formula: "kaleidoscopic_octahedron", eye: [1.0, -2.1, 1.1], gradient: "Ice", repeats: 1.4),
        formula_scene!("Kaleidoscopic tetrahedron", "Cauliflower on the mirrors of a tetrahedron.",
            formula: "kaleidoscopic_tetrahedron", eye: [1.25, -2.9, 1.35], gradient: "Moss", repeats: 1.6),
        formula_scene!("Kleinian", "A chain of touching spheres between two floors.",
            formula: "kleinian",
            values: || vec![("real", 1.8462756.into()), ("imaginary", 0.09627581.into()), ("extent", 6.0.into())],
            eye: [0.25, -0.9, 0.15], pivot: [0.0, 0.2, 0.0], vertical_fov_deg: 60.0, gradient: "Ember", repeats: 1.5),
        formula_scene!("Koch cube", "Cubes on the faces of cubes.",
            formula: "koch_cube", eye: [2.2, -3.8, 2.2], gradient: "Brass", repeats: 1.0),
        formula_scene!("Mandelbox", "The box that folds and inverts itself.",
            formula: "mandelbox", eye: [8.2, -17.5, 8.8], gradient: "Stone", repeats: 1.4),
        formula_scene!("Mandelbulb, cosine", "The bulb from the pole: a crown of lobes.",
            formula: "mandelbulb_cosine", eye: [1.25, -2.6, 1.4], gradient: "Orchid", source: ColorSource::AxisTrap),
        formula_scene!("Menger sponge", "A cube with the middle third of each face drilled through, again and again.",
            formula: "menger_sponge", eye: [2.3, -3.5, 2.2], gradient: "Brass", repeats: 1.4),
        formula_scene!("Newton", "Where Newton's method does not settle: agate, cut open.",
            formula: "newton", eye: [1.5, -3.3, 1.8], gradient: "Ice", source: ColorSource::Iterations, repeats: 3.0),
        formula_scene!("Pseudo-Kleinian", "An arcade of folded spheres.",
            formula: "pseudo_kleinian", eye: [1.0, -1.9, 0.3], vertical_fov_deg: 55.0, gradient: "Stone", repeats: 1.6),
        formula_scene!("Quaternion Julia", "Curtains of four dimensions, cut by three.",
            formula: "quaternion_julia", eye: [1.15, -1.9, 0.98], gradient: "Ember"),
        formula_scene!("Quaternion Mandelbrot", "The Mandelbrot set, turned on a lathe.",
            formula: "quaternion_mandelbrot", eye: [-2.2, -3.1, 1.5], pivot: [-0.6, 0.0, 0.0], repeats: 1.6),
        formula_scene!("Riemann sphere", "Directions raised to a power: a jellyfish and its arms.",
            formula: "riemann_sphere", eye: [0.85, -1.95, 0.55], gradient: "Ice",
            values: || vec![("power", 8.0.into())]),
        formula_scene!("Sierpinski tetrahedron", "Four tetrahedra in the corners of one.",
            formula: "sierpinski_tetrahedron", eye: [-1.3, -2.9, 1.8], repeats: 1.5),
    ];
    FORMULAS
}
