//! `mandelight scene`: prints a scene document.

use mandelight::{
    fractal::Surprise,
    reading::visible,
    scene::{
        Path, Project, document,
        path::KEY_TIME,
        presets::{self, Preset},
    },
};

use super::{
    Failure,
    fractals::OtherFractal,
    gradient::GradientArguments,
    input::{self, Change},
    look::{self, LookArguments},
    print,
};

/// The arguments of `mandelight scene`.
#[derive(clap::Args)]
pub struct SceneArguments {
    /// Print this preset instead of the first opening scene
    #[arg(long, value_name = "NAME")]
    preset: Option<String>,
    /// Print a random scene that is worth seeing; another seed gives another scene
    #[arg(long, value_name = "SEED", conflicts_with = "preset")]
    surprise: Option<u64>,
    /// List all presets: opening scenes, dives, the formulas' scenes, mixes
    #[arg(long, conflicts_with_all = ["preset", "set", "surprise", "turntable"])]
    list_presets: bool,
    /// List all looks: complete ones, colours, lights, backgrounds, tones
    #[arg(long, conflicts_with_all = ["list_presets", "look", "preset", "set", "surprise", "turntable"])]
    list_looks: bool,
    /// Add a camera path once around the scene in this time, which repeats without a seam
    #[arg(long, value_name = "SECS", value_parser = parse_secs)]
    turntable: Option<f64>,
    #[command(flatten)]
    other: OtherFractal,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    gradient: GradientArguments,
    /// Change a field, such as fractal.power=3 or lights.environment[0].intensity=2
    #[arg(long, value_name = "PATH=VALUE", value_parser = input::parse_change)]
    set: Vec<Change>,
}

/// Prints the scene document, or the list of presets or looks.
pub fn run(arguments: &SceneArguments) -> Result<(), Failure> {
    print(&text(arguments)?)
}

/// The scene document, or the list of presets or looks.
pub fn text(arguments: &SceneArguments) -> Result<String, Failure> {
    if arguments.list_looks {
        return Ok(look::list());
    }
    if arguments.list_presets {
        let names: Vec<String> = presets::all().map(Preset::id).collect();
        let width = names.iter().map(String::len).max().unwrap_or(0);
        let lines = names.iter().zip(presets::all());
        let list =
            lines.map(|(name, preset)| format!("{name:width$}  {}\n", preset.blurb)).collect();
        return Ok(list);
    }
    let wanted = arguments.preset.as_deref().map(Preset::id_of);
    let preset = presets::all()
        .find(|preset| wanted.as_ref().is_none_or(|wanted| preset.id() == *wanted))
        .ok_or_else(|| {
            let names: Vec<String> = presets::all().map(Preset::id).collect();
            let (wanted, names) = (wanted.unwrap_or_default(), names.join(", "));
            let wanted = visible(&wanted);
            Failure::usage(format!("--preset: no \"{wanted}\"; choose one of {names}"))
        })?;
    let scene = match arguments.surprise {
        Some(seed) => Surprise::new(seed).finish(),
        None => (preset.scene)(),
    };
    let scene = arguments.look.in_scene(arguments.other.in_scene(scene)?)?;
    let scene = arguments.gradient.in_scene(scene)?;
    let scene = input::changed(scene, &arguments.set)?;
    let path = match arguments.turntable {
        Some(secs) => Path::turntable(&scene, secs, Path::default().frames_per_second),
        None => Path::default(),
    };
    Ok(document::project_to_json(&Project { scene, path }))
}

/// Parses a path's length.
fn parse_secs(text: &str) -> Result<f64, String> {
    let range = 1.0..=KEY_TIME.max;
    let secs = text.parse().ok().filter(|secs| range.contains(secs));
    secs.ok_or_else(|| format!("write a number of seconds from 1 to {}", KEY_TIME.max))
}
