//! The search for places of one view, in slices of a frame.

use glam::DVec2;

use super::pin::{Pin, is_near};
use crate::{
    fractal::{
        FractalModel, pixel_cone,
        places::{CameraSearch, Place, PlaceSearch, SearchArea},
    },
    scene::{Camera, PrecisePoint, Scene},
    ui::slice::Slice,
};

/// Places known at a time: the best of them becomes the next pin.
const AHEAD: usize = 4;
/// Greatest distance between place and arrival, as a part of the distance now.
const MAX_ARRIVAL: f64 = 0.5;

/// The picture in which places are searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// Width over height.
    pub aspect: f64,
    /// Height in pixels.
    pub height_px: f64,
    /// Most pins.
    pub most: usize,
    /// Least distance between pins, in half heights of the picture.
    pub spacing: f64,
}

/// The search for places of one view, and the pins found so far.
pub struct PinSearch {
    /// The scene of the search, whose camera is the searched view.
    scene: Scene,
    picture: Picture,
    search: PlaceSearch,
    /// The place whose view is searched.
    framing: Option<(Place, CameraSearch)>,
    /// Places that are pins already, or none.
    considered: Vec<PrecisePoint>,
    /// Where the pins are, in half heights of the picture.
    taken: Vec<DVec2>,
    pins: Vec<Pin>,
    /// The number of the next small picture.
    next_number: u64,
    is_over: bool,
}

impl std::fmt::Debug for PinSearch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PinSearch")
            .field("pins", &self.pins)
            .field("is_over", &self.is_over)
            .finish()
    }
}

impl PinSearch {
    /// A search of the view of `scene`; small pictures are numbered from `next_number`.
    pub fn new(model: &FractalModel, scene: &Scene, picture: Picture, next_number: u64) -> Self {
        let search = PlaceSearch::new(model, &scene.camera, picture.aspect, SearchArea::PICTURE);
        Self {
            scene: scene.clone(),
            picture,
            search,
            framing: None,
            considered: Vec::new(),
            taken: Vec::new(),
            pins: Vec::new(),
            next_number,
            is_over: false,
        }
    }

    /// The pins so far.
    pub fn pins(&self) -> &[Pin] {
        &self.pins
    }

    /// The pins so far, to arrange them.
    pub fn pins_mut(&mut self) -> &mut [Pin] {
        &mut self.pins
    }

    /// The number of the next small picture.
    pub fn next_number(&self) -> u64 {
        self.next_number
    }

    /// True once the search has ended.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    /// The part of the search that is done, 0 to 1.
    pub fn progress(&self) -> f64 {
        let found = self.taken.len() as f64 / self.picture.most.max(1) as f64;
        if self.is_over { 1.0 } else { self.search.progress().max(found) }
    }

    /// Runs steps for a slice of a frame, at least one.
    pub fn run(&mut self, slice: &mut Slice<'_>) {
        slice.run(|| self.step());
    }

    /// Drops the pins that `scene` no longer shows; false if the search is of another view.
    pub fn keep_up_with(&mut self, scene: &Scene) -> bool {
        let (searched, camera) = (&self.scene.camera, &scene.camera);
        let had_pins = !self.pins.is_empty();
        if camera != searched {
            self.pins.retain(|pin| is_near(searched, camera, &pin.place.position));
        }
        let is_gone = had_pins && self.is_over && self.pins.is_empty()
            || !is_near(searched, camera, &searched.pivot);
        self.scene.fractal == scene.fractal && !is_gone
    }

    /// Redraws the small pictures if lights, colours or other looks of `scene` have changed.
    pub fn redraw(&mut self, scene: &Scene) {
        let looks = Scene { camera: self.scene.camera.clone(), ..scene.clone() };
        if looks == self.scene {
            return;
        }
        self.scene = looks;
        for pin in &mut self.pins {
            pin.redraw(&self.scene, self.next_number);
            self.next_number += 1;
        }
    }

