//! Formulas whose steps one kernel takes: a formula alone, or several in turn.

use std::sync::Arc;

use super::{
    field::{MAX_STEP, Programs, TextField},
    kernel::Compiled,
    operations,
    sequence::{ENTRY_VECTORS, FORMULA_BITS, LISTED_STEPS, Sequence},
    uniforms::Uniforms,
};
use crate::{
    formula::{
        Fractal, Kernel, KernelFiles, MarchPolicy, Packed, PackedFor, march::PLAIN_FOOTPRINT,
        param::BAILOUT, trap::MAX_TRAP,
    },
    gpu::{host_shared::HostShared, shader::File},
};

/// Finest footprint that gets iterations of its own, in scene units: an eye on the surface has none.
const FINEST_FOOTPRINT: f64 = 0.1 * PLAIN_FOOTPRINT;
/// Least footprint that needs no more than the scene's own iterations, in scene units.
const WHOLE_FOOTPRINT: f64 = 1e-3;
/// Orbit steps per halving of the footprint: enough for formulas that stretch by half or more a step.
const STEPS_PER_HALVING: f64 = 1.5;

/// Halvings of the range in which the largest bailout is searched.
const HALVINGS: u32 = 16;

/// The programs and kernel of one or several formulas.
#[derive(Clone, Debug)]
pub struct Steps {
    formulas: Arc<[Programs]>,
    files: KernelFiles,
    is_alone: bool,
}

impl Steps {
    /// A formula that draws alone. `id` names its file of operations.
    pub fn alone(id: &str, compiled: &Compiled) -> Self {
        Self::new(id, std::slice::from_ref(compiled), operations::of_one(compiled), true)
    }

    /// Formulas that take turns.
    ///
    /// All have states of one size, and all or none a given derivative.
    pub fn several(id: &str, formulas: &[Compiled]) -> Self {
        Self::new(id, formulas, operations::of_several(formulas), false)
    }

    fn new(id: &str, formulas: &[Compiled], functions: String, is_alone: bool) -> Self {
        let by = if formulas[0].checked.derivative.is_some() {
            File { path: "language/by_derivative", text: include_str!("by_derivative.wgsl") }
        } else {
            File { path: "language/by_jacobian", text: include_str!("by_jacobian.wgsl") }
        };
        // The pipelines of a formula last as long as the program, and so do its files.
        let kept = |text: String| &*Box::leak(text.into_boxed_str());
        let files = KernelFiles {
            types: File { path: "language/types", text: include_str!("types.wgsl") },
            files: vec![
                File { path: "language/orbit", text: include_str!("orbit.wgsl") },
                File { path: kept(format!("{id}/operations")), text: kept(functions) },
                by,
            ],
        };
        Self { formulas: formulas.iter().map(Programs::new).collect(), files, is_alone }
    }

    /// The WGSL files of the kernel.
    pub fn files(&self) -> &KernelFiles {
        &self.files
    }

    /// The field of a sequence of the formulas' steps.
    pub fn field(
        &self,
        sequence: Sequence,
        fractal: &Fractal,
        julia_constant: Option<[f64; 4]>,
    ) -> TextField {
        TextField::new(
            &self.formulas,
            sequence,
            fractal.iterations,
            fractal.bailout,
            julia_constant,
        )
    }

    /// Step of a ray over the estimate: the shortest that a formula asks for.
    fn march(&self) -> f64 {
        self.formulas.iter().map(|programs| programs.march).fold(1.0, f64::min)
    }

    /// The largest bailout from which no step of `sequence` overflows; infinite if none does.
    pub fn max_bailout(&self, sequence: &Sequence) -> f64 {
        let steps: Vec<_> = sequence
            .steps
            .iter()
            .map(|step| {
                (&self.formulas[step.formula], self.formulas[step.formula].slots(&step.params))
            })
            .collect();
        let overflows =
            |size: f64| steps.iter().any(|(programs, slots)| programs.overflows(slots, size));
        if !overflows(BAILOUT.max) {
            return f64::INFINITY;
        }
        let (mut low, mut high) = (BAILOUT.min, BAILOUT.max);
        for _ in 0..HALVINGS {
            let middle = (low * high).sqrt();
            *(if overflows(middle) { &mut high } else { &mut low }) = middle;
        }
        low
    }

