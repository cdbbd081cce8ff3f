//! What rays and normals have pipelines of their own for.

use super::{kernels::Constants, uniforms::Picture};

/// What rays and normals are specialised for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Form {
    /// A whole power; 0 for others.
    pub power: u32,
    /// How far their views go down.
    pub depth: Depth,
}

/// Which views kernels are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Depth {
    /// Those about the scene's origin.
    Plain,
    /// Those that are drawn from an anchor.
    Deep,
    /// Those of even powers about an anchor hard by the polar axis.
    Turning,
}

impl Depth {
    /// A picture's.
    fn of(picture: &Picture) -> Self {
        match (picture.fractal.places, picture.fractal.turns) {
            (0, _) => Self::Plain,
            (_, 0) => Self::Deep,
            _ => Self::Turning,
        }
    }
}

/// A power where it is whole; 0 for others.
fn whole(power: f32) -> u32 {
    if power.fract() == 0.0 { power as u32 } else { 0 }
}

impl Form {
    /// A picture's.
    pub fn of(picture: &Picture) -> Self {
        Self { power: whole(picture.fractal.power), depth: Depth::of(picture) }
    }

    /// Whether its views are drawn from an anchor.
    pub fn is_deep(self) -> bool {
        self.depth != Depth::Plain
    }

    /// The overrides that make it.
    pub fn constants(self) -> Constants {
        let deep = self.is_deep().then_some(("DEEP", 1.0));
        let turns = (self.depth == Depth::Turning).then_some(("TURNS", 1.0));
        [("POWER", f64::from(self.power))].into_iter().chain(deep).chain(turns).collect()
    }
}
