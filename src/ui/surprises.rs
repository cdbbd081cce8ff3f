//! Random scenes on request: the search for one, a try a frame.

use egui::Ui;

use crate::{fractal::Surprise, scene::Scene};

/// The search for a surprise, if one is in progress.
#[derive(Debug, Default)]
pub struct Surprises {
    search: Option<Surprise>,
    is_requested: bool,
}

impl Surprises {
    /// Requests a surprise.
    pub fn begin(&mut self) {
        self.is_requested = true;
    }

    /// Tries one scene, and returns it if it is worth seeing.
    pub fn advance(&mut self, ui: &Ui) -> Option<Scene> {
        if std::mem::take(&mut self.is_requested) {
            // The moment of the click is as good as dice.
            let secs = ui.input(|input| input.time);
            self.search = Some(Surprise::new(secs.to_bits()));
        }
        let found = self.search.as_mut()?.step();
        if found.is_some() {
            self.search = None;
        }
        ui.ctx().request_repaint();
        found
    }
}
