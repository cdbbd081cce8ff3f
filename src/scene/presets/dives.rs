//! Places far below the surface, to start from.
//!
//! In: nothing. Out: sixteen scenes, each a document that stays as it is to the last digit. Eight look at
//! points of the plane z = 0, where all steps of an orbit are conformal; eight at places elsewhere, which
//! [`crate::fractal::places`] found. `docs/dives.md` shows them.

use super::preset::Preset;
use crate::scene::{description::Scene, document};

/// A dive whose document is the file of this name.
macro_rules! dive {
    ($name:literal, $file:literal, $blurb:literal) => {
        Preset {
            name: $name,
            blurb: $blurb,
            scene: || frozen(include_str!(concat!("dives/", $file, ".json"))),
        }
    };
}

/// The dives, the deepest last.
pub fn dives() -> &'static [Preset] {
    const DIVES: &[Preset] = &[
        dive!("Kiln", "kiln", "At 10⁻⁵, power 8: glazed buds over glowing arches."),
        dive!("Atoll", "atoll", "At 10⁻⁷, power 5: red corals on a shelf of turquoise."),
        dive!("Vine", "vine", "At 10⁻⁸ in a Julia form of power 4: bunches on twisted stems."),
        dive!(
            "Gatehouse",
            "gatehouse",
            "At 10⁻⁹, power 4: an overgrown gate, alike on both sides."
        ),
        dive!("Damson", "damson", "At 10⁻¹⁰, power 9: green fruit on violet ground."),
        dive!(
            "Garland",
            "garland",
            "At 4 · 10⁻¹², power 6: spirals of balls, each a spiral again."
        ),
        dive!(
            "Thistle",
            "thistle",
            "At 3 · 10⁻¹³, power 12: heads of flowers, and heads of those."
        ),
        dive!(
            "Sunflower",
            "sunflower",
            "At 2 · 10⁻¹⁴, power 16: arms of seeds, each with arms of its own."
        ),
        dive!("Hive", "hive", "At 10⁻¹⁴, power 12: combs of brass about a dark bud."),
        dive!(
            "Ice flower",
            "ice-flower",
            "At 5 · 10⁻¹⁷, power 10: petals in the cold light of a pale gradient."
        ),
        dive!(
            "Frostwork",
            "frostwork",
            "At 10⁻¹⁷, power 7: a white trellis, with a bud in every gap."
        ),
        dive!("Cove", "cove", "At 8 · 10⁻²⁰, power 3: a shore that curls into itself."),
        dive!("Dahlia", "dahlia", "At 10⁻²⁰, power 16: petals about petals."),
        dive!("Artichoke", "artichoke", "At 10⁻²¹, power 16: green buds with petals about them."),
        dive!("Strata", "strata", "At 10⁻²⁴ in a Julia form of power 8: layers of rust that fold."),
        dive!(
            "Rosette",
            "rosette",
            "At 2 · 10⁻²⁶, power 8: a wreath that comes back at every scale."
        ),
    ];
    DIVES
}

/// The scene of a document that is part of the program: a test reads every one.
fn frozen(text: &str) -> Scene {
    document::from_json(text).expect("a document that a test has read")
}
