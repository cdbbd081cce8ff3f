//! `--integrator`, `--bounces`, `--noise`, `--denoise` and `--firefly-limit`: how the light of the picture is computed.

use std::{str::FromStr, sync::Arc};

use mandelight::scene::{
    IntegratorKind, Project, Scene,
    param::{self, Param},
};

/// Another integrator than the scene's own.
#[derive(Clone, Copy, clap::Args)]
pub struct IntegratorArguments {
    /// Compute the light by this integrator instead of the scene's
    #[arg(long, value_enum, value_name = "NAME")]
    integrator: Option<Name>,
    /// With path tracing, bounces between surfaces, instead of the scene's number
    #[arg(long, value_name = "N", value_parser = |text: &str| parse_within::<u32>(&param::BOUNCES, text))]
    bounces: Option<u32>,
    /// With path tracing, stop each pixel at this relative error; --samples is the upper limit
    #[arg(long, value_name = "ERROR", value_parser = |text: &str| parse_within::<f64>(&param::NOISE, text))]
    noise: Option<f64>,
    /// With path tracing, smooth the remaining noise; without it OpenEXR files keep their noise
    #[arg(long)]
    denoise: bool,
    /// With path tracing, limit the brightness of single paths, which leave bright dots
    #[arg(long, value_name = "RADIANCE", value_parser = |text: &str| parse_within::<f64>(&param::FIREFLY_LIMIT, text))]
    firefly_limit: Option<f64>,
}

/// An integrator's name on the command line.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Name {
    /// Light straight from the lights
    Direct,
    /// Path tracing: light that bounces between surfaces
    Path,
}

impl IntegratorArguments {
    /// Sets the integrator that is asked for.
    pub fn apply(self, scene: &mut Scene) {
        if let Some(name) = self.integrator {
            scene.integrator.kind = match name {
                Name::Direct => IntegratorKind::Direct,
                Name::Path => IntegratorKind::Path,
            };
        }
        if let Some(bounces) = self.bounces {
            scene.integrator.bounces = bounces;
        }
        if let Some(noise) = self.noise {
            scene.integrator.noise = noise;
        }
        scene.integrator.denoise |= self.denoise;
        if self.firefly_limit.is_some() {
            scene.integrator.firefly_limit = self.firefly_limit;
        }
    }

    /// What [`StillOptions::denoise`](mandelight::export::StillOptions::denoise) gets.
    pub fn denoise(self) -> Option<bool> {
        self.denoise.then_some(true)
    }

    /// Sets the integrator of a scene and of every key of its path.
    pub fn apply_to_all(self, project: &mut Project) {
        self.apply(&mut project.scene);
        for key in &mut project.path.keys {
            self.apply(Arc::make_mut(&mut key.scene));
        }
    }
}

/// Parses a number in the range of `param`.
fn parse_within<T>(param: &Param, text: &str) -> Result<T, String>
where
    T: FromStr + Copy + Into<f64>,
{
    let value: Option<T> = text.parse().ok();
    value
        .filter(|value| param.accepts((*value).into()))
        .ok_or_else(|| format!("write {}", param.range_text()))
}
