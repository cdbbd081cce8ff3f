//! Every number of the scene document: its unit, range, default and help text.
//!
//! This is the one place. The document's checks, the panels' sliders, the command line and
//! `docs/scene.md` all read it (a test holds the docs to it).

/// What a number counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A plain ratio or exponent.
    None,
    /// A whole number of things.
    Count,
    /// Degrees of arc.
    Degrees,
    /// The fractal's own length unit; the power-8 bulb is about 2.2 of them across.
    SceneUnits,
    /// Multiples of the distance from the camera to its pivot.
    ViewUnits,
    /// Hundredths of a metre, in front of the screen.
    Centimetres,
    /// Photographic stops: one more doubles the light.
    Stops,
    /// Seconds.
    Seconds,
    /// Thousandths of a second.
    Milliseconds,
    /// Cone radii of a pixel at the depth in question.
    Footprints,
}

impl Unit {
    /// The suffix shown after a value, with its leading space where one belongs.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::None | Self::Count => "",
            Self::Degrees => "°",
            Self::SceneUnits => " u",
            Self::ViewUnits => " view",
            Self::Centimetres => " cm",
            Self::Stops => " EV",
            Self::Seconds => " s",
            Self::Milliseconds => " ms",
            Self::Footprints => " px",
        }
    }

    /// The unit in words, for hover texts and docs.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "ratio",
            Self::Count => "count",
            Self::Degrees => "degrees",
            Self::SceneUnits => "scene units",
            Self::ViewUnits => "view units (camera to pivot)",
            Self::Centimetres => "centimetres",
            Self::Stops => "stops",
            Self::Seconds => "seconds",
            Self::Milliseconds => "milliseconds",
            Self::Footprints => "pixel cone radii",
        }
    }
}

/// How a slider spreads a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal ratios; a range that starts at zero is linear close to it.
    Logarithmic,
    /// Whole numbers only.
    Integer,
}

/// One number of the document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// The field's path in the document, `[]` standing for any index.
    pub path: &'static str,
    /// The panel's name for it.
    pub label: &'static str,
    /// What it counts.
    pub unit: Unit,
    /// Smallest value accepted.
    pub min: f64,
    /// Largest value accepted.
    pub max: f64,
    /// Value in a new scene, light or stop.
    pub default: f64,
    /// How a slider spreads the range.
    pub scale: Scale,
    /// The change made by one arrow-key press or drag notch.
    pub step: f64,
    /// What it does and what higher and lower mean.
    pub help: &'static str,
}

impl Param {
    /// True where `value` is finite, in range and, for [`Scale::Integer`], whole.
    pub fn accepts(&self, value: f64) -> bool {
        value.is_finite()
            && (self.min..=self.max).contains(&value)
            && (self.scale != Scale::Integer || value.fract() == 0.0)
    }

    /// `value` within the range.
    pub const fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.min, self.max)
    }

    /// The accepted range in words: `5 to 120 degrees`; whole numbers say so.
    pub fn range_text(&self) -> String {
        let range = format!("{} to {}", self.min, self.max);
        match (self.scale, self.unit) {
            (Scale::Integer, _) => format!("{range}, whole numbers"),
            (_, Unit::None | Unit::Count) => range,
            (_, unit) => format!("{range} {}", unit.name()),
        }
    }

    /// The field's path with `index` in place of its `[]`.
    pub fn path_at(&self, index: usize) -> String {
        self.path.replacen("[]", &format!("[{index}]"), 1)
    }
}

/// The parameter that governs the field at `path`, such as `lights.environment[2].intensity`.
pub fn find(path: &str) -> Option<&'static Param> {
    let mut inside = false;
    let pattern: String = path
        .chars()
        .filter(|&c| {
            inside = c == '[' || (inside && c != ']');
            c == '[' || !inside
        })
        .collect();
    ALL.iter().copied().find(|param| param.path == pattern)
}

macro_rules! params {
    ($($name:ident = $path:literal, $label:literal, $unit:ident, $min:expr, $max:expr, default $default:expr, $scale:ident by $step:expr, $help:literal;)*) => {
        $(
            #[doc = $help]
            pub const $name: Param = Param {
                path: $path, label: $label, unit: Unit::$unit, min: $min, max: $max,
                default: $default, scale: Scale::$scale, step: $step, help: $help,
            };
        )*
        /// Every parameter, in document order.
        pub const ALL: &[&Param] = &[$(&$name),*];
    };
}

