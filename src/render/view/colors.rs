//! Measures which values select the colours in view, and lets the gradient follow them.
//!
//! A moving picture's curve eases toward the newest measurement. A resting picture gets the curve of its
//! complete centre samples, so that it does not depend on the way there.

use super::{View, color_following::Reading};
use crate::{
    gpu::readback::Readback,
    render::{color_curve::ColorCurve, pass::color_histogram, recorder::Recorder},
};

/// Part of the way to the newest measurement that a moving picture's curve goes with each.
const EASE: f64 = 0.15;

impl View {
    /// Whether the picture's colours follow what this view measures.
    fn measures_colors(&self) -> bool {
        let inputs = self.inputs.as_ref();
        self.colors.lent.is_none()
            && inputs.is_some_and(|inputs| inputs.frame.surface.color_follows != 0)
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
        let is_wanted = level == 0 || self.moving || self.colors.curve.is_none();
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
            range: inputs.greatest_color_value(),
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
        let (range, is_final) = (reading.range, reading.is_complete && !self.moving);
        self.colors.reading = None;
        // Without a hit, any curve will do.
        let goal = ColorCurve::of(&bins, range);
        let goal = goal.or(self.colors.curve).unwrap_or_else(|| ColorCurve::line(range));
        let curve = match &self.colors.curve {
            Some(curve) if !is_final => curve.eased(&goal, EASE),
            _ => goal,
        };
        self.colors.is_settled = is_final;
        let is_first = self.colors.curve.is_none();
        self.colors.curve = Some(curve);
        // A moving picture takes it up with its next frame.
        if is_final || is_first {
            self.take_up_colors();
        }
    }

    /// Shades the picture with the curve.
    fn take_up_colors(&mut self) {
        let (Some(scene), Some(space)) = (&self.scene, &self.space) else { return };
        let inputs = self.inputs_about(scene, space);
        let stale = self.inputs.as_ref().and_then(|old| inputs.stale_since(old));
        self.upload(inputs);
        if let Some(stale) = stale {
            self.schedule.change(stale, self.moving, self.times.now_secs);
        }
    }

    /// The curve that the picture's colours follow; none if they follow none.
    pub fn color_curve(&self) -> Option<ColorCurve> {
        self.colors.curve().copied()
    }

    /// Follows the curve of a view of the whole picture instead of an own one; none ends the loan.
    ///
    /// Call this before the view has a scene.
    pub fn lend_color_curve(&mut self, curve: Option<ColorCurve>) {
        self.colors.lent = curve;
    }
}
