//! What holds after each action.

use egui::{Order, Shape};
use egui_kittest::kittest::NodeT as _;
use mandelight::{
    scene::{Project, document, history::MAX_STEPS},
    ui::Settings,
};

use crate::walker::Walker;

/// Most small pictures that the interface wants at a time: variations and pins.
const MAX_SMALL_PICTURES: usize = 9 + 12;
/// Parts of the interface that are whole in every ordinary window.
const WHOLE: [&str; 6] = ["view", "panel", "status", "timeline", "share window", "variations"];

/// Height of a view in which everything that floats has room, in points.
const MIN_VIEW_HEIGHT: f32 = 100.0;
/// Points by which a part may be outside of the window, for the rounding of floats.
const TOLERANCE: f32 = 0.01;
/// Frames within which everything has its place.
const SETTLING_FRAMES: usize = 6;

/// Widgets that the message of a part outside of the window names.
const SHOWN_WIDGETS: usize = 12;

/// What was checked last, and need not be again while it is the same.
#[derive(Default)]
pub struct LastChecked {
    project: Option<Project>,
    settings: Option<Settings>,
}

impl Walker {
    /// Checks the scene, its documents, the history, and what was painted.
    pub fn check(&mut self) {
        let interface = &self.harness.state().interface;
        let project = interface.project();
        if self.last_checked.project.as_ref() != Some(project) {
            assert_eq!(project.scene.validate(), Ok(()));
            assert_eq!(project.path.validate(), Ok(()));
            let text = document::project_to_json_compact(project);
            match document::project_from_json(&text) {
                Ok(read) => assert!(read == *project, "read back otherwise: {text}"),
                Err(error) => panic!("{error}: {text}"),
            }
            self.last_checked.project = Some(project.clone());
        }
        assert_eq!(interface.shown_scene().validate(), Ok(()), "the scene that is drawn");
        let steps = interface.editor().steps().count();
        assert!(steps <= MAX_STEPS, "{steps} steps");
        let small = interface.small_pictures().count();
        assert!(small <= MAX_SMALL_PICTURES, "{small} small pictures");
        let settings = interface.settings();
        if self.last_checked.settings.as_ref() != Some(settings) {
            let text = serde_json::to_string(settings).expect("settings are JSON");
            assert_eq!(serde_json::from_str::<Settings>(&text).ok().as_ref(), Some(settings));
            self.last_checked.settings = Some(settings.clone());
        }
        self.check_painting();
    }

    fn check_painting(&mut self) {
        for clipped in &self.harness.output().shapes {
            assert!(!has_nan(&clipped.shape) && !clipped.clip_rect.any_nan(), "{clipped:?}");
        }
        if !self.is_ordinary() || self.outside().is_none() {
            return;
        }
        // What has a new size or place is arranged within some frames.
        self.run_frames(SETTLING_FRAMES);
        if let Some(found) = self.outside() {
            panic!("{found} in {:?}", self.size);
        }
    }

    /// A part of the interface that is partly outside of the window.
    fn outside(&self) -> Option<String> {
        // The view and what scrolls end at a whole pixel.
        let pixel = 1.0 / self.harness.ctx.pixels_per_point();
        let window = self.window().expand(pixel + TOLERANCE);
        let rects = self.harness.state().interface.rects();
        // Panel and timeline together can leave a view that is lower than what floats over it.
        let has_room = rects.get("view").is_some_and(|view| view.height() > MIN_VIEW_HEIGHT);
        let parts = WHOLE.iter().filter_map(|name| Some((name.to_string(), rects.get(name)?)));
        let areas = self.harness.ctx.memory(|memory| {
            let layers = memory.areas().visible_layer_ids();
            let floating =
                layers.into_iter().filter(|layer| has_room && layer.order != Order::Background);
            floating
                .filter_map(|layer| Some((format!("{layer:?}"), memory.area_rect(layer.id)?)))
                .collect::<Vec<_>>()
        });
        let (what, rect) = parts.chain(areas).find(|(_, rect)| !window.contains_rect(*rect))?;
        // What is scrolled out of sight counts too.
        let nodes = self.harness.root().children_recursive();
        let nodes = nodes.filter(|node| node.accesskit_node().bounding_box().is_some());
        let inside = nodes.filter(|node| rect.x_range().contains(node.rect().center().x));
        // A row that is too wide widens those below it: the first one of each edge is the cause.
        let mut named: Vec<(f32, String)> = Vec::new();
        for node in inside {
            let inner = node.accesskit_node();
            let right = node.rect().right();
            if named.last().is_none_or(|last| right > last.0)
                && let Some(label) = inner.label().or(inner.value())
            {
                named.push((right, label));
            }
        }
        let named = &named[named.len().saturating_sub(SHOWN_WIDGETS)..];
        Some(format!("{what} is at {rect:?}, with {named:?}"))
    }
}

fn has_nan(shape: &Shape) -> bool {
    match shape {
        Shape::Vec(shapes) => shapes.iter().any(has_nan),
        // The bounds of an empty text are no numbers.
        Shape::Text(text) => text.galley.rect.translate(text.pos.to_vec2()).any_nan(),
        other => other.visual_bounding_rect().any_nan(),
    }
}
