//! The table of all pictures of the README and the docs.
//!
//! `cargo xtask pictures` renders the table. A test checks that the README or the docs show each
//! picture with its caption.

/// A picture of the README or the docs.
pub struct Picture {
    /// The file's name in docs/pictures/, without `.png`.
    pub name: &'static str,
    /// The caption, equal to the alternative text.
    pub caption: &'static str,
    /// Approximate width and height; panels are rounded down to whole pixels.
    pub size_px: [u32; 2],
    /// Number of panels in a row.
    pub columns: u32,
    /// The panels, row by row; all rows are full.
    pub panels: Vec<Panel>,
}

impl Picture {
    /// The size of each panel, with gaps of `gap_px`.
    pub fn panel_px(&self, gap_px: u32) -> [u32; 2] {
        let rows = self.panels.len() as u32 / self.columns;
        let side = |total: u32, count: u32| (total - gap_px * (count - 1)) / count;
        [side(self.size_px[0], self.columns), side(self.size_px[1], rows)]
    }

    fn sized(self, size_px: [u32; 2]) -> Self {
        Self { size_px, ..self }
    }
}

/// A panel of a picture: one rendering.
#[derive(Clone)]
pub struct Panel {
    /// The name of a preset, or a document's path in docs/.
    pub scene: &'static str,
    /// A look of the scene, in the format of `--look`.
    pub look: Option<&'static str>,
    /// Changes of the scene, in the format of `--set`.
    pub changes: Vec<&'static str>,
    /// Samples per pixel.
    pub samples: u32,
    /// The frame of the scene's path; none for the scene itself.
    pub frame: Option<u32>,
    /// True if the environment map lights the scene.
    pub has_environment_map: bool,
    /// The shown layer of the rendering.
    pub layer: Layer,
}

/// A layer of a rendering.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// The display colour.
    Color,
    /// The distance of the surface.
    Depth,
    /// The normal of the surface.
    Normal,
}

impl Panel {
    /// True if the panel is a PNG of `mandelight render`.
    pub fn is_still(&self) -> bool {
        self.frame.is_none() && self.layer == Layer::Color
    }

