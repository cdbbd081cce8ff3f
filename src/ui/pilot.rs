//! The pilot: input of pointer, touch and keys to movements of the camera.
//!
//! In: the view's response and this frame's commands. Out: a moved camera. The pilot interprets
//! gestures; the [`Navigator`] moves the camera.

use egui::{Context, PointerButton, Pos2, Response, Ui};
use glam::{DVec2, DVec3};

use super::{
    field::field_of,
    frame::Frame,
    home::HomeTarget,
    navigation::{
        CameraStatus, FlyInput, Navigator, Viewport, World,
        flight::{framing_alike, framing_all},
        focus::focus,
        guide::{Guide, GuideStatus},
    },
    shortcuts::{Command, HeldKeys},
    slice::{Clock, Slice},
};
use crate::{
    formula::DistanceField,
    fractal::{FractalModel, SharedModel, pixel_cone, shine},
    scene::{Camera, Scene},
};

/// Dolly per point of wheel travel, as a natural logarithm; a notch is about 100 points.
const WHEEL_PER_POINT: f64 = 0.002;
/// Dolly per press of the plus key, as a natural logarithm.
const KEY_DOLLY: f64 = 0.2;
/// Orbit per arrow key press, in half heights of the picture: 5 degrees.
const KEY_ORBIT: f64 = 1.0 / 18.0;
/// Pan per arrow key press, in half heights of the picture.
const KEY_PAN: f64 = 0.1;
/// Travel of two fingers in one frame, in points, from which on they pan.
const PAN_POINTS: f32 = 3.0;
/// Maximum pause between notches of one undo step.
const STEP_SECS: f64 = 0.5;
/// Maximum pause between notches in frames, for low frame rates.
const STEP_FRAMES: f64 = 2.5;
/// Upper limit of the pause that [`STEP_FRAMES`] gives.
const MAX_STEP_SECS: f64 = 3.0;

/// A place of the surface, and where a light reaches it from.
pub struct LitPlace {
    /// The vector from the eye to the place, in scene units.
    pub offset: DVec3,
    /// Unit vector from the place toward the light.
    pub toward_light: DVec3,
}

/// The direction of light that shows a surface best: from above and from the left of the eye.
fn key_direction(camera: &Camera) -> DVec3 {
    (camera.rotation() * DVec3::new(-0.45, 0.55, 0.7)).normalize()
}

/// The camera's input state.
#[derive(Debug, Default)]
pub struct Pilot {
    navigator: Navigator,
    guide: Guide,
    /// True if zooms are drawn to places.
    is_drawn: bool,
    keys: HeldKeys,
    flying: bool,
    /// True during a two-finger gesture.
    pinching: bool,
    /// True while a drag looks around in fly mode.
    looking: bool,
    /// Time until which further notches join the undo step, on egui's clock.
    step_until_secs: f64,
    models: SharedModel,
    /// Ends the slices of the guide's searches.
    clock: Clock,
}

impl Pilot {
    /// True in fly mode.
    pub fn is_flying(&self) -> bool {
        self.flying
    }

    /// Replaces the clock that ends slices of searches.
    pub fn set_clock(&mut self, clock: Clock) {
        self.clock = clock;
    }

    /// The flying speed, in scene units per second; 0 at rest.
    pub fn speed(&self) -> f64 {
        self.navigator.speed().unwrap_or(0.0)
    }

    /// Switches fly mode on or off.
    pub fn set_flying(&mut self, flying: bool) {
        self.flying = flying;
        self.navigator.cancel();
        self.guide.cancel();
        self.looking = false;
    }

    /// Cancels gestures and flights, because the scene was replaced.
    pub fn cancel(&mut self) {
        self.navigator.cancel();
        self.guide.cancel();
        self.guide.forget_record();
        self.pinching = false;
        self.step_until_secs = 0.0;
    }

    /// True if changes at `now_secs` continue the last movement.
    pub fn is_moving(&self, now_secs: f64) -> bool {
        self.navigator.is_active() || self.guide.is_diving() || now_secs < self.step_until_secs
    }

    /// Lets changes of the next [`STEP_SECS`] join the current undo step.
    ///
    /// At low frame rates, changes of the next [`STEP_FRAMES`] join the step.
    pub fn extend_step(&mut self, ctx: &Context) {
        let (now_secs, frame_secs) = ctx.input(|i| (i.time, f64::from(i.stable_dt)));
        let pause_secs = STEP_SECS.max(STEP_FRAMES * frame_secs).min(MAX_STEP_SECS);
        self.step_until_secs = now_secs + pause_secs;
    }