    /// Whether a formula's estimate has false minima thinner than a pixel.
    fn checks_hits(&self) -> bool {
        self.formulas.iter().any(|programs| programs.checks_hits)
    }

    /// The overrides that specialize the kernels.
    pub fn overrides(&self) -> Vec<(&'static str, f64)> {
        vec![("CHECKS_HITS", f64::from(u8::from(self.checks_hits())))]
    }

    /// How rays march.
    pub fn march_policy(&self) -> MarchPolicy {
        let (march, usual) = (self.march(), MarchPolicy::default());
        // Shortened steps say that the estimate is no bound: longer ones would pass the surface.
        let relaxation = if march < 1.0 { 1.0 } else { usual.relaxation };
        let checks_hits = self.checks_hits();
        MarchPolicy { relaxation, ball_part: march as f32, checks_hits, ..usual }
    }

    /// Iterations of a view whose pixels have radius `footprint` at the nearest surface, in scene units.
    pub fn iterations_for(fractal: &Fractal, footprint: f64) -> u32 {
        let halvings = (WHOLE_FOOTPRINT / footprint.max(FINEST_FOOTPRINT)).max(1.0).log2();
        fractal.iterations + (STEPS_PER_HALVING * halvings).ceil() as u32
    }

    /// The uniforms and the table of a view.
    pub fn pack(
        &self,
        sequence: &Sequence,
        fractal: &Fractal,
        julia_constant: Option<[f64; 4]>,
        view: &PackedFor<'_>,
    ) -> Packed {
        let programs = |place: usize| &self.formulas[sequence.steps[place].formula];
        let leading = programs(sequence.leading);
        let bailout = fractal.bailout;
        let uniforms = Uniforms {
            julia_constant: julia_constant.unwrap_or_default().map(|x| x as f32),
            iterations: view.iterations,
            limit: if leading.tests_square { bailout * bailout } else { bailout } as f32,
            log_bailout: bailout.ln() as f32,
            max_step: (MAX_STEP * view.bounding_radius) as f32,
            march: self.march() as f32,
            addend_derivative: if julia_constant.is_some() { 0.0 } else { 1.0 },
            trap_scale: (MAX_TRAP / view.bounding_radius).min(1.0) as f32,
            initial_derivative: programs(0).initial_derivative as f32,
            is_power: f32::from(u8::from(leading.is_power)),
            has_own_distance: leading.has_own_distance.into(),
        };
        let mut slots = if self.is_alone {
            self.formulas[0].slots(&sequence.steps[0].params)
        } else {
            table(sequence, &self.formulas)
        };
        // Whole vectors of four.
        slots.resize(slots.len().next_multiple_of(4), 0.0);
        Packed {
            kernel: Kernel { formula: fractal.formula(), variant: 0 },
            uniforms: uniforms.to_bytes(),
            table: slots.iter().flat_map(|slot| (*slot as f32).to_le_bytes()).collect(),
            step_limits: None,
            series_steps: 0,
        }
    }
}

/// The table of several formulas: entries for the steps of a sequence, then each step's slots.
fn table(sequence: &Sequence, formulas: &[Programs]) -> Vec<f64> {
    let mut slots = Vec::new();
    let mut entries = Vec::new();
    for step in &sequence.steps {
        let base = ENTRY_VECTORS + slots.len() / 4;
        entries.push(((base << FORMULA_BITS) | step.formula) as f64);
        slots.extend(formulas[step.formula].slots(&step.params));
        slots.resize(slots.len().next_multiple_of(4), 0.0);
    }
    let listed = (0..LISTED_STEPS).map(|n| entries[sequence.place(n)]);
    let mut table: Vec<_> = listed.chain([entries[sequence.leading]]).collect();
    table.resize(4 * ENTRY_VECTORS, 0.0);
    table.extend(slots);
    table
}
