//! The structs that Rust shares with WGSL, beside [the parameters of a dispatch](super::DispatchParams).
//!
//! Their fields are in the order of their twins in `shaders/types/`; `tests/source/shaders.rs` compares
//! both. Lengths are in [render space](crate::render::space::RenderSpace) unless they say otherwise.

use crate::{
    gpu::host_shared::{Array, host_shared},
    render::report::HISTOGRAM_BINS,
};

host_shared! {
    /// Name, size in bytes and fields of every struct here.
    HOST_SHARED;
    /// The pinhole camera, axes in world space.
    Camera {
        /// The eye's position, in render space.
        origin: [f32; 3],
        /// Half the picture's height at depth one.
        half_height: f32,
        /// Unit vector to the right.
        right: [f32; 3],
        /// Width over height of the whole picture.
        aspect: f32,
        /// Unit vector upward.
        up: [f32; 3],
        /// Hit distance per unit of depth.
        hit_cone: f32,
        /// Unit vector into the picture.
        forward: [f32; 3],
        /// Distance from the surface at which colours are taken, per unit of depth along `forward`.
        color_cone: f32,
        /// Radius of the aperture, in render space; 0 for a pinhole.
        lens_radius: f32,
        /// Depth along `forward` at which the picture is sharp, in render space.
        focus: f32,
        /// Number of the aperture's blades; below 3 the aperture is a circle.
        blades: u32,
    }
    /// Indirect light.
    Indirect {
        /// 0 off, 1 uniform, 2 horizon-based.
        kind: u32,
        /// Radius of a sample's neighbourhood, over the picture's height.
        radius: f32,
        /// Factor on the indirect light that is added.
        strength: f32,
        /// The ambient factor.
        ambient: f32,
        /// Directions on the screen.
        directions: u32,
        /// Samples per direction.
        samples: u32,
        /// Size of one eye's picture of the indirect source, in pixels.
        source_px: [u32; 2],
    }
    /// The eyes that the region shows, for stereo pictures.
    Eyes {
        /// The first pixel of the second eye's part.
        second_at: [u32; 2],
        /// 1 or 2.
        count: u32,
        /// -1: the first eye is a left eye; 1: a right eye; 0: no stereo.
        first_side: f32,
        /// Distance from the camera to either eye, in render space.
        half_separation: f32,
        /// Half separation at depth one.
        half_shift: f32,
        /// Size of an eye's picture over the whole film.
        share: [f32; 2],
        /// Position of the first eye's picture on the whole film: 0 at the start, 1 at the end.
        first_place: f32,
        /// 1: both eyes in one display picture.
        anaglyph: u32,
    }
    /// The range of rays, and how they step: see [`MarchPolicy`](crate::formula::MarchPolicy).
    March {
        /// Origin of render space, in scene units.
        anchor: [f32; 3],
        /// Unit of render space, in scene units.
        scale: f32,
        /// Radius about the scene's origin of a sphere that holds what is drawn of the set, in scene units.
        bounding_radius: f32,
        /// Radius of the sphere in which camera rays beside the bounding sphere march, in scene units.
        radius_beside: f32,
        /// Most steps of an orbit.
        iterations: u32,
        /// Most steps of a camera ray.
        march_steps: u32,
        /// Most steps of a shadow ray.
        shadow_steps: u32,
        /// Least hit distance, in render space.
        finest_hit: f32,
        /// Factor of over-relaxed steps.
        relaxation: f32,
        /// Radius of the largest ball that counts as empty, over the radius of the ball before.
        ball_growth: f32,
        /// Radius of the ball that a cone treats as empty, over the safe step.
        ball_part: f32,
        /// Number of a hit's checks that must be within the hit distance.
        near_checks: u32,
        /// 1 if the estimate has false minima.
        checks_hits: u32,
        /// Radius of a shadow ray's cone, per unit of distance to the point.
        shadow_cone: f32,
        /// Least clearance of an unblocked shadow ray, in hit distances.
        shadow_margin: f32,
        /// Least step of a shadow ray, in hit distances.
        shadow_min_step: f32,
    }
    /// Blinn-Phong terms.
    Surface {
        /// Part of the colour that is visible without light.
        ambient: f32,
        /// Diffuse reflectance.
        diffuse: f32,
        /// Specular reflectance.
        specular: f32,
        /// Blinn-Phong exponent.
        shininess: f32,
        /// Number of lights in use.
        light_count: u32,
        /// 0 Blinn-Phong, 1 physical.
        model: u32,
        /// Roughness, 0 to 1.
        roughness: f32,
        /// Part that is metal.
        metalness: f32,
        /// Reflectance of what is not metal at normal incidence.
        specular_color: [f32; 3],
        /// Part under a clear coat.
        coat: f32,
        /// Roughness of the coat.
        coat_roughness: f32,
        /// Emitted radiance over the colour.
        emission: f32,
        /// Which values the second layer drives: bits 0 roughness, 1 metalness, 2 coat, 3 emission.
        driven: u32,
    }
    /// How one layer of colours selects positions in its gradient.
    ColorLayer {
        /// Centre of the orbit trap, in the formula's unit.
        center: [f32; 3],
        /// What the value is; 0 if the layer is not drawn.
        source: u32,
        /// Direction of the axis, for sources that have one; a unit vector.
        axis: [f32; 3],
        /// Size of the orbit trap.
        size: f32,
        /// The greatest value that is told apart.
        greatest: f32,
        /// Gradient lengths per unit of the value.
        repeats: f32,
        /// Offset into the gradient.
        offset: f32,
        /// 1: the colour curve replaces the value.
        follows_view: u32,
        /// The value at the colour curve's first knot.
        curve_low: f32,
        /// One over the range of the colour curve.
        curve_per_value: f32,
        /// Part of the layer in the colour, for the second one.
        amount: f32,
    }
    /// Planes that cut the set open, and the colours of the cuts.
    Sections {
        /// The plane's normal, toward the side that is cut away, and its distance from the origin.
        planes: Array<[f32; 4], 3>,
        /// Distance from the set within which each plane is drawn, in render space.
        band_reach: [f32; 4],
        /// Colour of the set's inside, linear Rec. 709.
        inside: [f32; 3],
        /// Number of planes.
        count: u32,
        /// Lengths of the first layer's gradient per iteration.
        repeats: f32,
    }
    /// Vertical gradient, linear Rec. 709, and the orientation of the environment map.
    Background {
        /// Colour at the upper edge.
        top: [f32; 4],
        /// Colour at the lower edge.
        bottom: [f32; 4],
        /// The map's axis to the right, in world space.
        map_x: [f32; 3],
        /// Factor on the environment map; 0 shows the gradient.
        map_gain: f32,
        /// The map's forward axis, in world space.
        map_y: [f32; 3],
        /// The map's upward axis, in world space.
        map_z: [f32; 3],
        /// Samples of a finished pixel if the background is transparent; 0 if it is shown.
        transparent_samples: f32,
    }
    /// Tone settings.
    Tone {
        /// Factor on radiance.
        exposure: f32,
        /// 1 / white point².
        inverse_white_squared: f32,
        /// 0 linear, 1 Reinhard, 2 ACES, 3 AgX, 4 Khronos neutral.
        curve: u32,
        /// 1: Reinhard's curve on each channel; 0: on luminance.
        per_channel: u32,
        /// 1: auto exposure brings the film's mean to the key.
        auto_exposure: u32,
        /// 1: the mean is the mean of the logarithm.
        logarithmic: u32,
        /// Luminance that auto exposure brings the mean to.
        key: f32,
        /// 1: the display has 16 bits per channel, in two texels of each pixel.
        is_deep: u32,
    }
    /// Bloom settings.
    Bloom {
        /// Factor on the bloom that is added; 0 is off.
        strength: f32,
        /// Half width of a single uniform kernel, over the picture's height.
        radius: f32,
        /// Luminance above which light blooms.
        threshold: f32,
        /// 1: bloom is added after the tone curve.
        after: u32,
        /// Number of times that the kernel is applied.
        passes: u32,
    }
    /// The frame uniforms; in WGSL the formula's own part follows.
    FrameUniforms {
        /// The camera.
        camera: Camera,
        /// The region's eyes.
        eyes: Eyes,
        /// How rays march.
        march: March,
        /// The surface.
        surface: Surface,
        /// The first layer of colours.
        first_layer: ColorLayer,
        /// The second layer of colours.
        second_layer: ColorLayer,
        /// The section planes.
        sections: Sections,
        /// Indirect light.
        indirect: Indirect,
        /// The background.
        background: Background,
        /// The medium in place of the set's surface, for paths.
        medium: Medium,
        /// Fog.
        fog: Fog,
        /// Tone settings.
        tone: Tone,
        /// Bloom settings.
        bloom: Bloom,
        /// Path tracing.
        paths: PathTracing,
        /// Size of one eye's whole picture, in pixels.
        picture_px: [u32; 2],
        /// The region's upper left corner in the picture, in pixels.
        origin_px: [u32; 2],
        /// Size of the region with all its eyes, in pixels.
        size_px: [u32; 2],
        /// Kind of normals: 0 none, 1 three, 2 six, 3 eighteen, 4 twenty-six, 5 analytic.
        normals: u32,
        /// The knots of the layers' colour curves: see [`ColorCurve`](crate::render::color_curve::ColorCurve).
        color_curves: Array<[f32; 4], 32>,
    }
    /// What a picture's paths add up to.
    PathCounts {
        /// Number of pixels with too much noise.
        noisy_pixels: u32,
        /// Luminance of all paths before the firefly limit, in steps of a part of the limit.
        light: u32,
        /// Luminance that the firefly limit took away, in the same steps.
        clamped: u32,
    }
    /// A pixel's sums over the sub-frames of motion blur.
    ShutterPixel {
        /// Sum of the mean radiance of each sub-frame.
        light: [f32; 3],
        /// Sum of the number of samples.
        samples: f32,
        /// Mean guides of the denoiser, packed.
        guides: [u32; 2],
        /// Sum of the squares that noise is estimated from.
        moment: f32,
    }
    /// The medium in place of the set's surface, for paths.
    Medium {
        /// Single-scattering albedo, linear Rec. 709.
        color: [f32; 3],
        /// 0 no medium, 1 the set's inside, 2 by iteration counts.
        kind: u32,
        /// At full density, in render space.
        mean_free_path: f32,
        /// Mean cosine of scattering.
        anisotropy: f32,
        /// Iteration count up to which the density is 0.
        thin: f32,
        /// Rise of the density per iteration above.
        per_iteration: f32,
    }
    /// Fog in a ball, thinner with the height.
    Fog {
        /// Single-scattering albedo, linear Rec. 709.
        color: [f32; 3],
        /// Extinction coefficient at full density, per unit of render space; 0 without fog.
        density: f32,
        /// The ball's centre in render space.
        center: [f32; 3],
        /// The ball's radius in render space.
        radius: f32,
        /// Radiance of thick fog in direct light: that of all lights, without shadows.
        ambient: [f32; 3],
        /// Mean cosine of scattering.
        anisotropy: f32,
        /// Height over the centre up to which the density is full, in render space.
        level: f32,
        /// One over the scale height; 0 for the same density everywhere.
        inverse_height: f32,
    }
    /// A ray and the cone about it: all that a pass knows of a sample's way through the scene.
    Ray {
        /// In render space: the eye, then the surface point.
        origin: [f32; 3],
        /// Radius of the cone at the origin; at a surface point, the hit distance.
        radius: f32,
        /// Unit vector.
        direction: [f32; 3],
        /// Radius of the cone per unit of depth, where that is more than the radius at the origin.
        spread: f32,
    }
    /// A light path in progress.
    PathState {
        /// Path throughput: factor from radiance at the next vertex to the film.
        throughput: [f32; 3],
        /// Surfaces nearer than this block `ray_light`.
        ray_light_distance: f32,
        /// Light gathered so far, as it reaches the film.
        radiance: [f32; 3],
        /// 0 the camera ray met a surface, 1 it met none, 2 the pixel gets no more samples.
        end: u32,
        /// Film radiance of the light along the path's ray.
        ray_light: [f32; 3],
        /// Distance of the sampled light, at most its reach.
        nee_distance: f32,
        /// Film radiance of the sampled light, if nothing blocks the light (next-event estimation).
        nee_radiance: [f32; 3],
        /// Albedo and normal of the first vertex, packed as in `shaders/types/guides.wgsl`.
        guides: u32,
        /// Unit vector toward the sampled light.
        nee_direction: [f32; 3],
    }
    /// Path tracing.
    PathTracing {
        /// Most segments of a path between surfaces.
        bounces: u32,
        /// Number of single lights: the first ones of the scene's lights.
        light_count: u32,
        /// Which strategy gathers light: 0 both, by multiple importance sampling, 1 lights, 2 BSDF.
        strategy: u32,
        /// Longest ray between two vertices, in render space.
        reach: f32,
        /// The sun; black if there is none.
        sun: Light,
        /// The sky's x axis in world space: right.
        sky_x: [f32; 3],
        /// Factor on the sky's radiance; 0 without a sky.
        sky_gain: f32,
        /// The sky's y axis in world space: forward.
        sky_y: [f32; 3],
        /// Greatest distance of a surface that blocks the sky, in render space.
        sky_reach: f32,
        /// The sky's z axis in world space: up.
        sky_z: [f32; 3],
        /// Unnormalised selection probability of the sky: half its integrated luminance, over pi.
        sky_importance: f32,
        /// Longest ray: also those toward lights that are blocked from farther away than the reach.
        ray_reach: f32,
        /// Samples per pixel over which path tracing fades in; 0: no fade.
        preview_samples: f32,
        /// Noise target: error at which pixels get no more samples; 0: none.
        noise: f32,
        /// 1: displays show denoised light.
        denoise: u32,
        /// Greatest luminance of a path; 0: no limit.
        firefly_limit: f32,
    }
    /// Statistics of a whole film.
    Statistics {
        /// Width and height of one eye's part of the film, in pixels.
        eye_px: [u32; 2],
        /// Mip level that holds the bloom.
        bloom_level: u32,
        /// Index of the bloom's first element.
        bloom_start: u32,
        /// Mean colour.
        mean: [f32; 3],
        /// Mean of log2(luminance + 1e-4).
        mean_log2: f32,
        /// Auto exposure, in stops.
        adapted_stops: f32,
        /// Number of pixels by luminance; see [`HISTOGRAM_BINS`].
        bins: Array<u32, HISTOGRAM_BINS>,
    }
    /// One light.
    Light {
        /// Unit vector toward the light, or the light's position; render space.
        vector: [f32; 3],
        /// 0 environment, 1 point.
        kind: u32,
        /// Irradiance of a surface that faces the light, over pi; of point lights at distance 1. Linear Rec. 709.
        color: [f32; 3],
        /// 1 if surfaces block the light.
        casts_shadows: u32,
        /// Greatest distance of a blocker from the point, in render space.
        shadow_reach: f32,
        /// Index of the light's visibility bit, 0 to 63.
        bit: u32,
        /// Environment light: sine of half its apparent diameter. Point light: radius in render space.
        size: f32,
        /// Index among the scene's lights.
        seed: u32,
    }
}