params! {
    POWER = "fractal.power", "Power", None, 2.0, 16.0, default 8.0, Linear by 0.1,
        "The exponent n of z → zⁿ + c. Whole numbers are fastest; higher gives more and smaller lobes.";
    ITERATIONS = "fractal.iterations", "Iterations", Count, 2.0, 100.0, default 16.0, Integer by 1.0,
        "The most steps an orbit is followed in a view of the whole; finer views add what they need. More shows finer detail and costs time near the surface.";
    BAILOUT = "fractal.bailout", "Bailout", SceneUnits, 2.0, 256.0, default 4.0, Logarithmic by 0.1,
        "The radius past which an orbit counts as escaped. Larger makes distances and colours smoother. At most (1.8e19)^(1/power).";
    JULIA_CONSTANT = "fractal.julia_constant[]", "Julia constant", SceneUnits, -2.0, 2.0, default 0.0, Linear by 0.01,
        "One coordinate of the constant c that the Julia form adds at every step.";
    VERTICAL_FOV = "camera.vertical_fov_deg", "Field of view", Degrees, 5.0, 120.0, default 40.0, Linear by 1.0,
        "The angle between the picture's lower and upper edges; across its width where it is taller than wide. Wider shows more and bends more.";
    SCREEN_HEIGHT = "camera.stereo.screen_height_cm", "Screen height", Centimetres, 2.0, 1000.0, default 30.0, Logarithmic by 1.0,
        "How high the picture is where it is looked at in stereo. With the distance to it this is the field of view.";
    EYE_DISTANCE = "camera.stereo.eye_distance_cm", "Eye to screen", Centimetres, 5.0, 2000.0, default 60.0, Logarithmic by 1.0,
        "How far the eyes are from the picture. Nearer is a wider field of view and more depth.";
    EYE_SEPARATION = "camera.stereo.eye_separation_cm", "Eye separation", Centimetres, 0.0, 20.0, default 6.4, Linear by 0.1,
        "How far apart the eyes are: about 6.4 for most people. Less is flatter, 0 has no depth.";
    ENVIRONMENT_INTENSITY = "lights.environment[].intensity", "Intensity", None, 0.0, 100.0, default 1.0, Logarithmic by 0.05,
        "How strong the light is: 1 lights a white surface that faces it to 1.";
    SHADOW_REACH = "lights.environment[].shadow_reach", "Shadow reach", ViewUnits, 0.001, 1000.0, default 1.0, Logarithmic by 0.1,
        "How far away a surface can be and still shade another. Shorter is brighter in crevices and faster.";
    POINT_INTENSITY = "lights.point[].intensity", "Intensity", None, 0.0, 10000.0, default 1.0, Logarithmic by 0.05,
        "How strong the light is at one scene unit; it falls with the square of the distance.";
    RIG_COUNT = "lights.rig.count", "Rig lights", Count, 3.0, 64.0, default 16.0, Integer by 1.0,
        "How many lights the sky or the picture is divided into. More follows it more closely; every one casts its own shadow and takes its time.";
    RIG_INTENSITY = "lights.rig.intensity", "Rig intensity", None, 0.0, 100.0, default 1.0, Logarithmic by 0.05,
        "Factor on all lights of the rig, and on its picture as background.";
    RIG_SHADOW_REACH = "lights.rig.shadow_reach", "Rig reach", ViewUnits, 0.001, 1000.0, default 1.0, Logarithmic by 0.1,
        "How far away a surface can be and still shade another from the rig. Shorter is brighter in crevices and faster.";
    SUN_STRENGTH = "lights.rig.sky.sun_strength", "Sun strength", None, 0.0, 100.0, default 2.0, Logarithmic by 0.05,
        "How strong the sun is: 1 lights a white surface that faces it to 1.";
    SUN_SIZE = "lights.rig.sky.sun_size_deg", "Sun size", Degrees, 0.0, 45.0, default 6.0, Linear by 0.5,
        "How wide the sun is in the sky. Wider makes softer shadows where several lights make the sun.";
    SUN_LIGHTS = "lights.rig.sky.sun_lights", "Sun lights", Count, 1.0, 32.0, default 1.0, Integer by 1.0,
        "How many of the rig's lights make the sun, spread over its disc.";
    RIG_ROTATION = "lights.rig.picture.rotation_deg", "Rotation", Degrees, -180.0, 180.0, default 0.0, Linear by 1.0,
        "Turns the environment map and its lights about the vertical axis, counterclockwise as seen from above.";
    AMBIENT = "surface.ambient", "Ambient", None, 0.0, 1.0, default 0.04, Linear by 0.01,
        "Light that reaches every point alike, as a part of the surface's colour. Higher lifts the shadows.";
    DIFFUSE = "surface.diffuse", "Diffuse", None, 0.0, 1.0, default 0.9, Linear by 0.01,
        "How much light the surface scatters in all directions.";
    SPECULAR = "surface.specular", "Specular", None, 0.0, 1.0, default 0.25, Linear by 0.01,
        "How strong the highlights are.";
    SHININESS = "surface.shininess", "Shininess", None, 1.0, 1000.0, default 40.0, Logarithmic by 1.0,
        "How tight the highlights are: the Blinn-Phong exponent.";
    COLOR_REPEATS = "surface.coloring.repeats", "Repeats", None, 0.01, 50.0, default 1.0, Logarithmic by 0.05,
        "How often the gradient runs through per unit of its driving value.";
    COLOR_OFFSET = "surface.coloring.offset", "Offset", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Where in the gradient the colours start; 0 and 1 are the same.";
    STOP_POSITION = "surface.gradient[].position", "Position", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Where along the gradient the stop lies.";
    EXPOSURE = "tone.exposure", "Exposure", Stops, -10.0, 10.0, default 0.0, Linear by 0.1,
        "Brightens or darkens the picture before the tone curve.";
    KEY = "tone.key", "Key", None, 0.01, 1.0, default 0.18, Logarithmic by 0.01,
        "What auto exposure brings the picture's mean to. Higher is brighter; 0.18 is middle grey.";
    WHITE_POINT = "tone.white_point", "White point", None, 0.5, 100.0, default 4.0, Logarithmic by 0.1,
        "The luminance that becomes pure white under Reinhard's curve. Higher keeps more of the highlights.";
    INDIRECT_RADIUS = "indirect.radius", "Radius", None, 0.002, 0.25, default 0.06, Logarithmic by 0.05,
        "How far around each point indirect light is looked for, as a part of the picture's height.";
    INDIRECT_STRENGTH = "indirect.strength", "Strength", None, 0.0, 4.0, default 1.0, Linear by 0.05,
        "How much indirect light is added.";
    INDIRECT_AMBIENT = "indirect.ambient", "Ambient factor", None, 0.0, 2.0, default 0.1, Linear by 0.01,
        "Light from nowhere in particular that what stands around a point keeps away from it.";
    INDIRECT_DIRECTIONS = "indirect.directions", "Directions", Count, 2.0, 32.0, default 8.0, Integer by 1.0,
        "How many directions on the screen are looked along. More is smoother and slower.";
    INDIRECT_SAMPLES = "indirect.samples", "Samples", Count, 1.0, 16.0, default 5.0, Integer by 1.0,
        "How many samples are taken from a point outward. More is smoother and slower.";
    BLOOM_STRENGTH = "bloom.strength", "Strength", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "How much of the spread light is added. 0 is off and costs nothing.";
    BLOOM_RADIUS = "bloom.radius", "Radius", None, 0.005, 0.25, default 0.04, Logarithmic by 0.05,
        "How far light spreads, as a part of the picture's height.";
    BLOOM_THRESHOLD = "bloom.threshold", "Threshold", None, 0.0, 10.0, default 0.5, Logarithmic by 0.05,
        "The luminance above which light spreads. 0 lets all of it spread, as in the thesis.";
    BLOOM_PASSES = "bloom.passes", "Passes", Count, 1.0, 4.0, default 3.0, Integer by 1.0,
        "How often the uniform kernel is applied. 1 gives the thesis's square glow; 3 and more are round.";
    MOTION_BUDGET = "quality.motion_budget_ms", "Motion budget", Milliseconds, 4.0, 200.0, default 16.0, Logarithmic by 1.0,
        "The GPU time a frame may take while something moves. Higher is sharper in motion and less fluid.";
    SAMPLES = "quality.samples", "Samples", Count, 1.0, 1024.0, default 16.0, Integer by 1.0,
        "How many jittered samples each pixel averages once the view rests. More is smoother.";
    DETAIL = "quality.detail", "Detail", Footprints, 0.1, 8.0, default 1.0, Logarithmic by 0.1,
        "How close a ray comes to the surface before it counts as a hit. Lower is finer and slower.";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_parameter_of_an_indexed_path() {
        assert_eq!(find("lights.environment[12].intensity"), Some(&ENVIRONMENT_INTENSITY));
        assert_eq!(find("fractal.julia_constant[2]"), Some(&JULIA_CONSTANT));
        assert_eq!(find("fractal.power"), Some(&POWER));
        assert_eq!(find("fractal.variant"), None);
        assert_eq!(find("lights.environment[[[].intensity]"), None);
    }

    #[test]
    fn every_table_row_is_consistent() {
        for (i, param) in ALL.iter().enumerate() {
            assert!(param.min < param.max && param.step > 0.0, "{}", param.path);
            assert!(param.accepts(param.default), "{}: default", param.path);
            assert!(
                param.path.matches("[]").count() <= 1,
                "{}: path_at fills one index",
                param.path
            );
            assert_eq!(find(&param.path_at(i)), Some(*param));
        }
    }

    #[test]
    fn ranges_read_well() {
        assert_eq!(VERTICAL_FOV.range_text(), "5 to 120 degrees");
        assert_eq!(SAMPLES.range_text(), "1 to 1024, whole numbers");
        assert_eq!(AMBIENT.range_text(), "0 to 1");
    }
}
