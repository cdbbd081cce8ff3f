//! Pipelines that are compiled together, and their variants.
//!
//! A driver compiles a pipeline for the values of its overrides, so that no branch on them remains. (Where
//! lanes disagree, and always on lavapipe, all sides of a branch are computed.) So sets that take most of a
//! frame's time have special variants for the values of a frame, and a general variant, which reads the
//! values from the uniforms and draws until a special variant is compiled.

use super::{
    schedule::{Display, KeptPixels, Points, Stage, Trace, Work},
    uniforms::Inputs,
};
use crate::formula::{FormulaRef, Kernel};

/// Override values by name; a missing override keeps the shader's default.
pub type Constants = Vec<(&'static str, u32)>;

/// Pipelines that are compiled together.
pub struct PipelineSet {
    /// A name, unique among sets.
    pub name: &'static str,
    /// What the pipelines draw, as a phrase that follows "Preparing"; none takes the kernel's phrase.
    subject: Option<&'static str>,
    /// Whether the shaders follow orbits, so that each kernel has its own pipelines.
    pub has_kernel: bool,
    /// True if every picture needs the set; other sets are compiled when a picture first needs them.
    pub is_always_needed: bool,
    /// The values of a special variant, besides its kernel; none for sets without special variants.
    constants: Option<fn(&Inputs) -> Constants>,
    /// Work that rehearses the set's passes; none for sets that are never rehearsed.
    rehearsal: fn() -> Vec<Work>,
}

/// Passes that every picture needs and that have no special variants.
pub static ALWAYS: PipelineSet = PipelineSet {
    name: "always",
    subject: Some("the picture"),
    has_kernel: false,
    is_always_needed: true,
    constants: None,
    rehearsal: Vec::new,
};

/// Camera rays and shadow rays.
pub static RAYS: PipelineSet = PipelineSet {
    name: "rays",
    subject: None,
    has_kernel: true,
    is_always_needed: true,
    constants: Some(|_| Vec::new()),
    rehearsal: || vec![trace(Points::Level(0), Stage::March)],
};

/// Normals, of one kind.
pub static NORMALS: PipelineSet = PipelineSet {
    name: "normals",
    subject: None,
    has_kernel: true,
    is_always_needed: true,
    constants: Some(|inputs| vec![("NORMALS", inputs.frame.normals)]),
    rehearsal: || vec![trace(Points::Level(0), Stage::March)],
};

/// What shading and light paths compile in: the surface's model, and fog or none.
fn light_constants(inputs: &Inputs) -> Constants {
    let frame = &inputs.frame;
    vec![("HAS_FOG", u32::from(frame.fog.density > 0.0)), ("SURFACE_MODEL", frame.surface.model)]
}

/// Shading, specialised for the surface's model, and for fog, an environment map and a transparent background or none.
pub static SHADE: PipelineSet = PipelineSet {
    name: "shade",
    subject: Some("light"),
    has_kernel: false,
    is_always_needed: true,
    constants: Some(|inputs| {
        let map = ("HAS_ENVIRONMENT_MAP", u32::from(inputs.frame.background.map_gain > 0.0));
        let is_transparent = inputs.frame.background.transparent_samples > 0.0;
        let transparent = ("TRANSPARENT", u32::from(is_transparent));
        light_constants(inputs).into_iter().chain([map, transparent]).collect()
    }),
    // One trace of single samples, and one of several samples per pixel.
    rehearsal: || {
        [Points::Level(0), Points::Samples { first: 1, count: 2 }]
            .map(|points| trace(points, Stage::Shade))
            .to_vec()
    },
};

/// Tone mapping.
pub static TONE: PipelineSet = PipelineSet {
    name: "tone",
    subject: Some("tone mapping"),
    has_kernel: false,
    is_always_needed: true,
    constants: Some(|inputs| {
        let frame = &inputs.frame;
        vec![
            ("CURVE", frame.tone.curve),
            ("BLOOM", u32::from(frame.bloom.strength > 0.0)),
            ("ANAGLYPH", u32::from(frame.eyes.anaglyph != 0)),
        ]
    }),
    // One display of a whole picture, and one of a sparse lattice.
    rehearsal: || vec![display(0), display(1)],
};

/// Indirect light.
pub static INDIRECT: PipelineSet = PipelineSet {
    name: "indirect",
    subject: Some("indirect light"),
    has_kernel: false,
    is_always_needed: false,
    constants: None,
    rehearsal: || vec![trace(Points::Indirect(0), Stage::Indirect)],
};

/// Rays through the set as a medium.
pub static MEDIUM: PipelineSet = PipelineSet {
    name: "medium",
    subject: None,
    has_kernel: true,
    is_always_needed: false,
    constants: Some(|_| Vec::new()),
    rehearsal: path_rehearsal,
};

/// The vertices of light paths, specialised like shading, and for a medium or none.
pub static SCATTER: PipelineSet = PipelineSet {
    name: "scatter",
    subject: Some("light paths"),
    has_kernel: false,
    is_always_needed: false,
    constants: Some(|inputs| {
        let medium = ("HAS_MEDIUM", u32::from(inputs.traces_medium()));
        light_constants(inputs).into_iter().chain([medium]).collect()
    }),
    rehearsal: path_rehearsal,
};

/// What becomes of finished light paths.
pub static FILM_PATHS: PipelineSet = PipelineSet {
    name: "film paths",
    subject: Some("path tracing"),
    has_kernel: false,
    is_always_needed: false,
    constants: None,
    rehearsal: path_rehearsal,
};

/// The average of sub-frames.
pub static SHUTTER: PipelineSet = PipelineSet {
    name: "shutter",
    subject: Some("motion blur"),
    has_kernel: false,
    is_always_needed: false,
    constants: None,
    rehearsal: Vec::new,
};

/// The denoiser.
pub static DENOISE: PipelineSet = PipelineSet {
    name: "denoise",
    subject: Some("denoising"),
    has_kernel: false,
    is_always_needed: false,
    constants: None,
    rehearsal: || vec![display(0)],
};

/// Mean, histogram, exposure, bloom.
pub static POST: PipelineSet = PipelineSet {
    name: "post",
    subject: Some("exposure and bloom"),
    has_kernel: false,
    is_always_needed: false,
    constants: None,
    rehearsal: || vec![display(0)],
};

/// Sets with special variants.
pub const SPECIALIZED: [&PipelineSet; 6] = [&RAYS, &NORMALS, &MEDIUM, &SCATTER, &SHADE, &TONE];

fn trace(points: Points, from: Stage) -> Work {
    Work::Trace(Trace {
        points,
        from,
        lights: 1,
        first_block: 0,
        blocks: 0,
        kept: KeptPixels::default(),
        part: None,
    })
}

fn path_rehearsal() -> Vec<Work> {
    vec![trace(Points::Samples { first: 1, count: 2 }, Stage::Path)]
}

fn display(level: u32) -> Work {
    Work::Display(Display {
        level,
        fill: false,
        from_film: false,
        adapt: 1.0,
        kept: KeptPixels::default(),
        refines: false,
    })
}

impl PipelineSet {
    /// Whether the set has special variants.
    pub fn is_specialized(&self) -> bool {
        self.constants.is_some()
    }
}

impl PartialEq for PipelineSet {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for PipelineSet {}

impl std::hash::Hash for PipelineSet {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.name.hash(state);
    }
}

impl std::fmt::Debug for PipelineSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// A set's pipelines for certain values of their overrides.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PipelineVariant {
    /// The set.
    pub set: &'static PipelineSet,
    /// The formula's kernel, for sets with kernels.
    pub kernel: Option<Kernel>,
    /// Overrides, besides those of the kernel and of each pass's mode; empty in the general variant.
    pub constants: Constants,
}

