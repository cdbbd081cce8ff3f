//! What rays and normals have pipelines of their own for.

use std::fmt;

use super::{pipelines::Constants, uniforms::FrameUniforms};

/// What rays and normals are specialised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PipelineKey {
    /// A whole power; 0 for others.
    pub power: u32,
    /// How their orbits are followed.
    pub depth: Depth,
}

/// How kernels follow orbits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Depth {
    /// In plain f32 about the scene's origin.
    Plain,
    /// By the difference to the anchor's orbit, as far as f32 needs that.
    Near(NearSteps),
    /// In frames that turn: even powers about an anchor hard by the polar axis.
    RotatingFrame,
}

/// The steps that all orbits near the anchor take together before they go on in plain f32.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct NearSteps {
    /// How many steps follow the difference: up to [`MOST_NEAR_STEPS`](super::uniforms::MOST_NEAR_STEPS),
    /// 0 where each orbit is followed by itself.
    pub count: u32,
    /// Whether a polynomial stands for the steps before them; else they are the orbit's first.
    pub has_series: bool,
}

impl Depth {
    /// Those that a dive passes, from the top down.
    pub const DIVE: [Self; 4] = [
        Self::Near(NearSteps { count: 1, has_series: false }),
        Self::Near(NearSteps { count: 2, has_series: false }),
        Self::Near(NearSteps { count: 2, has_series: true }),
        Self::Near(NearSteps { count: 4, has_series: true }),
    ];

    /// A picture's.
    fn of(picture: &FrameUniforms) -> Self {
        let fractal = &picture.fractal;
        match (fractal.reference_points, fractal.rotates) {
            (0, _) => Self::Plain,
            (_, 0) => Self::Near(NearSteps {
                count: fractal.near_steps,
                has_series: fractal.has_series != 0,
            }),
            _ => Self::RotatingFrame,
        }
    }
}

impl fmt::Display for PipelineKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "power {}, ", self.power)?;
        match self.depth {
            Depth::Plain => write!(f, "plain"),
            Depth::Near(NearSteps { count, has_series: false }) => write!(f, "{count} near"),
            Depth::Near(NearSteps { count, has_series: true }) => write!(f, "series, {count} near"),
            Depth::RotatingFrame => write!(f, "rotating frame"),
        }
    }
}

/// A power where it is whole; 0 for others.
fn whole(power: f32) -> u32 {
    if power.fract() == 0.0 { power as u32 } else { 0 }
}

impl PipelineKey {
    /// A picture's.
    pub fn of(picture: &FrameUniforms) -> Self {
        Self { power: whole(picture.fractal.power), depth: Depth::of(picture) }
    }

    /// Makes a picture one of this form, as far as that is what passes are chosen by.
    pub(super) fn put_into(self, picture: &mut FrameUniforms) {
        let fractal = &mut picture.fractal;
        fractal.power = self.power as f32;
        fractal.reference_points = self.is_deep().into();
        fractal.rotates = (self.depth == Depth::RotatingFrame).into();
        if let Depth::Near(NearSteps { count, has_series }) = self.depth {
            (fractal.near_steps, fractal.has_series) = (count, has_series.into());
        }
    }

    /// Whether its views are drawn from an anchor.
    pub fn is_deep(self) -> bool {
        self.depth != Depth::Plain
    }

    /// The overrides that make it.
    pub fn constants(self) -> Constants {
        let mut constants = vec![("POWER", f64::from(self.power))];
        if self.is_deep() {
            constants.push(("DEEP", 1.0));
        }
        match self.depth {
            Depth::Plain => (),
            Depth::Near(NearSteps { count, has_series }) => {
                constants.push(("NEAR_STEPS", f64::from(count)));
                constants.push(("HAS_SERIES", f64::from(has_series)));
            }
            Depth::RotatingFrame => constants.push(("ROTATING_FRAME", 1.0)),
        }
        constants
    }
}
