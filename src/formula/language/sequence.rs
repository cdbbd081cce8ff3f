//! The order in which an orbit's steps are taken, and its place in a formula's table.

use super::uniforms::MAX_SLOTS;

/// Most steps of a hybrid, without their repeats.
pub const MAX_STEPS: usize = 9;
/// Bits of a formula's number in an entry of the table.
pub const FORMULA_BITS: u32 = 4;
/// Number of an orbit's steps that the table lists; no orbit is longer.
pub const LISTED_STEPS: u32 = 256;
/// The entry behind the listed steps: the step that computes sizes and distances.
pub const LEADING: u32 = LISTED_STEPS;
/// Vectors of the table that the entries take.
pub const ENTRY_VECTORS: usize = LISTED_STEPS as usize / 4 + 1;
/// Vectors of the table of several formulas.
pub const MAX_VECTORS: usize = ENTRY_VECTORS + MAX_STEPS * MAX_SLOTS / 4;

/// One step of a sequence.
#[derive(Clone, Debug, PartialEq)]
pub struct SequenceStep {
    /// The formula's number among those of the kernel.
    pub formula: usize,
    /// How often the step is taken before the next one.
    pub repeats: u32,
    /// The numbers of the formula's parameters.
    pub params: Vec<f64>,
}

/// Steps in order; after the last one the sequence goes on at the loop's start.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// The steps, at least one.
    pub steps: Vec<SequenceStep>,
    /// The step that follows the last one.
    pub loop_start: usize,
    /// The step whose formula computes an orbit's size and distance.
    pub leading: usize,
}

impl Sequence {
    /// A formula that draws alone.
    pub fn alone(params: Vec<f64>) -> Self {
        let step = SequenceStep { formula: 0, repeats: 1, params };
        Self { steps: vec![step], loop_start: 0, leading: 0 }
    }

    /// The place in [`Self::steps`] of an orbit's step with the number `n`, from 0.
    pub fn place(&self, n: u32) -> usize {
        let length = |steps: &[SequenceStep]| steps.iter().map(|step| step.repeats).sum::<u32>();
        let before = length(&self.steps[..self.loop_start]);
        let all = length(&self.steps);
        let mut rest = if n < all { n } else { before + (n - before) % (all - before).max(1) };
        let place = self.steps.iter().position(|step| {
            let is_here = rest < step.repeats;
            rest = rest.saturating_sub(step.repeats);
            is_here
        });
        place.unwrap_or(self.loop_start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_repeated_and_the_loop_leaves_out_those_before_its_start() {
        let steps = [2, 1, 3].map(|repeats| SequenceStep { formula: 0, repeats, params: vec![] });
        let sequence = Sequence { steps: steps.into(), loop_start: 1, leading: 0 };
        let places: Vec<_> = (0..14).map(|n| sequence.place(n)).collect();
        assert_eq!(places, [0, 0, 1, 2, 2, 2, 1, 2, 2, 2, 1, 2, 2, 2]);
    }
}
