//! `--formula` and `--hybrid`: another fractal than the scene's own.

use std::path::PathBuf;

use clap::Args;
use mandelight::{
    formula::{
        HybridStep, HybridSteps,
        hybrid::{self, REPEATS},
    },
    scene::{Fractal, Scene},
};

use super::{Failure, formulas};

/// What is drawn instead of a scene's own fractal, seen whole.
#[derive(Args)]
pub struct OtherFractal {
    /// Draw the formula of this text, seen whole
    #[arg(long, value_name = "FILE")]
    formula: Option<PathBuf>,
    /// Draw a hybrid of these steps, seen whole: formulas in turn, with repeats, such as rotate,mandelbox*2,mandelbulb
    #[arg(long, value_name = "STEPS", value_delimiter = ',', conflicts_with = "formula")]
    hybrid: Vec<String>,
}

impl OtherFractal {
    /// `scene` with the fractal that is asked for, if any, and the camera where it sees the whole set.
    pub fn in_scene(&self, scene: Scene) -> Result<Scene, Failure> {
        let fractal = match &self.formula {
            Some(file) => Fractal::new(formulas::read(file).map_err(Failure::usage)?),
            None if self.hybrid.is_empty() => return Ok(scene),
            None => {
                let steps = self.hybrid.iter().map(|text| step(text)).collect::<Result<_, _>>()?;
                hybrid::fractal(HybridSteps { steps, loop_start: 0 })
                    .map_err(|error| Failure::usage(format!("--hybrid: {error}")))?
            }
        };
        let radius = fractal.formula().distance_field(&fractal).bounding_radius();
        Ok(Scene { fractal, camera: scene.camera.seeing_ball(radius), ..scene })
    }
}

/// A step such as `mandelbox*2`.
fn step(text: &str) -> Result<HybridStep, Failure> {
    let (id, repeats) = text.split_once('*').unwrap_or((text, "1"));
    let formula = hybrid::find_step(id.trim()).ok_or_else(|| {
        let ids: Vec<_> = hybrid::step_formulas().map(|formula| formula.id()).collect();
        Failure::usage(format!("--hybrid: no step is called `{id}`; there are {}", ids.join(", ")))
    })?;
    let mut step =
        hybrid::step(formula).map_err(|error| Failure::usage(format!("--hybrid: {error}")))?;
    let count = repeats.trim().parse().ok().filter(|count| REPEATS.accepts(f64::from(*count)));
    step.repeats = count.ok_or_else(|| {
        let range = REPEATS.range_text();
        Failure::usage(format!("--hybrid: `{text}`: repeats are {range}"))
    })?;
    Ok(step)
}
