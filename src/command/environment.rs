//! `--environment`: an environment map from a file, and scenes lit by the map.

use std::{
    fs::File,
    io::{self, BufReader, Read as _},
    path::{Path, PathBuf},
    sync::Arc,
};

use mandelight::{
    reading::visible,
    scene::{
        BackgroundKind, EnvironmentMap, Project, Scene,
        environment_map::{
            self,
            decode::{MAX_FILE_BYTES, is_environment_map},
        },
        param::{self, Param},
    },
};

use super::{Failure, message, shown};

/// Length of the longest signature of a map, in bytes.
const SIGNATURE_BYTES: u64 = 4;

/// The arguments of an environment map.
#[derive(clap::Args)]
pub struct EnvironmentArguments {
    /// Light the scene by an environment map, Radiance (.hdr) or OpenEXR, and show the map behind
    /// the fractal
    #[arg(long, value_name = "FILE")]
    environment: Option<PathBuf>,
    /// Number of lights to divide the environment map into, 3 to 64, instead of the scene's number
    #[arg(long, value_name = "N", value_parser = parse_count, requires = "environment")]
    environment_lights: Option<u32>,
}

/// A loaded environment map and its number of lights.
pub struct Environment {
    /// The environment map.
    pub environment_map: Arc<EnvironmentMap>,
    count: Option<u32>,
}

impl EnvironmentArguments {
    /// Loads the environment map, if one was requested.
    pub fn read(&self) -> Result<Option<Environment>, Failure> {
        let Some(path) = &self.environment else { return Ok(None) };
        let environment_map = Arc::new(read(path)?);
        Ok(Some(Environment { environment_map, count: self.environment_lights }))
    }
}

impl Environment {
    /// Lights a scene by the environment map.
    pub fn surround(&self, scene: &mut Scene) {
        if let Some(count) = self.count {
            scene.lights.rig.count = count;
        }
        scene.surround_by(&self.environment_map);
    }

    /// Lights a scene and every key of its path by the environment map.
    pub fn surround_all(&self, project: &mut Project) {
        self.surround(&mut project.scene);
        for key in &mut project.path.keys {
            self.surround(Arc::make_mut(&mut key.scene));
        }
    }
}

/// Prints a warning if `scene` shows an environment map, whose file was not given.
pub fn warn_of_missing_map(scene: &Scene) {
    let name = &scene.lights.rig.environment_map.name;
    if scene.background.kind == BackgroundKind::EnvironmentMap && !name.is_empty() {
        let name = visible(name);
        message(&format!(
            "the background is {name}, which the scene does not contain: --environment FILE shows it"
        ));
    }
}

fn read(path: &Path) -> Result<EnvironmentMap, Failure> {
    let failure =
        |error: &dyn std::fmt::Display| Failure::usage(format!("{}: {error}", shown(path)));
    let file = File::open(path).map_err(|error| failure(&error))?;
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let environment_map = if file.metadata().is_ok_and(|metadata| metadata.is_file()) {
        environment_map::decode::decode_file(&name, BufReader::new(file))
    } else {
        let bytes = read_pipe(file).map_err(|error| failure(&error))?;
        environment_map::decode(&name, &bytes)
    };
    environment_map.map_err(|error| failure(&error))
}

/// Reads a pipe or a device, which cannot be read from any position. Without a map's signature, no more than the
/// signature is read.
fn read_pipe(pipe: File) -> io::Result<Vec<u8>> {
    // One byte more than the limit, so that the decoder reports a file that is too large.
    let mut pipe = pipe.take(MAX_FILE_BYTES as u64 + 1);
    let mut bytes = Vec::new();
    pipe.by_ref().take(SIGNATURE_BYTES).read_to_end(&mut bytes)?;
    if is_environment_map(&bytes) {
        pipe.read_to_end(&mut bytes)?;
    }
    Ok(bytes)
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
