//! Uniforms of the march: the range of rays, and how they step.

use glam::DVec3;

use super::March;
use crate::{
    formula::{MarchPolicy, StepLimits, march::THICKNESS_CHECKS},
    fractal::FractalModel,
    render::{Region, space::RenderSpace},
    scene::Scene,
};

/// Most loop turns of an invocation, over all its loops.
///
/// llvmpipe stops an invocation after 65,535 turns; other drivers have watchdogs.
const LOOP_TURNS: u32 = 65_000;

/// Loop turns of an orbit besides its steps.
const LOOPS_OF_AN_ORBIT: u32 = 8;

/// Most steps of a camera ray: the longest silhouette rays need about 300.
const MARCH_STEPS: u32 = 1024;

/// Most steps of a shadow ray.
const SHADOW_STEPS: u32 = 320;

/// Checks of a hit that must be within the hit distance, in views about an anchor.
///
/// In dust the estimate has false maxima as thin as its false minima. Plain views need all [`THICKNESS_CHECKS`]: with three, rays
/// stop at the false minima of silhouettes. With fewer than all, late steps grow more slowly: `step_escalation` in
/// `shaders/lib/over_relaxation.wgsl`.
const NEAR_CHECKS_OF_DEEP_RAYS: u32 = 3;

/// Growth of balls in views whose steps are bounds in every direction.
const UNLIMITED_GROWTH: f32 = 1e9;

/// Least hit distance in render space: below it f32 positions near the surface coincide.
const FINEST_HIT: f32 = 4e-7;

/// The march policy and its limits in a view, without those of the kernel: see [`March::with_step_limits`] and
/// [`March::with_series`].
///
/// `hit_cone` is the hit distance per unit of depth.
pub fn march(scene: &Scene, region: Region, space: &RenderSpace, hit_cone: f32) -> March {
    let model = space.model();
    let fractal = model.fractal();
    let reference = space.reference();
    let is_deep = reference.is_some();
    let footprint = space.footprint(scene, region);
    let iterations = reference.map_or_else(
        || model.iterations_for(footprint),
        |reference| {
            let finest = footprint.min(space.footprint_at_pivot(scene, region));
            reference.iterations_for(fractal, finest)
        },
    );
    let anchor = reference.map_or(DVec3::ZERO, |reference| reference.anchor().to_dvec3());
    let policy = fractal.formula().march_policy(fractal);
    March {
        anchor: anchor.as_vec3().to_array(),
        scale: space.scale() as f32,
        bounding_radius: model.bounding_radius() as f32,
        radius_beside: radius_beside(scene, model, &policy, hit_cone.into()) as f32,
        iterations,
        march_steps: march_steps(iterations, iterations, is_deep),
        shadow_steps: shadow_steps(iterations, is_deep),
        finest_hit: FINEST_HIT,
        relaxation: policy.relaxation,
        ball_growth: UNLIMITED_GROWTH,
        ball_part: policy.ball_part,
        near_checks: if is_deep { NEAR_CHECKS_OF_DEEP_RAYS } else { THICKNESS_CHECKS },
        checks_hits: policy.checks_hits.into(),
        shadow_cone: policy.shadow_cone,
        shadow_margin: policy.shadow_margin,
        shadow_min_step: policy.shadow_min_step,
    }
}

/// Radius of the sphere in which camera rays beside the bounding sphere march, in scene units.
///
/// If the bounding sphere holds the set, a ray beside it hits where the set is within the hit distance: the radius is greater
/// by the hit distance on the sphere's far side. If the sphere may cut the set, such rays miss.
fn radius_beside(scene: &Scene, model: &FractalModel, policy: &MarchPolicy, hit_cone: f64) -> f64 {
    let radius = model.bounding_radius();
    if !policy.sphere_holds_set {
        return radius;
    }
    let farthest = scene.camera.position.to_dvec3().length() + radius;
    radius + hit_cone * farthest
}

