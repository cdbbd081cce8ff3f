//! `--gradient` and `--second-gradient`: other colours than the scene's own.

use std::{fs::File, io::Read as _, path::Path};

use mandelight::{
    reading::visible,
    scene::{
        GradientStop, Scene,
        gradient::{self, NamedGradient},
    },
};

use super::{Failure, shown};

/// The gradients of the two colour layers.
#[derive(clap::Args)]
pub struct GradientArguments {
    /// Colour the surface by a gradient of Mandelight, such as ember, or by a .ggr, .gpl, .map or .ugr file;
    /// FILE#NAME picks one of several in a file
    #[arg(long, value_name = "NAME|FILE")]
    gradient: Option<String>,
    /// The same for the second layer of colours, which `surface.second_layer.amount` shows
    #[arg(long, value_name = "NAME|FILE")]
    second_gradient: Option<String>,
}

impl GradientArguments {
    /// `scene` with the gradients that are asked for.
    pub fn in_scene(&self, mut scene: Scene) -> Result<Scene, Failure> {
        if let Some(asked) = &self.gradient {
            scene.surface.gradient = stops("--gradient", asked)?;
        }
        if let Some(asked) = &self.second_gradient {
            scene.surface.second_layer.gradient = stops("--second-gradient", asked)?;
        }
        Ok(scene)
    }
}

/// The stops of a gradient by its name or file.
fn stops(flag: &str, asked: &str) -> Result<Vec<GradientStop>, Failure> {
    let fail = |message: String| Failure::usage(format!("{flag}: {message}"));
    let is_called = |wanted: &str, found: &NamedGradient| {
        found.name.to_lowercase().replace(' ', "-") == wanted.to_lowercase().replace(' ', "-")
    };
    if let Some(found) = gradient::library().find(|found| is_called(asked, found)) {
        return Ok(found.stops);
    }
    // A file whose own name has a # comes first.
    let (path, name) = match asked.rsplit_once('#') {
        Some((path, name)) if !Path::new(asked).exists() => (Path::new(path), Some(name)),
        _ => (Path::new(asked), None),
    };
    if path.extension().is_none() && !path.exists() {
        let names: Vec<_> = gradient::library().map(|found| found.name.to_lowercase()).collect();
        return Err(fail(format!(
            "no gradient is called `{}`; there are {}",
            visible(asked),
            names.join(", ")
        )));
    }
    let shown = shown(path);
    let mut bytes = Vec::new();
    // One byte more than the limit, so that the reader reports a file that is too large.
    File::open(path)
        .and_then(|file| file.take(gradient::MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes))
        .map_err(|error| fail(format!("{shown}: {error}")))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let found = gradient::read(&bytes, &stem).map_err(|error| fail(format!("{shown}: {error}")))?;
    let names: Vec<_> = found.iter().map(|found| visible(&found.name).into_owned()).collect();
    let wanted = found.into_iter().find(|found| name.is_none_or(|name| is_called(name, found)));
    wanted.map(|found| found.stops).ok_or_else(|| {
        fail(format!("{shown} has no such gradient; there are {}", names.join(", ")))
    })
}
