//! Whether there is a search for places, and its pins.
//!
//! In: the button, and the scene of each frame. Out: the progress, and where pins and pictures are.

use egui::{Rect, Ui};

use super::{
    arrange,
    pin::Pin,
    pin_search::{Picture, PinSearch},
};
use crate::{
    fractal::FractalModel,
    scene::{Camera, Scene},
    ui::{frame::Frame, handles, slice::Slice, small_picture::SmallPicture},
};

/// Most pins.
const MOST: usize = 12;
/// Most pins in a narrow picture.
const MOST_IF_NARROW: usize = 6;
/// Width below which a picture is narrow, in points.
const NARROW_BELOW: f32 = 520.0;
/// Least distance between pins, in points.
const SPACING: f32 = 64.0;

/// The search for places, and its pins.
#[derive(Debug, Default)]
pub struct Places {
    /// True if a search was requested and has not begun.
    is_requested: bool,
    search: Option<PinSearch>,
    /// The camera of the last frame.
    last_camera: Option<Camera>,
    is_at_rest: bool,
    /// The picture in which the pins were arranged.
    arranged_in: Option<Rect>,
    /// The number of the next small picture.
    next_number: u64,
}

/// What the search has to say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Progress {
    /// The completed part, 0 to 1.
    Searching(f64),
    /// The search waits until the camera stands still.
    Waiting,
    /// The search has ended with this many pins.
    Found(usize),
}

impl Places {
    /// True while a search runs or pins are shown.
    pub fn are_shown(&self) -> bool {
        self.is_requested || self.search.is_some()
    }

    /// Name and hover text of the button.
    pub fn button(&self) -> (&'static str, &'static str) {
        if self.are_shown() {
            ("Hide places", "Hide the pins (N, Esc)")
        } else {
            (
                "Find places",
                "Find places whose surroundings stay detailed however far you zoom in (N)",
            )
        }
    }

    /// Requests a search of the view, or puts the pins away.
    pub fn toggle(&mut self) {
        let is_requested = !self.are_shown();
        self.put_away();
        self.is_requested = is_requested;
    }

    /// Cancels the search and puts the pins away.
    pub fn put_away(&mut self) {
        self.is_requested = false;
        self.next_number =
            self.search.take().map_or(self.next_number, |search| search.next_number());
    }

    /// The progress of the search; none without one.
    pub fn progress(&self) -> Option<Progress> {
        let Some(search) = &self.search else {
            return self.is_requested.then_some(Progress::Waiting);
        };
        Some(if search.is_over() {
            Progress::Found(search.pins().len())
        } else if self.is_at_rest {
            Progress::Searching(search.progress())
        } else {
            Progress::Waiting
        })
    }

    /// The small pictures of the pins, in the order in which they are wanted.
    pub fn small_pictures(&self) -> impl Iterator<Item = &SmallPicture> + Clone {
        self.search.iter().flat_map(PinSearch::pins).map(|pin| &pin.picture)
    }

    /// Continues the search for a slice of a frame, if the camera stands still.
    ///
    /// `is_moving` announces changes of the camera. A new view or another fractal cancels the search.
    pub fn advance(
        &mut self,
        scene: &Scene,
        model: &FractalModel,
        frame: Frame,
        is_moving: bool,
        slice: &mut Slice<'_>,
    ) {
        if !self.are_shown() {
            self.last_camera = None;
            return;
        }
        let is_new = self.last_camera.as_ref().is_some_and(|last| *last != scene.camera);
        self.is_at_rest = !is_moving && !is_new;
        self.last_camera = Some(scene.camera.clone());
        if self.search.as_mut().is_some_and(|search| !search.keep_up_with(scene)) {
            self.put_away();
        }
        if !self.is_at_rest {
            return;
        }
        if std::mem::take(&mut self.is_requested) {
            let picture = picture(frame);
            self.search = Some(PinSearch::new(model, scene, picture, self.next_number));
        }
        if let Some(search) = &mut self.search {
            search.redraw(scene);
            if !search.is_over() {
                search.run(slice);
            }
        }
    }

    /// Where the pins' points and pictures are in the window; none for those out of the picture.
    ///
    /// Pictures of new pins are arranged apart from the others and from `obstacles`.
    pub fn arrange(
        &mut self,
        camera: &Camera,
        frame: Frame,
        obstacles: &[Rect],
    ) -> Vec<Option<(egui::Pos2, Rect)>> {
        let Some(search) = &mut self.search else { return Vec::new() };
        let pins = search.pins_mut();
        if self.arranged_in.replace(frame.rect) != Some(frame.rect) {
            pins.iter_mut().for_each(|pin| pin.offset = None);
        }
        let points: Vec<_> = pins
            .iter()
            .map(|pin| handles::project(camera, frame, &pin.place.position - &camera.position))
            .collect();
        let mut taken = obstacles.to_vec();
        let known = pins.iter().zip(&points).filter_map(|(pin, at)| Some((pin.offset?, (*at)?)));
        taken.extend(known.map(|(offset, at)| arrange::placed(at, offset, frame.rect)));
        let mut placed = Vec::new();
        for (index, pin) in pins.iter_mut().enumerate() {
            placed.push(points[index].map(|at| {
                let offset = *pin.offset.get_or_insert_with(|| {
                    let others = points.iter().enumerate().filter(|(other, _)| *other != index);
                    let others: Vec<_> = others.filter_map(|(_, at)| *at).collect();
                    let offset = arrange::best_offset(at, frame.rect, &taken, &others);
                    taken.push(arrange::placed(at, offset, frame.rect));
                    offset
                });
                (at, arrange::placed(at, offset, frame.rect))
            }));
        }
        placed
    }

    /// The pins.
    pub fn pins(&self) -> &[Pin] {
        self.search.as_ref().map_or(&[], |search| search.pins())
    }

    /// Requests frames while a search has work.
    pub fn request_repaint(&self, ui: &Ui) {
        match self.progress() {
            Some(Progress::Searching(_)) => ui.ctx().request_repaint(),
            Some(Progress::Waiting) => ui.ctx().request_repaint_after_secs(0.1),
            Some(Progress::Found(_)) | None => {}
        }
    }
}

fn picture(frame: Frame) -> Picture {
    let is_narrow = frame.rect.width() < NARROW_BELOW;
    Picture {
        aspect: frame.aspect(),
        height_px: f64::from(frame.height_px.max(1)),
        most: if is_narrow { MOST_IF_NARROW } else { MOST },
        spacing: f64::from(2.0 * SPACING / frame.rect.height().max(1.0)),
    }
}