/// Most steps of a camera ray, whose orbits take `orbit_steps` at most.
///
/// Deep views use all loop turns: rays creep near the axis and in dust, and the way from a light outside the set
/// into the depth takes additional steps.
fn march_steps(iterations: u32, orbit_steps: u32, is_deep: bool) -> u32 {
    let most = if is_deep { LOOP_TURNS } else { MARCH_STEPS };
    // One more orbit, which may take all iterations, gives the colours.
    let left = LOOP_TURNS - (iterations + LOOPS_OF_AN_ORBIT);
    most.min(left / (orbit_steps + LOOPS_OF_AN_ORBIT))
}

fn shadow_steps(iterations: u32, is_deep: bool) -> u32 {
    let steps = march_steps(iterations, iterations, is_deep);
    if is_deep { steps } else { SHADOW_STEPS.min(steps) }
}

impl March {
    /// The same march within the limits of steps by the Jacobian, if the kernel has such limits.
    pub fn with_step_limits(self, limits: Option<StepLimits>) -> Self {
        match limits {
            Some(StepLimits { ball_part, ball_growth }) => Self { ball_part, ball_growth, ..self },
            None => self,
        }
    }

    /// The same march where a series approximation replaces the first `series_steps` of orbits near the anchor; 0 without one.
    ///
    /// Their turns go to more steps of rays. Orbits of points too far away for the series escape within about as many steps.
    pub fn with_series(self, series_steps: u32) -> Self {
        if series_steps == 0 {
            return self;
        }
        let orbit_steps = self.iterations.saturating_sub(series_steps).max(series_steps);
        let steps = march_steps(self.iterations, orbit_steps, true);
        Self { march_steps: steps, shadow_steps: steps, ..self }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{
        formula::{self, Fractal},
        render::uniforms::FrameUniforms,
        scene::{Camera, param},
    };

    fn march_of(scene: &Scene, height_px: u32) -> March {
        FrameUniforms::new(scene, Region::whole([height_px * 3 / 2, height_px])).march
    }

    /// llvmpipe ends an invocation at 65,535 turns.
    #[test]
    fn the_steps_and_the_colours_orbit_are_within_the_turns_of_an_invocation() {
        for iterations in [1, 16, 100, param::ITERATIONS.max as u32, 5000] {
            for is_deep in [false, true] {
                let orbits = march_steps(iterations, iterations, is_deep) + 1;
                assert!(orbits * (iterations + LOOPS_OF_AN_ORBIT) <= LOOP_TURNS, "{iterations}");
            }
        }
    }

    #[test]
    fn rays_have_the_turns_of_the_steps_that_a_series_replaces() {
        let iterations = 314;
        let steps = |series_steps| {
            let march_steps = march_steps(iterations, iterations, true);
            let march = March { iterations, march_steps, ..march_of(&Scene::default(), 24) };
            march.with_series(series_steps).march_steps
        };
        assert!(steps(iterations / 2) > 3 * steps(0) / 2);
        for series_steps in 0..=iterations {
            let orbit_steps = (iterations - series_steps).max(series_steps);
            let turns = steps(series_steps) * (orbit_steps + LOOPS_OF_AN_ORBIT);
            let turns_with_colors = turns + iterations + LOOPS_OF_AN_ORBIT;
            assert!(turns_with_colors <= LOOP_TURNS, "{series_steps}");
            assert!(steps(series_steps) >= steps(0), "{series_steps}");
        }
    }

    #[test]
    fn rays_beside_a_sphere_that_holds_the_set_march_within_a_hit_distance() {
        let mut scene = Scene {
            camera: Camera::looking_at(DVec3::new(0.0, -3.0, 0.0), DVec3::ZERO, DVec3::Z),
            ..Scene::default()
        };
        let [small, large] = [24, 240].map(|height| march_of(&scene, height));
        let wider = |march: &March| march.radius_beside - march.bounding_radius;
        let cone = f64::from(wider(&small)) / (3.0 + f64::from(small.bounding_radius));
        let half_height = (scene.camera.vertical_fov_deg.to_radians() / 2.0).tan();
        assert!((cone / (half_height / 24.0) - 1.0).abs() < 1e-3, "{cone}");
        assert!((wider(&small) / wider(&large) - 10.0).abs() < 0.01);
        scene.fractal = Fractal::new(formula::find("mandelbox").expect("a formula"));
        assert_eq!(wider(&march_of(&scene, 24)), 0.0);
    }
}
