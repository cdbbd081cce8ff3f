//! Numeric parameters with unit, range, default and help, and the parameters of all formulas.

/// Unit of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A plain ratio or exponent.
    None,
    /// A whole number.
    Count,
    /// Degrees of arc.
    Degrees,
    /// The fractal's own length unit; the power-8 bulb is about 2.2 scene units across.
    SceneUnits,
    /// Multiples of the distance from the camera to its pivot.
    ViewUnits,
    /// Reciprocal [`Self::ViewUnits`].
    PerViewUnit,
    /// Hundredths of a metre, measured from the screen towards the viewer.
    Centimetres,
    /// Photographic stops: one stop more doubles the light.
    Stops,
    /// Seconds.
    Seconds,
    /// Thousandths of a second.
    Milliseconds,
    /// Radii of a pixel's cone at the depth in question.
    Footprints,
}

impl Unit {
    /// The suffix after a value, with a leading space if the unit has one.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::None | Self::Count | Self::SceneUnits => "",
            Self::Degrees => "°",
            Self::ViewUnits => " view",
            Self::PerViewUnit => " /view",
            Self::Centimetres => " cm",
            Self::Stops => " stops",
            Self::Seconds => " s",
            Self::Milliseconds => " ms",
            Self::Footprints => " px",
        }
    }

    /// The unit in words, for tooltips and docs.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "ratio",
            Self::Count => "count",
            Self::Degrees => "degrees",
            Self::SceneUnits => "scene units",
            Self::ViewUnits => "view units (camera to pivot)",
            Self::PerViewUnit => "per view unit",
            Self::Centimetres => "centimetres",
            Self::Stops => "stops",
            Self::Seconds => "seconds",
            Self::Milliseconds => "milliseconds",
            Self::Footprints => "pixel cone radii",
        }
    }
}

/// How a slider maps its length to a range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal steps.
    Linear,
    /// Equal ratios; a range that starts at zero is linear near zero.
    Logarithmic,
    /// Whole numbers only.
    Integer,
}

/// A numeric field of the document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// The field's path in the document; `[]` stands for any index.
    pub path: &'static str,
    /// The parameter's label in the panel.
    pub label: &'static str,
    /// The parameter's unit.
    pub unit: Unit,
    /// Least accepted value.
    pub min: f64,
    /// Greatest accepted value.
    pub max: f64,
    /// Value in a new scene, light or stop.
    pub default: f64,
    /// How a slider maps its length to the range.
    pub scale: Scale,
    /// The change made by one arrow-key press or drag notch.
    pub step: f64,
    /// What the parameter does, and what higher and lower values mean.
    pub help: &'static str,
}

impl Param {
    /// True if `value` is finite, in range and, for [`Scale::Integer`], whole.
    pub fn accepts(&self, value: f64) -> bool {
        value.is_finite()
            && (self.min..=self.max).contains(&value)
            && (self.scale != Scale::Integer || value.fract() == 0.0)
    }

    /// `value` clamped to the range.
    pub const fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.min, self.max)
    }

    /// The accepted range in words, such as `5 to 120 degrees`; integer ranges add "whole numbers".
    pub fn range_text(&self) -> String {
        let range = format!("{} to {}", self.min, self.max);
        match (self.scale, self.unit) {
            (Scale::Integer, _) => format!("{range}, whole numbers"),
            (_, Unit::None | Unit::Count) => range,
            (_, unit) => format!("{range} {}", unit.name()),
        }
    }

    /// Whether `path`, such as `lights.environment[2].intensity`, names a field of this parameter.
    pub fn is_at(&self, path: &str) -> bool {
        let mut inside = false;
        let pattern = path.chars().filter(|&c| {
            inside = c == '[' || (inside && c != ']');
            c == '[' || !inside
        });
        pattern.eq(self.path.chars())
    }

    /// The field's path with `index` instead of `[]`.
    pub fn path_at(&self, index: usize) -> String {
        self.path.replacen("[]", &format!("[{index}]"), 1)
    }
}

/// Declares parameters, and a list of them in order.
macro_rules! params {
    ($(#[$list_doc:meta])* $list:ident; $($name:ident = $path:literal, $label:literal, $unit:ident, $min:expr, $max:expr, default $default:expr, $scale:ident by $step:expr, $help:literal;)*) => {
        $(
            #[doc = $help]
            pub const $name: $crate::formula::param::Param = $crate::formula::param::Param {
                path: $path, label: $label, unit: $crate::formula::param::Unit::$unit, min: $min, max: $max,
                default: $default, scale: $crate::formula::param::Scale::$scale, step: $step, help: $help,
            };
        )*
        $(#[$list_doc])*
        pub const $list: &[&$crate::formula::param::Param] = &[$(&$name),*];
    };
}

pub(crate) use params;

params! {
    /// The parameters of every formula.
    SHARED;
    ITERATIONS = "fractal.iterations", "Iterations", Count, 2.0, 100.0, default 16.0, Integer by 1.0,
        "Maximum steps of the formula per point. More shows finer detail and is slower. Deep views add steps automatically.";
    BAILOUT = "fractal.bailout", "Bailout", SceneUnits, 2.0, 256.0, default 4.0, Logarithmic by 0.1,
        "The radius beyond which a point counts as escaped. Larger gives smoother distances and colours. Some formulas limit it further.";
    SECTION_BAND_REACH = "fractal.section_planes[].band_reach", "Band reach", SceneUnits, 0.0, 4.0, default 0.1, Linear by 0.01,
        "Width of the margin around the slice that shows bands of equal iterations. At 0 the cut shows the slice alone.";
}
