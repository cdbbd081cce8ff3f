//! What the shaders know of a scene: structs shared with WGSL, and how they are filled.
//!
//! In: a scene, its region, a slice. Out: bytes. `tests/shaders.rs` compares each struct, field
//! by field, with its twin in `shaders/types/`.

mod background;
mod lights;

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

pub use lights::lights;

use super::{Region, report::HISTOGRAM_BINS, schedule::Stale};
use crate::{
    fractal::{Estimator, estimator::SIDEWAYS_MAX, pixel_cone},
    scene::{
        self, BloomOrder, ColorSource, MAX_LIGHTS, Normals, Panorama, Scene, ToneChannels,
        ToneCurve, ToneMean, Variant, color,
    },
};

/// Entries of the gradient table that the shaders look colours up in.
pub const GRADIENT_ENTRIES: usize = 256;

/// llvmpipe stops an invocation after 65,535 loop turns of all its loops together; others have
/// watchdogs. No dispatch may need more.
const LOOP_TURNS: u32 = 60_000;

/// Most steps of a camera ray: the longest silhouette rays need about 300.
const MARCH_STEPS: u32 = 1024;

/// Most steps of a shadow ray.
const SHADOW_STEPS: u32 = 320;

/// Below this hit distance, in scene units, f32 positions near the surface run together.
const FINEST_HIT: f32 = 4e-7;