    fn with(mut self, changes: &[&'static str]) -> Self {
        self.changes.extend(changes);
        self
    }

    fn frame(self, frame: u32) -> Self {
        Self { frame: Some(frame), ..self }
    }

    fn with_environment_map(self) -> Self {
        Self { has_environment_map: true, ..self }
    }

    fn layer(self, layer: Layer) -> Self {
        Self { layer, ..self }
    }
}

/// All pictures.
pub fn pictures() -> Vec<Picture> {
    vec![
        single("mandelbulb", "The power-8 Mandelbulb, as the page opens on it", of("Mandelbulb"))
            .sized([960, 540]),
        picture(
            "powers",
            4,
            "Powers 2, 3, 4.5 and 6; 8, 11 and 16, and the power 8 of the other sign",
            [
                gold("fractal.power=2"),
                gold("fractal.power=3"),
                gold("fractal.power=4.5"),
                gold("fractal.power=6"),
                gold("fractal.power=8"),
                gold("fractal.power=11"),
                gold("fractal.power=16"),
                gold("fractal.variant=negative_sine").with(&["fractal.power=8"]),
            ],
        )
        .sized(README_PX),
        single(
            "whorls",
            "A quaternion Julia set: a shell of four dimensions, cut open",
            of("Whorls"),
        )
        .sized([1280, 800]),
        single(
            "section",
            "A bulb of power 2 cut at z = 0: the Mandelbrot set with its bands of equal iterations",
            of("Mandelbrot slice"),
        )
        .sized(README_PX),
        picture(
            "looks",
            4,
            "One scene in sixteen looks",
            [
                "porcelain", "gold", "ember", "neon", "glacier", "copper", "beetle", "candy",
                "moonlight", "desert", "jade", "abyss", "ink", "clay", "sunset", "orchid",
            ]
            .map(in_look),
        )
        .sized(README_PX),
        single("lantern", "Two point lights in a crevice", of("Lantern")).sized(README_PX),
        single(
            "surroundings",
            "A bulb lit by the picture of a dusk that stands behind it",
            of("Mandelbulb").with(DUSK).with_environment_map(),
        )
        .sized(README_PX),
        picture(
            "traced",
            2,
            "Path-traced light: an open sky over a crevice, threads that glow, a lamp in a sponge, gold",
            ["Skylight", "Filigree", "Lamp", "Gold"].map(traced),
        )
        .sized([720, 450]),
        picture(
            "media",
            2,
            "Light that scatters: a bulb of jade, and a lamp in fog with a limit for fireflies",
            [
                Panel { samples: MEDIA_SAMPLES, ..of("Jade") },
                Panel {
                    samples: FOG_SAMPLES,
                    ..of("Beams").with(&["integrator.firefly_limit=6"])
                },
            ],
        )
        .sized([720, 225]),
        single("deep-light", "Path-traced light at 1e-20, in power 16", traced("Deep dahlia"))
            .sized([480, 300]),
        single("lens", "Through a lens of f/1.4, at 2e-26 in power 8", lens("Rosette"))
            .sized([720, 450]),
        picture(
            "soft",
            2,
            "A light of no size, and one of 25 degrees",
            [pierced(&[]), pierced(&["lights.environment[0].size_deg=25"])],
        )
        .sized([960, 300]),
        picture(
            "normals",
            3,
            "No normals, three samples, the exact gradient",
            [
                reef().with(&["quality.normals=none"]),
                reef().with(&["quality.normals=three"]),
                reef(),
            ],
        ),
        picture(
            "indirect",
            3,
            "Without indirect light, by the uniform operator, and by horizons",
            [
                cave("indirect.kind=off"),
                cave("indirect.kind=uniform"),
                cave("indirect.kind=horizon"),
            ],
        ),
        picture(
            "tone",
            5,
            "Cut off at 1, Reinhard's curve, ACES, AgX and Khronos Neutral",
            [
                lamp("tone.curve=linear"),
                lamp("tone.curve=reinhard"),
                lamp("tone.curve=aces"),
                lamp("tone.curve=agx"),
                lamp("tone.curve=khronos_neutral"),
            ],
        ),
        picture(
            "exposure",
            2,
            "Far too little light, and what auto exposure makes of it",
            [lamp("tone.exposure=-3"), lamp("tone.auto_exposure=true").with(&["tone.exposure=0"])],
        ),
        picture(
            "bloom",
            2,
            "Without bloom, and with it",
            [rim(), rim().with(&["bloom.strength=0.8"])],
        ),
        single("anaglyph", "A bulb for red-cyan glasses", marble("camera.stereo.layout=anaglyph")),
        // The size is that of one eye's picture.
        single(
            "stereo",
            "The views of the two eyes, side by side",
            marble("camera.stereo.layout=side_by_side"),
        )
        .sized([160, 200]),
        picture(
            "path",
            3,
            "Six frames of a flight toward the bulb, and away from another power",
            [flight(0), flight(48), flight(96), flight(144), flight(192), flight(240)],
        ),
        picture(
            "shutter",
            3,
            "The same frame with the shutter open for none, half and all of its time",
            ["path.shutter=0", "path.shutter=0.5", "path.shutter=1"].map(blurred),
        )
        .sized([960, 180]),
        picture(
            "layers",
            3,
            "Colour, depth and normals of one OpenEXR file",
            [reef(), reef().layer(Layer::Depth), reef().layer(Layer::Normal)],
        ),
        picture(
            "depth",
            2,
            "One fall into the power-16 bulb: at 2.4, 1e-5, 1e-10 and 1e-20",
            [fall(0), fall(6), fall(12), fall(24)],
        ),
        single("vine", "Bunches on twisted stems, at 1e-8 in a Julia form", of("Vine")),
        single("garland", "Spirals of balls, at 4e-12 in power 6", of("Garland")),
        single("thistle", "Heads of flowers, at 3e-13 in power 12", of("Thistle")),
        single("sunflower", "Arms of seeds, at 2e-14 in power 16", of("Sunflower"))
            .sized(README_PX),
        single("ice-flower", "Pale petals, at 5e-17 in power 10", of("Ice flower")),
        single("cove", "A shore that curls, at 8e-20 in power 3", of("Cove")),
        single("kiln", "Glazed buds over glowing arches, at 1e-5 in power 8", of("Kiln")),
        single("atoll", "Red corals on turquoise, at 1e-7 in power 5", of("Atoll")),
        single("gatehouse", "An overgrown gate, at 1e-9 in power 4", of("Gatehouse")),
        single("damson", "Green fruit on violet ground, at 1e-10 in power 9", of("Damson")),
        single("hive", "Combs of brass about a dark bud, at 1e-14 in power 12", of("Hive")),
        single("frostwork", "A white trellis with buds, at 1e-17 in power 7", of("Frostwork")),
        single("artichoke", "Green buds with petals, at 1e-21 in power 16", of("Artichoke")),
        single("strata", "Layers of rust that fold, at 1e-24 in a Julia form", of("Strata")),
        single("dahlia", "Petals about petals, at 1e-20 in power 16", of("Dahlia")),
        single("rosette", "A wreath, at 2e-26 in power 8", of("Rosette")).sized(README_PX),
    ]
}

/// Size of README's pictures, which it shows 640 pixels wide.
const README_PX: [u32; 2] = [960, 600];

/// The environment map as the only light and as the background.
const DUSK: &[&str] = &[
    "lights.environment=[]",
    "lights.rig.count=48",
    "lights.rig.picture.rotation_deg=36",
    "tone.exposure=1",
    r#"camera.position=["2", "-2.4", "-0.15"]"#,
    r#"camera.pivot=["0", "0", "0.05"]"#,
    "camera.orientation=[0.68578, 0.24829, 0.2329, 0.64328]",
    "camera.vertical_fov_deg=46",
];

fn reef() -> Panel {
    of("Coral reef")
}

/// Overhangs with little direct light.
fn cave(change: &'static str) -> Panel {
    reef().with(&["camera.vertical_fov_deg=30", "indirect.radius=0.12", change])
}

/// The bulb from nearby, in a look.
fn in_look(look: &'static str) -> Panel {
    let near = of("Mandelbulb").with(&["camera.vertical_fov_deg=38"]);
    Panel { look: Some(look), ..near }
}

fn gold(change: &'static str) -> Panel {
    of("In between").with(&["camera.vertical_fov_deg=48", change])
}

fn lamp(change: &'static str) -> Panel {
    of("Lantern").with(&["tone.exposure=1.6", change])
}

/// A mostly dark bulb in front of strong lights.
fn rim() -> Panel {
    of("Four petals").with(&[
        r#"lights.environment=[
            {"direction": [-0.36, 0.8, 0.48], "color": [1, 0.75, 0.4], "intensity": 30},
            {"direction": [0.8, 0.6, 0], "color": [0.35, 0.6, 1], "intensity": 25}
        ]"#,
        "surface.ambient=0.01",
        "bloom.radius=0.06",
        "bloom.order=before",
    ])
}