impl PipelineVariant {
    /// The variant of `set` that draws a frame fastest.
    pub fn of(set: &'static PipelineSet, inputs: &Inputs) -> Self {
        Self::with_kernel(set, inputs, inputs.formula.kernel)
    }

    /// The variant of `set` that draws a frame with `kernel` fastest.
    pub fn with_kernel(set: &'static PipelineSet, inputs: &Inputs, kernel: Kernel) -> Self {
        let kernel = set.has_kernel.then_some(kernel);
        // A drag passes through many values of a general kernel, and compiling each would be too slow.
        let is_general = kernel.is_some_and(Kernel::is_general);
        let constants = set.constants.filter(|_| !is_general);
        Self { set, kernel, constants: constants.map_or_else(Vec::new, |of| of(inputs)) }
    }

    /// The general variant of `set` for plain views of `formula`.
    pub fn general_of(set: &'static PipelineSet, formula: FormulaRef) -> Self {
        let kernel = set.has_kernel.then_some(Kernel { formula, variant: 0 });
        Self { set, kernel, constants: Vec::new() }
    }

    /// The general variant of this one, which draws the same for any values; none without a general kernel.
    pub fn general(&self) -> Option<Self> {
        let kernel = match self.kernel {
            Some(kernel) => Some(kernel.general()?),
            None => None,
        };
        Some(Self { kernel, constants: Vec::new(), ..self.clone() })
    }

    /// Whether the variant reads from the uniforms the values that special variants compile in.
    pub fn is_general(&self) -> bool {
        self.set.constants.is_some() && self.general().as_ref() == Some(self)
    }

    /// What the pipelines draw, as a phrase that follows "Preparing".
    pub fn name(&self) -> String {
        match (self.set.subject, self.kernel) {
            (None, Some(kernel)) => kernel.describe(),
            (subject, _) => subject.unwrap_or(self.set.name).to_owned(),
        }
    }

    /// Work that rehearses the set's passes.
    pub fn rehearsal(&self) -> Vec<Work> {
        (self.set.rehearsal)()
    }
}

/// The special variants for a frame, one per set that has them.
pub fn specialized(inputs: &Inputs) -> Vec<PipelineVariant> {
    SPECIALIZED
        .iter()
        .filter(|set| match **set {
            set if set == &MEDIUM => inputs.traces_medium(),
            set if set == &SCATTER => inputs.traces_paths(),
            _ => true,
        })
        .map(|set| PipelineVariant::of(set, inputs))
        .collect()
}
