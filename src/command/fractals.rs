//! `--formula`, `--hybrid` and `--cut`: another fractal than the scene's own, and section planes.

use std::path::PathBuf;

use clap::Args;
use mandelight::{
    formula::{
        HybridStep, HybridSteps,
        hybrid::{self, REPEATS},
        own,
        section::{MAX_SECTION_PLANES, SectionPlane},
    },
    reading::visible,
    scene::{Axis, Fractal, PrecisePoint, Scene},
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
    /// Cut the set open by planes instead of the scene's own: z=0.2 cuts away what is above z = 0.2, -z=0.2 what is
    /// below; up to three, such as z=0.2,-y=0
    #[arg(long, value_name = "PLANES", value_delimiter = ',', allow_hyphen_values = true)]
    cut: Vec<String>,
}

impl OtherFractal {
    /// `scene` with the fractal and the section planes that are asked for.
    ///
    /// The camera sees the whole of another fractal.
    pub fn in_scene(&self, scene: Scene) -> Result<Scene, Failure> {
        let mut scene = self.with_fractal(scene)?;
        if self.cut.len() > MAX_SECTION_PLANES {
            return Err(Failure::usage(format!(
                "--cut: {} are too many; a scene has at most {MAX_SECTION_PLANES} section planes",
                self.cut.len()
            )));
        }
        if !self.cut.is_empty() {
            let planes = self.cut.iter().map(|text| section_plane(text));
            scene.fractal.section_planes = planes.collect::<Result<_, _>>()?;
        }
        Ok(scene)
    }

    fn with_fractal(&self, scene: Scene) -> Result<Scene, Failure> {
        let fractal = match &self.formula {
            Some(file) => Fractal::new(formulas::read(file, own::alone).map_err(Failure::usage)?),
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

/// A plane such as `-z=0.2`.
fn section_plane(text: &str) -> Result<SectionPlane, Failure> {
    let fail = || {
        Failure::usage(format!(
            "--cut: `{}` is no plane; write an axis and a position, such as z=0 or -y=0.2",
            visible(text)
        ))
    };
    let (axis, position) = text.split_once('=').ok_or_else(fail)?;
    let (sign, axis) = match axis.trim().strip_prefix('-') {
        Some(axis) => (-1.0, axis),
        None => (1.0, axis.trim()),
    };
    let axis = match axis {
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" => Axis::Z,
        _ => return Err(fail()),
    };
    let position: f64 = position.trim().parse().map_err(|_| fail())?;
    if !position.is_finite() {
        return Err(fail());
    }
    let point = PrecisePoint::from(axis.direction() * position);
    Ok(SectionPlane {
        point,
        direction: (axis.direction() * sign).to_array(),
        ..SectionPlane::default()
    })
}

/// A step such as `mandelbox*2`.
fn step(text: &str) -> Result<HybridStep, Failure> {
    let (id, repeats) = text.split_once('*').unwrap_or((text, "1"));
    let formula = hybrid::find_step(id.trim()).ok_or_else(|| {
        let ids: Vec<_> = hybrid::step_formulas().map(|formula| formula.id()).collect();
        let (id, ids) = (visible(id), ids.join(", "));
        Failure::usage(format!("--hybrid: no step is called `{id}`; there are {ids}"))
    })?;
    let mut step =
        hybrid::step(formula).map_err(|error| Failure::usage(format!("--hybrid: {error}")))?;
    let count = repeats.trim().parse().ok().filter(|count| REPEATS.accepts(f64::from(*count)));
    step.repeats = count.ok_or_else(|| {
        let (text, range) = (visible(text), REPEATS.range_text());
        Failure::usage(format!("--hybrid: `{text}`: repeats are {range}"))
    })?;
    Ok(step)
}