    /// The fractal by which movements are measured, to share with a view: that finds anchors.
    pub fn models(&self) -> &SharedModel {
        &self.models
    }

    /// The camera's distance to the surface and its precision.
    pub fn camera_status(&mut self, scene: &Scene, frame: Frame) -> CameraStatus {
        let viewport = viewport(scene, frame);
        let field = field_of(&self.models.of(&scene.fractal), scene, viewport);
        let nothing_ahead = self.navigator.found_nothing();
        CameraStatus {
            nothing_ahead,
            ..World { field: &*field, viewport }.camera_status(&scene.camera)
        }
    }

    /// Keeps the size at which a set shows whose shape was edited, in a view from outside.
    ///
    /// `before` is the camera's status before the edit.
    pub fn keep_framed(&mut self, scene: &mut Scene, frame: Frame, before: CameraStatus) {
        if before.is_outside {
            let viewport = viewport(scene, frame);
            let field = field_of(&self.models.of(&scene.fractal), scene, viewport);
            let world = World { field: &*field, viewport };
            scene.camera = framing_alike(&scene.camera, world, before.bounding_radius);
        }
    }

    /// What the guide does.
    pub fn guide_status(&self) -> GuideStatus {
        self.guide.status()
    }

    /// True during a dive.
    pub fn is_diving(&self) -> bool {
        self.guide.is_diving()
    }

    /// The cameras of the last dive with their times in seconds; empty without one.
    pub fn dive_record(&self) -> &[(f64, Camera)] {
        self.guide.record()
    }

    /// Forgets the cameras of the last dive.
    pub fn forget_dive(&mut self) {
        self.guide.forget_record();
    }

    /// Sets whether flights jump to their targets.
    pub fn set_jumps(&mut self, jumps: bool) {
        self.navigator.set_jumps(jumps);
    }

    /// Flies to the camera of `scene`, from `current` in the same set, otherwise from a view of the
    /// whole set.
    pub fn arrive(&mut self, scene: &mut Scene, frame: Frame, current: Option<&Camera>) {
        let to = scene.camera.clone();
        let viewport = viewport(scene, frame);
        let model = self.models.of(&scene.fractal);
        let whole = World { field: &**model.whole(), viewport };
        let from = current.cloned().unwrap_or_else(|| framing_all(&to, whole));
        scene.camera = Camera { lens: to.lens.clone(), stereo: to.stereo.clone(), ..from };
        let field = field_of(&model, scene, viewport);
        self.navigator.fly_to(&mut scene.camera, World { field: &*field, viewport }, &to);
    }

    /// Sets whether zooms are drawn to places.
    pub fn draw_to_places(&mut self, is_drawn: bool) {
        self.is_drawn = is_drawn;
    }

    /// Starts a flight to `to`, planned by the distance field about its target.
    pub fn fly_to(
        &mut self,
        scene: &mut Scene,
        frame: Frame,
        field: &dyn DistanceField,
        to: &Camera,
    ) {
        self.guide.cancel();
        let world = World { field, viewport: viewport(scene, frame) };
        self.navigator.fly_to(&mut scene.camera, world, to);
    }

    /// The surface at `at`, and where a light has to be to reach it; none for the background.
    pub fn lit_place(&self, scene: &Scene, frame: Frame, at: Pos2) -> Option<LitPlace> {
        let viewport = viewport(scene, frame);
        let field = field_of(&self.models.of(&scene.fractal), scene, viewport);
        let field = &*field;
        let camera = &scene.camera;
        let offset = World { field, viewport }.pick(camera, frame.ndc(at))?;
        let cone = pixel_cone(camera, viewport.aspect, viewport.height_px);
        let place = shine::Place {
            point: field.local(&camera.position) + offset,
            footprint: cone * offset.length(),
            toward_eye: -offset.normalize_or(camera.forward()),
        };
        let toward_light = shine::toward_light(field, &place, key_direction(camera));
        Some(LitPlace { offset, toward_light })
    }

