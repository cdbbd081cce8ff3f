//! `mandelight places`: scenes at good places of a view.

use std::path::PathBuf;

use mandelight::{
    fractal::{
        FractalModel,
        places::{PlaceSearch, SearchArea},
    },
    scene::{Scene, document},
};

use super::{
    Failure,
    input::{self, Change},
    print,
};

/// The arguments of `mandelight places`.
#[derive(clap::Args)]
pub struct PlacesArguments {
    /// The scene whose view is searched: a document, or a picture that carries it; - is standard input
    scene: PathBuf,
    /// The printed scenes' distance between eye and place, in scene units; without it, the place's own shapes fill the picture
    #[arg(long, value_name = "DISTANCE", value_parser = parse_depth)]
    depth: Option<f64>,
    /// Print at most this many scenes, the best places first
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=256))]
    count: u32,
    /// The width of the view over its height
    #[arg(long, value_name = "RATIO", default_value_t = 1.5, value_parser = parse_aspect)]
    aspect: f64,
    /// Change a field of the scene first, such as fractal.power=3
    #[arg(long, value_name = "PATH=VALUE", value_parser = input::parse_change)]
    set: Vec<Change>,
}

/// Prints one scene per line.
pub fn run(arguments: PlacesArguments) -> Result<(), Failure> {
    let scene = input::changed(input::read_scene(&arguments.scene)?, &arguments.set)?;
    let model = FractalModel::new(&scene.fractal);
    let count = arguments.count as usize;
    let area = SearchArea { count: 4 * count, ..SearchArea::PICTURE };
    let places = PlaceSearch::new(&model, &scene.camera, arguments.aspect, area).finish();
    if places.is_empty() {
        return Err(Failure::failed(
            "no place in view: turn the camera toward the surface, or choose another fractal; Mandelbulbs have places",
        ));
    }
    let mut printed = 0;
    for place in places {
        let depth = arguments.depth.unwrap_or_else(|| place.arrival(&scene.camera));
        let Some(camera) = place.camera(&scene.camera, depth) else { continue };
        let scene = Scene { camera, ..scene.clone() };
        print(&format!("{}\n", document::to_json_compact(&scene)))?;
        printed += 1;
        if printed == count {
            break;
        }
    }
    Ok(())
}

fn parse_depth(text: &str) -> Result<f64, String> {
    let depth: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (1e-27..=10.0).contains(&depth) {
        Ok(depth)
    } else {
        Err("a distance is 1e-27 to 10".into())
    }
}

fn parse_aspect(text: &str) -> Result<f64, String> {
    let aspect: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (0.1..=10.0).contains(&aspect) { Ok(aspect) } else { Err("a ratio is 0.1 to 10".into()) }
}