    /// Runs one step; returns false once the search has ended.
    fn step(&mut self) -> bool {
        if self.is_over {
            return false;
        }
        if let Some((place, search)) = &mut self.framing {
            if search.step() {
                return true;
            }
            let to = search.camera(&self.scene.camera);
            let place = place.clone();
            self.framing = None;
            if let Some(to) = to {
                self.add(place, to);
            }
        } else if self.known() < AHEAD && self.search.step() {
            return true;
        } else if let Some(place) = self.next_place() {
            self.framing = self.begin_framing(place);
        } else {
            self.is_over = true;
        }
        self.is_over |= self.taken.len() >= self.picture.most;
        !self.is_over
    }

    /// The number of places that are yet to be considered.
    fn known(&self) -> usize {
        self.search.places().len() - self.considered.len()
    }

    /// The best place that is yet to be considered.
    fn next_place(&mut self) -> Option<Place> {
        let is_new = |place: &&Place| !self.considered.contains(&place.position);
        let place = self.search.places().iter().find(is_new)?.clone();
        self.considered.push(place.position.clone());
        Some(place)
    }

    /// Begins to search the view of a place; none beside a pin, or where a flight leads nowhere.
    fn begin_framing(&self, place: Place) -> Option<(Place, CameraSearch)> {
        let at = self.in_half_heights(&place);
        if self.taken.iter().any(|taken| taken.distance(at) < self.picture.spacing) {
            return None;
        }
        let camera = &self.scene.camera;
        let cone = pixel_cone(camera, self.picture.aspect, self.picture.height_px);
        let nearest = place.field().finest_footprint() / cone;
        let depth = place.arrival(camera).max(nearest);
        let away = (&place.position - &camera.position).length();
        let search = place.begin_camera(depth).filter(|_| depth < MAX_ARRIVAL * away)?;
        Some((place, search))
    }

    fn add(&mut self, place: Place, to: Camera) {
        self.taken.push(self.in_half_heights(&place));
        self.pins.push(Pin::new(place, to, &self.scene, self.next_number));
        self.next_number += 1;
    }

    fn in_half_heights(&self, place: &Place) -> DVec2 {
        place.ndc * DVec2::new(self.picture.aspect, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PICTURE: Picture = Picture { aspect: 1.5, height_px: 400.0, most: 5, spacing: 0.3 };

    fn pin_search(scene: &Scene) -> PinSearch {
        PinSearch::new(&FractalModel::new(&scene.fractal), scene, PICTURE, 10)
    }

    #[test]
    fn pins_are_apart_and_their_pictures_have_numbers_of_their_own() {
        let mut search = pin_search(&Scene::default());
        while search.step() {}
        assert_eq!(search.progress(), 1.0);
        let pins = search.pins();
        assert_eq!(pins.len(), PICTURE.most);
        for (index, pin) in pins.iter().enumerate() {
            assert_eq!(pin.picture.id.number, 10 + index as u64);
            assert_eq!(pin.picture.scene.camera, pin.to);
            let at = |pin: &Pin| pin.place.ndc * DVec2::new(PICTURE.aspect, 1.0);
            for other in &pins[index + 1..] {
                assert!(at(pin).distance(at(other)) >= PICTURE.spacing, "{index}");
            }
            // The eye is as near as the place's own shapes are large.
            let away = (&pin.place.position - &pin.to.position).length();
            let arrival = pin.place.arrival(&Scene::default().camera);
            assert!((away / arrival - 1.0).abs() < 1e-6, "{away:e} instead of {arrival:e}");
        }
    }

    #[test]
    fn other_looks_are_other_pictures_of_the_same_views() {
        let mut scene = Scene::default();
        let mut search = pin_search(&scene);
        while search.step() {}
        let ids =
            |search: &PinSearch| search.pins().iter().map(|pin| pin.picture.id).collect::<Vec<_>>();
        let before = ids(&search);
        search.redraw(&scene);
        assert_eq!(ids(&search), before);
        scene.tone.exposure += 1.0;
        search.redraw(&scene);
        assert!(ids(&search).iter().all(|id| !before.contains(id)));
        let pin = &search.pins()[0];
        assert_eq!(pin.picture.scene.tone, scene.tone);
        assert_eq!(pin.picture.scene.camera, pin.to);
    }
}
