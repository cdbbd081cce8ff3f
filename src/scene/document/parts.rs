//! The parts of a scene that a key of a path or a link names.
//!
//! A part that is not named costs nothing. So a path's keys take memory by their own text, until each gets
//! a scene of its own.

use serde::{Deserialize, Deserializer};

use crate::{
    formula::Fractal,
    scene::{
        background::Background, bloom::Bloom, camera::Camera, description::Scene, fog::Fog,
        indirect::Indirect, integrator::IntegratorSettings, lighting::Lights, medium::Medium,
        quality::Quality, surface::Surface, tone::Tone,
    },
};

/// Declares the parts of a scene: those of a key, and those of a link, which has a path among them.
macro_rules! parts {
    ($($name:ident: $type:ty),* $(,)?) => {
        /// The named parts of a key's scene.
        #[derive(Debug, Default, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct SceneParts {
            $(#[serde(deserialize_with = "named")] $name: Option<$type>,)*
        }

        impl SceneParts {
            /// Whether no part is named.
            pub fn is_empty(&self) -> bool {
                true $(&& self.$name.is_none())*
            }

            /// The scene with these parts, and those of `base` for the others.
            pub fn over(self, base: &Scene) -> Scene {
                let Scene { $($name),* } = base;
                Scene { $($name: self.$name.unwrap_or_else(|| $name.clone())),* }
            }
        }

        /// What a link holds: the parts of a scene, a path `P` among them to save bytes.
        #[derive(Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields, default, bound = "P: Default + Deserialize<'de>")]
        pub struct LinkDocument<P> {
            $(#[serde(deserialize_with = "named")] $name: Option<$type>,)*
            path: P,
        }

        impl<P> LinkDocument<P> {
            /// The parts and the path.
            pub fn split(self) -> (SceneParts, P) {
                (SceneParts { $($name: self.$name),* }, self.path)
            }
        }
    };
}

parts! {
    fractal: Fractal,
    camera: Camera,
    lights: Lights,
    surface: Surface,
    medium: Medium,
    fog: Fog,
    indirect: Indirect,
    integrator: IntegratorSettings,
    background: Background,
    tone: Tone,
    bloom: Bloom,
    quality: Quality,
}

/// Reads a part that stands there; `null` is no part.
fn named<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}