    /// Moves the scene's camera by this frame's input.
    pub fn move_camera(
        &mut self,
        ui: &Ui,
        view: &Response,
        frame: Frame,
        scene: &mut Scene,
        home: &Camera,
        commands: &[Command],
    ) {
        let viewport = viewport(scene, frame);
        let model = self.models.of(&scene.fractal);
        let field = field_of(&model, scene, viewport);
        let mut camera = scene.camera.clone();
        let world = World { field: &*field, viewport };
        let ctx = ui.ctx();
        if ui.input(|i| i.pointer.any_pressed()) && view.contains_pointer() {
            if !self.guide.is_diving() {
                self.guide.forget_record();
            }
            self.guide.cancel();
        }
        for &command in commands {
            if command.moves_camera() {
                self.guide.cancel();
            }
            match command {
                Command::Dive => self.toggle_dive(&model, &camera, world),
                Command::Focus => {
                    focus(&mut camera, world, view.hover_pos().map(|at| frame.ndc(at)))
                }
                Command::Dolly(steps) => {
                    let amount = f64::from(steps) * KEY_DOLLY;
                    self.zoom(&model, &mut camera, world, DVec2::ZERO, amount);
                    self.extend_step(ctx);
                }
                _ => self.command(command, &mut camera, world, home, ctx),
            }
        }
        if let Some(at) = view.interact_pointer_pos().map(|at| frame.ndc(at)) {
            if view.clicked() && ui.input(|i| i.modifiers.alt && !i.modifiers.shift) {
                focus(&mut camera, world, Some(at));
            } else if view.double_clicked() && !self.flying {
                self.navigator.approach(&mut camera, world, at);
            }
        }
        self.touch(ui, &model, &mut camera, world, frame);
        if !self.pinching {
            self.drag(ui, view, &mut camera, world, frame);
        }
        self.wheel(ui, view, &model, &mut camera, world, frame);
        self.fly(ui, view, &mut camera, world);
        let dt_secs = f64::from(ctx.input(|i| i.stable_dt));
        if self.navigator.advance(&mut camera, dt_secs)
            || self.guide.advance(&model, &mut camera, world, dt_secs)
        {
            ctx.request_repaint();
        }
        scene.camera = camera;
        self.guide_work(ctx, &scene.camera, world);
    }

    /// Begins a dive, or stops the one in progress.
    fn toggle_dive(&mut self, model: &FractalModel, camera: &Camera, world: World<'_>) {
        let was_diving = self.guide.is_diving();
        self.navigator.cancel();
        self.guide.cancel();
        if !was_diving {
            self.flying = false;
            self.guide.begin_dive(model, camera, world);
        }
    }

    /// Runs searches and plans of the guide for a slice of the frame.
    fn guide_work(&mut self, ctx: &Context, camera: &Camera, world: World<'_>) {
        let mut now_ms = self.clock.0;
        let mut slice = Slice::of(ctx.input(|i| i.stable_dt), &mut now_ms);
        if slice.run(|| self.guide.work(camera, world)) {
            ctx.request_repaint();
        }
    }

    /// Zooms by a factor of `exp(amount)` at `ndc`, inward drawn to a place near the pointer.
    fn zoom(
        &mut self,
        model: &FractalModel,
        camera: &mut Camera,
        world: World<'_>,
        ndc: DVec2,
        amount: f64,
    ) {
        let is_drawn = self.is_drawn && !self.flying && amount > 0.0;
        if !(is_drawn && self.guide.zoom(model, camera, world, ndc, amount)) {
            self.guide.stop_dive();
            self.navigator.dolly(camera, world, ndc, amount);
        }
    }

    fn command(
        &mut self,
        command: Command,
        camera: &mut Camera,
        world: World<'_>,
        home: &Camera,
        ctx: &Context,
    ) {
        let wide = DVec2::new(1.0 / world.viewport.aspect, 1.0);
        let steps = |right: i8, up: i8| DVec2::new(f64::from(right), f64::from(up)) * wide;
        match command {
            Command::Home => match HomeTarget::of(camera, home) {
                Some(HomeTarget::Whole) => self.navigator.frame_all(camera, world),
                Some(HomeTarget::Opening) | None => self.navigator.fly_to(camera, world, home),
            },
            Command::FrameAll => self.navigator.frame_all(camera, world),
            Command::Orbit(right, up) => {
                self.navigator.begin_orbit(camera, world, DVec2::ZERO);
                self.navigator.drag(camera, world, -steps(right, up) * KEY_ORBIT);
                self.navigator.end();
                self.extend_step(ctx);
            }
            Command::Pan(right, up) => {
                self.navigator.begin_pan(camera, world, DVec2::ZERO);
                self.navigator.drag(camera, world, -steps(right, up) * KEY_PAN);
                self.navigator.end();
                self.extend_step(ctx);
            }
            _ => {}
        }
    }