/// One field of a host-shared struct: name, byte offset, size in bytes.
pub type FieldLayout = (&'static str, usize, usize);

macro_rules! host_shared {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ty,)* })*) => {
        $(
            $(#[$doc])*
            #[repr(C)]
            #[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
            pub struct $name { $($(#[$field_doc])* pub $field: $kind,)* }

            impl $name {
                /// Every field in order, for comparison with the WGSL struct.
                pub const LAYOUT: &[FieldLayout] = &[
                    $((stringify!($field), std::mem::offset_of!($name, $field), size_of::<$kind>()),)*
                ];
            }
        )*

        /// Name, size in bytes and fields of every host-shared struct.
        pub const HOST_SHARED: &[(&str, usize, &[FieldLayout])] =
            &[$((stringify!($name), size_of::<$name>(), $name::LAYOUT),)*];
    };
}

host_shared! {
    /// The pinhole camera, axes in world space.
    Camera {
        /// The eye, scene units.
        origin: [f32; 3],
        /// Half the picture's height at depth one.
        half_height: f32,
        /// Unit vector to the right.
        right: [f32; 3],
        /// Width over height of the whole picture.
        aspect: f32,
        /// Unit vector upward.
        up: [f32; 3],
        /// Hit distance at depth one.
        hit_cone: f32,
        /// Unit vector into the picture.
        forward: [f32; 3],
        /// Keeps the size a multiple of 16 bytes.
        unused: u32,
    }
    /// The set.
    Fractal {
        /// The Julia form's constant.
        julia_constant: [f32; 3],
        /// Exponent n.
        power: f32,
        /// The exponent where it is whole, else 0.
        integer_power: u32,
        /// Most orbit steps.
        iterations: u32,
        /// Escape radius, scene units.
        bailout: f32,
        /// Radius about the origin of a sphere that holds the set, scene units.
        bounding_radius: f32,
        /// 1 for the Julia form.
        julia: u32,
        /// Sign of the sine term.
        z_sign: f32,
        /// Longest step, scene units.
        max_step: f32,
        /// Where the derivative is cut off.
        derivative_max: f32,
        /// Most steps of a camera ray.
        march_steps: u32,
        /// Most steps of a shadow ray.
        shadow_steps: u32,
        /// Least hit distance, scene units.
        finest_hit: f32,
        /// Binary logarithm of the bailout.
        log2_bailout: f32,
    }
    /// Blinn-Phong terms and colouring.
    Surface {
        /// Part of the colour seen without light.
        ambient: f32,
        /// Diffuse reflectance.
        diffuse: f32,
        /// Specular reflectance.
        specular: f32,
        /// Blinn-Phong exponent.
        shininess: f32,
        /// 0 iterations, 1 origin trap, 2 axis trap, 3 plane trap.
        color_source: u32,
        /// Gradient lengths per unit.
        color_repeats: f32,
        /// Where the gradient starts.
        color_offset: f32,
        /// Lights in use.
        light_count: u32,
    }
    /// Vertical gradient, linear Rec. 709, and how the picture of the surroundings lies.
    Background {
        /// At the upper edge.
        top: [f32; 4],
        /// At the lower edge.
        bottom: [f32; 4],
        /// The picture's axis to the right, in world space.
        picture_x: [f32; 3],
        /// Factor on the picture of the surroundings; 0 for the gradient.
        picture_gain: f32,
        /// The picture's axis ahead.
        picture_y: [f32; 3],
        /// Fills the row.
        unused_a: u32,
        /// The picture's axis upward.
        picture_z: [f32; 3],
        /// Fills the row.
        unused_b: u32,
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
        /// 1: the film's mean is brought to the key.
        auto_exposure: u32,
        /// 1: by the mean of the logarithm.
        logarithmic: u32,
        /// What the mean is brought to.
        key: f32,
        /// Keeps the size a multiple of 16 bytes.
        unused: u32,
    }
    /// Bloom settings.
    Bloom {
        /// Part of the spread light that is added; 0 is off.
        strength: f32,
        /// Half width of a single uniform kernel, as a part of the picture's height.
        radius: f32,
        /// Luminance above which light spreads.
        threshold: f32,
        /// 1: after the tone curve.
        after: u32,
        /// How often the kernel is applied.
        passes: u32,
        /// Keeps the size a multiple of 16 bytes.
        unused_a: u32,
        /// The same.
        unused_b: u32,
        /// The same.
        unused_c: u32,
    }
    /// Everything above, and the region.
    Picture {
        /// The camera.
        camera: Camera,
        /// The set.
        fractal: Fractal,
        /// The surface.
        surface: Surface,
        /// The background.
        background: Background,
        /// Tone settings.
        tone: Tone,
        /// Bloom settings.
        bloom: Bloom,
        /// The whole picture, pixels.
        picture_px: [u32; 2],
        /// The region's upper left corner in it, pixels.
        origin_px: [u32; 2],
        /// The region, pixels.
        size_px: [u32; 2],
        /// How normals are found: 0 none, 1 three, 2 six, 3 eighteen, 4 twenty-six, 5 analytic.
        normals: u32,
        /// Keeps the size a multiple of 16 bytes.
        unused: u32,
    }
    /// The part of a picture that one dispatch computes.
    Slice {
        /// Grid to lattice.
        step: [u32; 2],
        /// Lattice offset.
        offset: [u32; 2],
        /// Added to x in every other row.
        stagger: u32,
        /// Which rows are staggered.
        row_phase: u32,
        /// Lattice to pixels.
        shift: u32,
        /// First workgroup of the dispatch.
        first_workgroup: u32,
        /// Columns and rows of workgroups in the grid.
        workgroups: [u32; 2],
        /// Strides in which columns and rows are visited.
        scatter: [u32; 2],
        /// Sample position in its pixel.
        jitter: [f32; 2],
        /// 1: G-buffer in dispatch order.
        compact: u32,
        /// 1: add to the film.
        accumulate: u32,
        /// First light of a shadow dispatch.
        first_light: u32,
        /// Lights of a shadow dispatch.
        light_count: u32,
        /// Spacing of the lattice on the film, pixels; 0 where it is complete.
        spacing: u32,
        /// Mip level that a glow's pass reads, or starts from.
        mip_level: u32,
        /// Direction of a blur: 0 along x, 1 along y.
        axis: u32,
        /// Half width of a blur's kernel, in elements of the mip level.
        half_width: f32,
        /// How far exposure moves toward its goal, 0 to 1.
        adapt: f32,
        /// Keeps the size a multiple of 16 bytes.
        unused: u32,
    }
    /// What is known of a film as a whole.
    Statistics {
        /// The film's width and height, pixels.
        size_px: [u32; 2],
        /// Mip level that holds the bloom.
        bloom_level: u32,
        /// Its first element.
        bloom_start: u32,
        /// Mean colour.
        mean: [f32; 3],
        /// Mean of log2(luminance + 1e-4).
        mean_log2: f32,
        /// Auto exposure, stops.
        adapted_stops: f32,
        /// Keeps the size a multiple of 16 bytes.
        unused_a: u32,
        /// The same.
        unused_b: u32,
        /// The same.
        unused_c: u32,
        /// Pixels by luminance; see [`HISTOGRAM_BINS`].
        bins: [u32; HISTOGRAM_BINS],
    }
    /// One light.
    Light {
        /// Direction toward it, or its position; world space.
        vector: [f32; 3],
        /// 0 environment, 1 point.
        kind: u32,
        /// Linear radiance.
        color: [f32; 3],
        /// 1 where surfaces block it.
        casts_shadows: u32,
        /// How far a blocker may be, scene units.
        shadow_reach: f32,
        /// Keeps the size a multiple of 16 bytes.
        unused_a: u32,
        /// The same.
        unused_b: u32,
        /// The same.
        unused_c: u32,
    }
}

impl Picture {
    /// The scene as it is seen in `region`.
    pub fn new(scene: &Scene, region: Region) -> Self {
        let [width, height] = region.picture_px.map(f64::from);
        let camera = &scene.camera;
        let rotation = camera.rotation();
        let aspect = width / height;
        Self {
            camera: Camera {
                origin: camera.position.to_dvec3().as_vec3().to_array(),
                half_height: camera.half_height(aspect) as f32,
                right: (rotation * DVec3::X).as_vec3().to_array(),
                aspect: aspect as f32,
                up: (rotation * DVec3::Y).as_vec3().to_array(),
                hit_cone: (scene.quality.detail * pixel_cone(camera, aspect, height)) as f32,
                forward: camera.forward().as_vec3().to_array(),
                unused: 0,
            },
            fractal: fractal(scene),
            surface: surface(scene),
            background: background::background(scene),
            tone: tone(&scene.tone),
            bloom: bloom(&scene.bloom),
            picture_px: region.picture_px,
            origin_px: region.origin_px,
            size_px: region.size_px,
            normals: match scene.quality.normals {
                Normals::None => 0,
                Normals::Three => 1,
                Normals::Six => 2,
                Normals::Eighteen => 3,
                Normals::TwentySix => 4,
                Normals::Analytic => 5,
            },
            unused: 0,
        }
    }
}

fn tone(tone: &scene::Tone) -> Tone {
    Tone {
        exposure: tone.exposure.exp2() as f32,
        inverse_white_squared: tone.white_point.powi(-2) as f32,
        curve: match tone.curve {
            ToneCurve::Linear => 0,
            ToneCurve::Reinhard => 1,
            ToneCurve::Aces => 2,
            ToneCurve::Agx => 3,
            ToneCurve::KhronosNeutral => 4,
        },
        per_channel: u32::from(tone.channels == ToneChannels::PerChannel),
        auto_exposure: u32::from(tone.auto_exposure),
        logarithmic: u32::from(tone.mean == ToneMean::Logarithmic),
        key: tone.key as f32,
        unused: 0,
    }
}

fn bloom(bloom: &scene::Bloom) -> Bloom {
    Bloom {
        strength: bloom.strength as f32,
        radius: bloom.radius as f32,
        threshold: bloom.threshold as f32,
        after: u32::from(bloom.order == BloomOrder::After),
        passes: bloom.passes,
        ..Bloom::zeroed()
    }
}

fn fractal(scene: &Scene) -> Fractal {
    let set = &scene.fractal;
    let estimator = Estimator::new(set);
    // The next derivative is at most so many times this one, plus one.
    let stretch_max = SIDEWAYS_MAX * set.power * set.bailout.powf(set.power - 1.0);
    Fractal {
        julia_constant: set.julia_constant.map(|v| v as f32),
        power: set.power as f32,
        integer_power: set.integer_power().unwrap_or(0),
        iterations: set.iterations,
        bailout: set.bailout as f32,
        bounding_radius: estimator.bounding_radius() as f32,
        julia: u32::from(set.julia),
        z_sign: match set.variant {
            Variant::PositiveSine => 1.0,
            Variant::NegativeSine => -1.0,
        },
        max_step: estimator.max_step().min(1e30) as f32,
        derivative_max: (1e38 / stretch_max).min(1e36) as f32,
        march_steps: MARCH_STEPS.min(LOOP_TURNS / (set.iterations + 1)),
        shadow_steps: shadow_steps(set.iterations),
        finest_hit: FINEST_HIT,
        log2_bailout: set.bailout.log2() as f32,
    }
}

fn shadow_steps(iterations: u32) -> u32 {
    SHADOW_STEPS.min(LOOP_TURNS / (iterations + 1))
}

/// How many lights one shadow dispatch may march toward without more than [`LOOP_TURNS`].
pub fn lights_per_dispatch(iterations: u32) -> u32 {
    (LOOP_TURNS / (shadow_steps(iterations) * (iterations + 1))).max(1)
}

fn surface(scene: &Scene) -> Surface {
    let surface = &scene.surface;
    Surface {
        ambient: surface.ambient as f32,
        diffuse: surface.diffuse as f32,
        specular: surface.specular as f32,
        shininess: surface.shininess as f32,
        color_source: match surface.coloring.source {
            ColorSource::Iterations => 0,
            ColorSource::OriginTrap => 1,
            ColorSource::AxisTrap => 2,
            ColorSource::PlaneTrap => 3,
        },
        color_repeats: surface.coloring.repeats as f32,
        color_offset: surface.coloring.offset as f32,
        light_count: scene.lights.len() as u32,
    }
}

/// All that a picture's passes read of its scene.
#[derive(Clone, PartialEq)]
pub struct Inputs {
    /// Camera, set, surface, tone, region.
    pub picture: Picture,
    /// The lights, in the order of their visibility bits.
    pub lights: [Light; MAX_LIGHTS],
    /// The surface's gradient: linear Rec. 709, closed on itself.
    pub gradient: [[f32; 4]; GRADIENT_ENTRIES],
    /// The [`Panorama::id`] of the picture of the surroundings, where it is shown.
    pub panorama: Option<u64>,
}

impl Inputs {
    /// The scene as it is seen in `region`.
    pub fn new(scene: &Scene, region: Region) -> Self {
        Self {
            picture: Picture::new(scene, region),
            lights: lights(scene),
            gradient: color::gradient_lut(&scene.surface.gradient),
            panorama: None,
        }
    }

    /// The same with the picture of the surroundings that is at hand, where `scene` shows it.
    pub fn with_panorama(mut self, scene: &Scene, at_hand: Option<&Panorama>) -> Self {
        let shown = background::shown(scene, at_hand);
        self.panorama = shown.map(Panorama::id);
        let gain = scene.lights.rig.intensity as f32;
        self.picture.background.picture_gain = if shown.is_some() { gain } else { 0.0 };
        self
    }

    /// What must be computed again after `old`; none where no pass would see a difference.
    pub fn stale_since(&self, old: &Self) -> Option<Stale> {
        let (new_picture, old_picture) = (&self.picture, &old.picture);
        let same_geometry = new_picture.camera == old_picture.camera
            && new_picture.fractal == old_picture.fractal
            && new_picture.picture_px == old_picture.picture_px
            && new_picture.origin_px == old_picture.origin_px
            && new_picture.size_px == old_picture.size_px;
        let same_light = new_picture.surface == old_picture.surface
            && new_picture.background == old_picture.background
            && self.panorama == old.panorama
            && self.lights == old.lights
            && self.gradient == old.gradient;
        if !same_geometry {
            Some(Stale::Geometry)
        } else if new_picture.normals != old_picture.normals {
            Some(Stale::Normals)
        } else if !same_light {
            Some(Stale::Light)
        } else {
            let same_tone =
                new_picture.tone == old_picture.tone && new_picture.bloom == old_picture.bloom;
            (!same_tone).then_some(Stale::Tone)
        }
    }
}
