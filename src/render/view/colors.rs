//! Measures which values select the colours in view, and lets the gradient follow them.
//!
//! A moving picture's curve eases toward the newest measurement. A resting picture gets the curve of its
//! complete centre samples, so that it does not depend on the way there.

use super::{View, color_following::Reading};
use crate::{
    gpu::readback::Readback,
    render::{
        color_curve::{ColorCurve, LayerCurves},
        pass::color_histogram,
        recorder::Recorder,
    },
};

/// Part of the way to the newest measurement that a moving picture's curve goes with each.
const EASE: f64 = 0.15;

impl View {
    /// Whether the picture's colours follow what this view measures.
    fn measures_colors(&self) -> bool {
        let inputs = self.inputs.as_ref();
        self.colors.lent.is_none() && inputs.is_some_and(|inputs| inputs.follows_colors())
    }

    /// Whether further samples wait until the colours of the complete centre samples are known.
    pub(super) fn waits_for_colors(&self) -> bool {
        self.measures_colors()
            && !self.colors.is_settled
            && !self.moving
            && self.schedule.center_level() == Some(0)
    }

    /// Measures new centre samples, and applies a measurement that has arrived.
    pub(super) fn follow_colors(&mut self) {
        if !self.measures_colors() {
            self.colors.reading = None;
            return;
        }
        self.collect_colors();
        let Some(level) = self.schedule.center_level() else { return };
        let is_wanted = level == 0 || self.moving || self.colors.curves.is_none();
        // A movement that ends at a complete picture has eased toward its count, but not arrived there.
        let is_final = self.colors.is_settled || self.moving || level > 0;
        let is_measured = self.colors.measured == Some(level) && is_final;
        if self.colors.reading.is_some() || is_measured || !is_wanted {
            return;
        }
        let Some(inputs) = &self.inputs else { return };
        let passes = self.pipelines.of_frame(inputs);
        let layouts = &self.pipelines.layouts;
        let mut recorder =
            Recorder::new(layouts, &passes, &self.targets, inputs, &mut self.dispatches);
        color_histogram::record(&mut recorder, level);
        let gpu = &self.pipelines.gpu;
        gpu.queue.submit([recorder.finish()]);
        self.colors.measured = Some(level);
        self.colors.reading = Some(Reading {
            readback: Readback::buffer(gpu, &self.targets.color_bins),
            ranges: inputs.greatest_color_values(),
            is_complete: level == 0,
        });
    }

    fn collect_colors(&mut self) {
        let Some(reading) = &mut self.colors.reading else { return };
        let Ok(arrived) = reading.readback.take(&self.pipelines.gpu) else {
            // The device is lost.
            self.colors.reading = None;
            self.colors.is_settled = true;
            return;
        };
        let Some(bytes) = arrived else { return };
        let bins: Vec<u32> = bytes.as_chunks().0.iter().map(|&b| u32::from_le_bytes(b)).collect();
        let (ranges, is_final) = (reading.ranges, reading.is_complete && !self.moving);
        self.colors.reading = None;
        let (first_bins, second_bins) = bins.split_at(bins.len() / 2);
        let layer = |number: usize, bins: &[u32]| {
            let range = ranges[number];
            let before = self.colors.curves.map(|curves| curves[number]);
            // Without a hit, any curve will do.
            let goal = ColorCurve::of(bins, range).or(before);
            let goal = goal.unwrap_or_else(|| ColorCurve::line(range));
            before.filter(|_| !is_final).map_or(goal, |curve| curve.eased(&goal, EASE))
        };
        let curves = [layer(0, first_bins), layer(1, second_bins)];
        self.colors.is_settled = is_final;
        let is_first = self.colors.curves.is_none();
        self.colors.curves = Some(curves);
        // A moving picture takes it up with its next frame.
        if is_final || is_first {
            self.take_up_colors();
        }
    }

    /// Shades the picture with the curves.
    fn take_up_colors(&mut self) {
        let (Some(scene), Some(space)) = (&self.scene, &self.space) else { return };
        let inputs = self.inputs_about(scene, space);
        let stale = self.inputs.as_ref().and_then(|old| inputs.stale_since(old));
        self.upload(inputs);
        if let Some(stale) = stale {
            self.schedule.change(stale, self.moving, self.times.now_secs());
        }
    }

    /// The curves that the picture's colours follow; none if they follow none.
    pub fn color_curves(&self) -> Option<LayerCurves> {
        self.colors.curves().copied()
    }

    /// Follows the curves of a view of the whole picture instead of own ones; none ends the loan.
    ///
    /// Call this before the view has a scene.
    pub fn lend_color_curves(&mut self, curves: Option<LayerCurves>) {
        self.colors.lent = curves;
    }
}