/// A pale bulb: red-cyan glasses hide a strong colour from one eye.
fn marble(change: &'static str) -> Panel {
    of("Mandelbulb").with(&[
        r#"surface.gradient=[
            {"position": 0, "color": [0.62, 0.6, 0.58]},
            {"position": 0.5, "color": [0.95, 0.93, 0.9]}
        ]"#,
        r#"camera.position=["2.16", "-3.51", "1.5525"]"#,
        "camera.stereo.eye_separation_cm=4",
        change,
    ])
}

fn flight(frame: u32) -> Panel {
    of("examples/flight.json").frame(frame)
}

fn fall(frame: u32) -> Panel {
    of("examples/fall.json").frame(frame)
}

fn of(scene: &'static str) -> Panel {
    Panel {
        scene,
        look: None,
        changes: Vec::new(),
        samples: 16,
        frame: None,
        has_environment_map: false,
        layer: Layer::Color,
    }
}

fn picture<const N: usize>(
    name: &'static str,
    columns: u32,
    caption: &'static str,
    panels: [Panel; N],
) -> Picture {
    Picture { name, caption, size_px: [320, 200], columns, panels: panels.into() }
}

/// A depth of field; blurred parts need many samples.
const LENS: &[&str] = &["camera.lens.depth_of_field=true", "camera.lens.f_number=1.4"];

fn lens(scene: &'static str) -> Panel {
    Panel { samples: SOFT_SAMPLES, ..of(scene).with(LENS) }
}

/// A frame of a fast flight, with its shutter.
fn blurred(shutter: &'static str) -> Panel {
    let panel = of("examples/flight.json").frame(32);
    Panel { samples: 64, ..panel.with(&["path.frames_per_second=6", shutter]) }
}

/// A scene in path-traced light.
fn traced(scene: &'static str) -> Panel {
    Panel { samples: TRACED_SAMPLES, ..of(scene) }
}

/// A hole in the sponge, in one light.
fn pierced(changes: &[&'static str]) -> Panel {
    let panel = of("Menger sponge").with(&[
        "lights.environment[1].muted=true",
        "lights.environment[0].intensity=3.4",
        "indirect.kind=off",
        "camera.vertical_fov_deg=16",
    ]);
    Panel { samples: SOFT_SAMPLES, ..panel.with(changes) }
}

/// Samples of pictures in path-traced light.
const TRACED_SAMPLES: u32 = 192;

/// Samples of pictures of media, whose paths are long.
const MEDIA_SAMPLES: u32 = 96;

/// Samples of pictures of lamps in fog, which few paths meet.
const FOG_SAMPLES: u32 = 384;

/// Samples of pictures with soft shadows.
const SOFT_SAMPLES: u32 = 128;

fn single(name: &'static str, caption: &'static str, panel: Panel) -> Picture {
    picture(name, 1, caption, [panel])
}
