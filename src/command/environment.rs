//! An environment map from a file, and what it does to a scene.
//!
//! In: the arguments. Out: the picture, and scenes that are lit by it.

use std::{
    fs::File,
    io::Read as _,
    path::{Path, PathBuf},
    sync::Arc,
};

use mandelight::scene::{
    BackgroundKind, EnvironmentMap, Project, Scene, environment_map,
    param::{self, Param},
};

use super::{Failure, tell};

/// The surroundings that were asked for.
#[derive(clap::Args)]
pub struct EnvironmentArguments {
    /// Light the scene by an environment map, Radiance (.hdr) or OpenEXR, and show it
    #[arg(long, value_name = "FILE")]
    environment: Option<PathBuf>,
    /// How many lights to divide the picture into, 3 to 64, in place of the scene's own
    #[arg(long, value_name = "N", value_parser = parse_count, requires = "environment")]
    environment_lights: Option<u32>,
}

/// A picture that was read, and how many lights it is divided into.
pub struct Environment {
    /// The picture.
    pub environment_map: Arc<EnvironmentMap>,
    count: Option<u32>,
}

impl EnvironmentArguments {
    /// Reads the picture, where one was asked for.
    pub fn read(&self) -> Result<Option<Environment>, Failure> {
        let Some(path) = &self.environment else { return Ok(None) };
        let environment_map = Arc::new(read(path)?);
        Ok(Some(Environment { environment_map, count: self.environment_lights }))
    }
}

impl Environment {
    /// Lights a scene by the picture.
    pub fn surround(&self, scene: &mut Scene) {
        if let Some(count) = self.count {
            scene.lights.rig.count = count;
        }
        scene.surround_by(&self.environment_map);
    }

    /// Lights a scene and every key of its path by the picture.
    pub fn surround_all(&self, project: &mut Project) {
        self.surround(&mut project.scene);
        for key in &mut project.path.keys {
            self.surround(Arc::make_mut(&mut key.scene));
        }
    }
}

/// Says which picture `scene` shows, where none was given.
pub fn tell_of_missing(scene: &Scene) {
    let name = &scene.lights.rig.picture.name;
    if scene.background.kind == BackgroundKind::Picture && !name.is_empty() {
        tell(&format!(
            "the background is {name}, which is not kept with the scene: --environment FILE shows it"
        ));
    }
}

fn read(path: &Path) -> Result<EnvironmentMap, Failure> {
    let shown = path.display();
    let mut bytes = Vec::new();
    // One byte more than is decoded, so that what is too large is known as such.
    let most = environment_map::decode::MAX_FILE_BYTES as u64 + 1;
    File::open(path)
        .and_then(|file| file.take(most).read_to_end(&mut bytes))
        .map_err(|error| Failure::usage(format!("{shown}: {error}")))?;
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    environment_map::decode(&name, &bytes)
        .map_err(|error| Failure::usage(format!("{shown}: {error}")))
}

fn parse_count(text: &str) -> Result<u32, String> {
    const COUNT: Param = param::RIG_COUNT;
    let count = text.parse().map_err(|_| format!("write {}", COUNT.range_text()))?;
    if COUNT.accepts(f64::from(count)) {
        Ok(count)
    } else {
        Err(format!("{count} is outside {}", COUNT.range_text()))
    }
}