    /// Two fingers pan and zoom; the point between the fingers stays there.
    fn touch(
        &mut self,
        ui: &Ui,
        model: &FractalModel,
        camera: &mut Camera,
        world: World<'_>,
        frame: Frame,
    ) {
        let touch = ui.input(|i| i.multi_touch());
        let Some(touch) =
            touch.filter(|touch| self.pinching || frame.rect.contains(touch.start_pos))
        else {
            if self.pinching {
                self.pinching = false;
                self.navigator.end();
            }
            return;
        };
        let ndc = frame.ndc(touch.center_pos);
        if !self.pinching {
            self.pinching = true;
            self.navigator.begin_pan(camera, world, ndc);
        }
        // Fingers that travel pan, and are not drawn to a place.
        let travelled = touch.translation_delta.length() > PAN_POINTS;
        let amount = f64::from(touch.zoom_delta).ln();
        if travelled {
            self.guide.cancel();
            self.navigator.dolly(camera, world, ndc, amount);
            self.navigator.drag(camera, world, ndc);
        } else {
            self.zoom(model, camera, world, ndc, amount);
            // The fingers grab what is under them now.
            self.navigator.begin_pan(camera, world, ndc);
        }
    }

    fn drag(
        &mut self,
        ui: &Ui,
        view: &Response,
        camera: &mut Camera,
        world: World<'_>,
        frame: Frame,
    ) {
        if view.drag_started()
            && let Some(from) = ui.input(|i| i.pointer.press_origin())
        {
            let pans = ui.input(|i| i.modifiers.shift) || !view.dragged_by(PointerButton::Primary);
            let ndc = frame.ndc(from);
            self.looking = self.flying && !pans;
            if pans {
                self.navigator.begin_pan(camera, world, ndc);
            } else if !self.looking {
                self.navigator.begin_orbit(camera, world, ndc);
            }
        }
        // At low frame rates, a drag's last movement and its end arrive in one frame.
        if (view.dragged() || view.drag_stopped())
            && !self.looking
            && let Some(at) = view.interact_pointer_pos()
        {
            self.navigator.drag(camera, world, frame.ndc(at));
        }
        if view.drag_stopped() {
            self.looking = false;
            self.navigator.end();
        }
    }

    fn wheel(
        &mut self,
        ui: &Ui,
        view: &Response,
        model: &FractalModel,
        camera: &mut Camera,
        world: World<'_>,
        frame: Frame,
    ) {
        let Some(at) = view.hover_pos().filter(|_| view.contains_pointer() && !self.pinching)
        else {
            return;
        };
        let (scrolled, zoomed) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let amount = f64::from(scrolled) * WHEEL_PER_POINT + f64::from(zoomed.max(1e-3)).ln();
        if amount != 0.0 {
            self.zoom(model, camera, world, frame.ndc(at), amount);
            self.extend_step(ui.ctx());
        }
    }

    /// Flies while keys are held or the pointer looks around.
    fn fly(&mut self, ui: &Ui, view: &Response, camera: &mut Camera, world: World<'_>) {
        self.keys.update(ui.ctx());
        if !self.flying {
            return;
        }
        let look_rad = if self.looking && view.dragged() {
            let half_angle_rad = camera.half_height(world.viewport.aspect).atan();
            let rad_per_point = 2.0 * half_angle_rad / f64::from(view.rect.height().max(1.0));
            let moved = view.drag_delta();
            DVec2::new(f64::from(moved.x), -f64::from(moved.y)) * rad_per_point
        } else {
            DVec2::ZERO
        };
        let (faster, dt_secs) = ui.input(|i| (i.modifiers.shift, f64::from(i.stable_dt)));
        let travel = DVec3::from_array(self.keys.direction());
        let input = FlyInput { travel, roll: 0.0, look_rad, faster };
        // A call with empty input resets the speed.
        self.navigator.fly(camera, world, input, dt_secs);
        if travel != DVec3::ZERO {
            self.extend_step(ui.ctx());
            ui.ctx().request_repaint();
        }
    }
}

fn viewport(scene: &Scene, frame: Frame) -> Viewport {
    Viewport {
        aspect: frame.aspect(),
        height_px: f64::from(frame.height_px.max(1)),
        detail: scene.quality.detail,
    }
}
