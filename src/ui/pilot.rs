//! The pilot: input of pointer, touch and keys to movements of the camera.
//!
//! In: the view's response and this frame's commands. Out: a moved camera. The pilot interprets
//! gestures; the [`Navigator`] moves the camera.

use egui::{Context, PointerButton, Rect, Response, Ui};
use glam::{DVec2, DVec3};

use super::{
    field::field_of,
    home::HomeTarget,
    navigation::{CameraStatus, FlyInput, Navigator, Viewport, World},
    shortcuts::{Command, HeldKeys},
};
use crate::{
    fractal::SharedModel,
    scene::{Camera, Scene, StereoLayout},
};

/// Dolly per point of wheel travel, as a natural logarithm; a notch is about 100 points.
const WHEEL_PER_POINT: f64 = 0.002;
/// Dolly per press of the plus key, as a natural logarithm.
const KEY_DOLLY: f64 = 0.2;
/// Orbit per arrow key press, in half heights of the picture: 5 degrees.
const KEY_ORBIT: f64 = 1.0 / 18.0;
/// Pan per arrow key press, in half heights of the picture.
const KEY_PAN: f64 = 0.1;
/// Maximum pause between notches of one undo step.
const STEP_SECS: f64 = 0.5;
/// Maximum pause between notches in frames, for low frame rates.
const STEP_FRAMES: f64 = 2.5;
/// Upper limit of the pause that [`STEP_FRAMES`] gives.
const MAX_STEP_SECS: f64 = 3.0;

/// The camera's input state.
#[derive(Debug, Default)]
pub struct Pilot {
    navigator: Navigator,
    keys: HeldKeys,
    flying: bool,
    /// True during a two-finger gesture.
    pinching: bool,
    /// True while a drag looks around in fly mode.
    looking: bool,
    /// Time until which further notches join the undo step, on egui's clock.
    step_until_secs: f64,
    models: SharedModel,
}

/// The picture's rectangle in the window.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The rectangle, in points.
    pub rect: Rect,
    /// The picture's height in pixels.
    pub height_px: u32,
}

impl Frame {
    /// A window position in normalised device coordinates of the picture.
    pub fn ndc(&self, at: egui::Pos2) -> DVec2 {
        let part = (at - self.rect.min) / self.rect.size().max(egui::Vec2::splat(1.0));
        DVec2::new(f64::from(part.x) * 2.0 - 1.0, 1.0 - f64::from(part.y) * 2.0)
    }

    /// The frame of the eye's picture at `at`; without `at`, of the first picture.
    pub fn of_eye(self, layout: StereoLayout, at: Option<egui::Pos2>) -> Self {
        let Rect { min, max } = self.rect;
        let center = self.rect.center();
        let at = at.unwrap_or(min);
        let (rect, height_px) = match layout {
            StereoLayout::Off | StereoLayout::Anaglyph => return self,
            StereoLayout::SideBySide if at.x < center.x => {
                (Rect::from_min_max(min, egui::pos2(center.x, max.y)), self.height_px)
            }
            StereoLayout::SideBySide => {
                (Rect::from_min_max(egui::pos2(center.x, min.y), max), self.height_px)
            }
            StereoLayout::TopBottom if at.y < center.y => {
                (Rect::from_min_max(min, egui::pos2(max.x, center.y)), self.height_px / 2)
            }
            StereoLayout::TopBottom => {
                (Rect::from_min_max(egui::pos2(min.x, center.y), max), self.height_px / 2)
            }
        };
        Self { rect, height_px }
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.rect.width().max(1.0)) / f64::from(self.rect.height().max(1.0))
    }
}

impl Pilot {
    /// True in fly mode.
    pub fn is_flying(&self) -> bool {
        self.flying
    }

    /// The flying speed, in scene units per second; 0 at rest.
    pub fn speed(&self) -> f64 {
        self.navigator.speed().unwrap_or(0.0)
    }

    /// Switches fly mode on or off.
    pub fn set_flying(&mut self, flying: bool) {
        self.flying = flying;
        self.navigator.cancel();
        self.looking = false;
    }

    /// Cancels gestures and flights, because the scene was replaced.
    pub fn cancel(&mut self) {
        self.navigator.cancel();
        self.pinching = false;
        self.step_until_secs = 0.0;
    }

    /// True if changes at `now_secs` continue the last movement.
    pub fn is_moving(&self, now_secs: f64) -> bool {
        self.navigator.is_active() || now_secs < self.step_until_secs
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
        World { field: &*field, viewport }.camera_status(&scene.camera)
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
        let field = field_of(&self.models.of(&scene.fractal), scene, viewport);
        let mut camera = scene.camera.clone();
        let world = World { field: &*field, viewport };
        let ctx = ui.ctx();
        for &command in commands {
            self.command(command, &mut camera, world, home, ctx);
        }
        self.touch(ui, &mut camera, world, frame);
        if !self.pinching {
            self.drag(ui, view, &mut camera, world, frame);
        }
        self.wheel(ui, view, &mut camera, world, frame);
        self.fly(ui, view, &mut camera, world);
        let dt_secs = f64::from(ctx.input(|i| i.stable_dt));
        if self.navigator.advance(&mut camera, dt_secs) {
            ctx.request_repaint();
        }
        scene.camera = camera;
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
            Command::Dolly(steps) => {
                self.navigator.dolly(camera, world, DVec2::ZERO, f64::from(steps) * KEY_DOLLY);
                self.extend_step(ctx);
            }
            _ => {}
        }
    }

    /// Two fingers pan and zoom; the point between the fingers stays there.
    fn touch(&mut self, ui: &Ui, camera: &mut Camera, world: World<'_>, frame: Frame) {
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
        self.navigator.dolly(camera, world, ndc, f64::from(touch.zoom_delta).ln());
        self.navigator.drag(camera, world, ndc);
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
            self.navigator.dolly(camera, world, frame.ndc(at), amount);
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

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn the_pointer_is_over_the_picture_of_one_eye() {
        let rect = Rect::from_min_max(pos2(100.0, 50.0), pos2(500.0, 250.0));
        let frame = Frame { rect, height_px: 400 };
        let ndc = |layout, x: f32, y: f32| {
            let at = pos2(x, y);
            frame.of_eye(layout, Some(at)).ndc(at).to_array()
        };
        // The centres of the halves are the centres of the pictures.
        assert_eq!(ndc(StereoLayout::Off, 300.0, 150.0), [0.0, 0.0]);
        assert_eq!(ndc(StereoLayout::Anaglyph, 300.0, 150.0), [0.0, 0.0]);
        for x in [200.0, 400.0] {
            assert_eq!(ndc(StereoLayout::SideBySide, x, 150.0), [0.0, 0.0]);
        }
        for y in [100.0, 200.0] {
            assert_eq!(ndc(StereoLayout::TopBottom, 300.0, y), [0.0, 0.0]);
        }
        assert_eq!(ndc(StereoLayout::SideBySide, 300.0, 50.0), [-1.0, 1.0]);
        assert_eq!(ndc(StereoLayout::TopBottom, 500.0, 150.0), [1.0, 1.0]);
        // Each eye's frame has the aspect and the height of one picture.
        let aspect_and_height = |layout, at| {
            let of_eye = frame.of_eye(layout, at);
            (of_eye.aspect(), of_eye.height_px)
        };
        assert_eq!(aspect_and_height(StereoLayout::Off, None), (2.0, 400));
        assert_eq!(aspect_and_height(StereoLayout::SideBySide, None), (1.0, 400));
        assert_eq!(aspect_and_height(StereoLayout::TopBottom, Some(rect.max)), (4.0, 200));
    }
}
