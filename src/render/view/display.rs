//! What a view's display picture holds.

use super::View;
use crate::render::display_values::DisplayValues;

impl View {
    /// Sets what the display picture holds. For stills: nothing but readback expects other than the default.
    pub fn set_display_values(&mut self, values: DisplayValues) {
        if values == self.display_values {
            return;
        }
        self.finish_display();
        self.display_values = values;
        self.fit_display();
        self.pending = self.pending.take().or_else(|| self.scene.clone());
    }

    /// Allocates the display picture if it holds something else.
    pub(super) fn fit_display(&mut self) {
        let texels = self.display_values.texels_per_pixel();
        self.targets.fit_display(&self.pipelines.layouts, self.region, texels);
    }

    /// What the display picture holds.
    pub fn display_values(&self) -> DisplayValues {
        self.display_values
    }
}
