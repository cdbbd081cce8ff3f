//! Two states of the project side by side in time: one is in view, the other is a key away.
//!
//! In: the project of each frame. Out: the project to show. Either state can be edited while it is shown.

use egui::{Button, Frame, Label, Margin, Rect, RichText, Ui, vec2};

use super::{
    floating,
    icon::{Icon, icon_button},
    rects::Rects,
    theme,
    widgets::Help as _,
};
use crate::scene::Project;

const NAMES: [&str; 2] = ["A", "B"];
/// Which state is in view, and what it is.
const CAPTIONS: [&str; 2] = [
    "A is in view: the state you began with. Edits change A.",
    "B is in view: the copy of A. Edits change B.",
];
/// Width of the caption, in points.
const CAPTION_WIDTH: f32 = 320.0;

/// The comparison of two states, while it is on.
#[derive(Debug, Default)]
pub struct Compare {
    pair: Option<Pair>,
}

#[derive(Debug)]
struct Pair {
    states: [Project; 2],
    /// The one in view.
    shown: usize,
}

impl Compare {
    /// True while two states are compared.
    pub fn is_on(&self) -> bool {
        self.pair.is_some()
    }

    /// Sets the project aside as A and goes on with a copy, B; later changes to the other state, which is
    /// returned.
    pub fn toggle(&mut self, project: &Project) -> Option<Project> {
        match &self.pair {
            Some(pair) => self.choose(1 - pair.shown),
            None => {
                let states = [project.clone(), project.clone()];
                self.pair = Some(Pair { states, shown: 1 });
                None
            }
        }
    }

    /// Ends the comparison; what is in view stays.
    pub fn end(&mut self) {
        self.pair = None;
    }

    /// Keeps the edits of the state in view. Undo may lead to the other state.
    pub fn note(&mut self, project: &Project) {
        let Some(Pair { states, shown }) = &mut self.pair else { return };
        if states[*shown] == *project {
            return;
        }
        if states[1 - *shown] == *project {
            *shown = 1 - *shown;
        } else {
            states[*shown].clone_from(project);
        }
    }

    fn choose(&mut self, index: usize) -> Option<Project> {
        let pair = self.pair.as_mut()?;
        pair.shown = index;
        pair.states.get(index).cloned()
    }

    /// Shows which state is in view, at the upper edge of the picture in `view`. Returns a chosen state.
    pub fn show(&mut self, ui: &Ui, view: Rect, rects: &mut Rects) -> Option<Project> {
        let shown = self.pair.as_ref()?.shown;
        let mut chosen = None;
        let mut ends = false;
        let area = egui::Area::new(egui::Id::unique("compare"))
            .fixed_pos(view.center_top() + vec2(0.0, floating::GAP))
            .pivot(egui::Align2::CENTER_TOP)
            .constrain_to(view);
        let area = area.show(ui.ctx(), |area| {
            let frame = Frame::new().fill(theme::PANEL.gamma_multiply(0.9));
            frame.corner_radius(theme::RADIUS).inner_margin(Margin::same(4)).show(area, |ui| {
                ui.horizontal(|ui| {
                    let side = floating::button_side(ui);
                    for (index, name) in NAMES.into_iter().enumerate() {
                        let is_shown = index == shown;
                        let button = Button::selectable(is_shown, RichText::new(name).strong());
                        let button = ui.add_sized(vec2(1.4 * side, side), button);
                        let button = button.help(format!(
                            "Show state {name}. Edits change the state in view (Shift C switches)"
                        ));
                        rects.record(["state A", "state B"][index], &button);
                        if button.clicked() && !is_shown {
                            chosen = Some(index);
                        }
                        button.accessible_name(format!("State {name}"));
                    }
                    let end = icon_button(
                        ui,
                        Icon::Cross,
                        "End the comparison",
                        "End the comparison: the state in view stays, the other is discarded (Esc)",
                    );
                    rects.record("end comparison", &end);
                    ends = end.clicked();
                });
                ui.set_max_width((view.width() - 24.0).clamp(0.0, CAPTION_WIDTH));
                let caption = RichText::new(CAPTIONS[shown]).size(12.0).color(theme::TEXT_DIM);
                let caption = ui.add(Label::new(caption).selectable(false).wrap());
                rects.record("compare caption", &caption);
            });
        });
        rects.record("compare", &area.response);
        if ends {
            self.end();
        }
        chosen.and_then(|index| self.choose(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    fn project(power: f64) -> Project {
        let mut scene = Scene::default();
        scene.tone.exposure = power;
        scene.into()
    }

    #[test]
    fn each_state_keeps_its_own_edits() {
        let mut compare = Compare::default();
        assert_eq!(compare.toggle(&project(0.0)), None);
        compare.note(&project(1.0));
        assert_eq!(compare.toggle(&project(1.0)), Some(project(0.0)), "A as it was");
        compare.note(&project(0.0));
        compare.note(&project(-1.0));
        assert_eq!(compare.toggle(&project(-1.0)), Some(project(1.0)), "B as it was left");
        // Undo leads back to A.
        compare.note(&project(1.0));
        compare.note(&project(-1.0));
        assert_eq!(compare.toggle(&project(-1.0)), Some(project(1.0)));
        compare.end();
        assert!(!compare.is_on());
    }
}
