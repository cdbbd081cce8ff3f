//! The structs that are shared with WGSL, their fields in the order of their twins in
//! `shaders/types/`, which `tests/source/shaders.rs` compares with them.
//!
//! Lengths are in the view's unit: that of its [`RenderSpace`](crate::render::space::RenderSpace), the scene's own
//! but in deep views.

use bytemuck::{Pod, Zeroable};

use crate::render::report::HISTOGRAM_BINS;

/// Most steps that all orbits near the anchor take together.
pub const MOST_NEAR_STEPS: usize = 8;
/// The places that they pass.
pub const NEAR_POINTS: usize = MOST_NEAR_STEPS + 1;

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
        /// The eye, in the view's unit.
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
    /// Indirect light.
    Indirect {
        /// 0 off, 1 uniform, 2 horizon-based.
        kind: u32,
        /// How far it looks, in heights of the picture.
        radius: f32,
        /// Part of it that is added.
        strength: f32,
        /// The ambient factor.
        ambient: f32,
        /// Directions on the screen.
        directions: u32,
        /// Samples a direction.
        samples: u32,
        /// One eye's picture that the neighbours are from, pixels.
        source_px: [u32; 2],
    }
    /// Which eyes the region shows, for a picture in stereo.
    Eyes {
        /// The first pixel of the second eye's part.
        second_at: [u32; 2],
        /// 1 or 2.
        count: u32,
        /// -1: the first is a left eye; 1: a right one; 0: there is only the camera.
        first_side: f32,
        /// From the camera to either eye, in the view's unit.
        half_separation: f32,
        /// The same at depth one.
        half_shift: f32,
        /// The part of the whole film that an eye's picture has.
        share: [f32; 2],
        /// Where the first eye's part of it lies.
        first_place: f32,
        /// 1: both eyes in one display picture.
        anaglyph: u32,
        /// Keeps the size a multiple of 16 bytes.
        unused: [u32; 2],
    }
    /// The set.
    Fractal {
        /// The Julia form's constant.
        julia_constant: [f32; 3],
        /// Exponent n.
        power: f32,
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
        /// Longest step, in the view's unit.
        max_step: f32,
        /// Where the derivative is cut off.
        derivative_max: f32,
        /// Most steps of a camera ray.
        march_steps: u32,
        /// Most steps of a shadow ray.
        shadow_steps: u32,
        /// Least hit distance, in the view's unit.
        finest_hit: f32,
        /// Binary logarithm of the bailout.
        log2_bailout: f32,
        /// An orbit whose derivative falls below this, in units of one over the scale, is followed by its
        /// difference: see [`super::depth`].
        least_derivative: f32,
        /// Where coordinates begin, scene units.
        anchor: [f32; 3],
        /// Their unit, scene units.
        scale: f32,
        /// Places of the reference; 0 without an anchor.
        reference_points: u32,
        /// How many of them are the anchor's own.
        own_points: u32,
        /// The one that orbits start anew from.
        restart: u32,
        /// 1 if orbits about it are followed in frames that turn with their points' longitudes:
        /// see [`crate::fractal::deep::rotating_frame`].
        rotates: u32,
        /// Within which radius of the anchor, squared, orbits take the near steps; 0 where none do.
        near_radius_squared: f32,
        /// Beyond which distance from the anchor, in scales, plain f32 tells points apart.
        far_radius: f32,
        /// How many near steps there are.
        near_steps: u32,
        /// 1 if the picture's series approximation precedes the near steps.
        has_series: u32,
    }
    /// The first steps of all orbits near the anchor at once: see [`crate::fractal::deep::series`].
    SeriesApproximation {
        /// First derivatives of the difference by the offset.
        along_x: [f32; 3],
        /// How many steps.
        steps: u32,
        /// As above.
        along_y: [f32; 3],
        /// dr at the anchor, one over the scale.
        derivative: f32,
        /// As above.
        along_z: [f32; 3],
        /// A vector's alignment is 16 bytes.
        unused: u32,
        /// Second derivatives.
        along_xx: [f32; 3],
        /// A vector's alignment is 16 bytes.
        unused_a: u32,
        /// As above.
        along_yy: [f32; 3],
        /// The same.
        unused_b: u32,
        /// As above.
        along_zz: [f32; 3],
        /// The same.
        unused_c: u32,
        /// As above.
        along_xy: [f32; 3],
        /// The same.
        unused_d: u32,
        /// As above.
        along_yz: [f32; 3],
        /// The same.
        unused_e: u32,
        /// As above.
        along_zx: [f32; 3],
        /// The same.
        unused_f: u32,
        /// First derivatives of dr.
        derivative_gradient: [f32; 3],
        /// The same.
        unused_g: u32,
        /// Squares of the least distances of the points passed from the origin, the z axis and
        /// the plane z = 0.
        traps_squared: [f32; 3],
        /// The same.
        unused_h: u32,
        /// The direction that those steps stretch most, a unit vector.
        widest: [f32; 3],
        /// The norm of the Jacobian across it.
        rest: f32,
    }
    /// A place of the anchor's orbit.
    ReferencePoint {
        /// z.
        z: [f32; 3],
        /// |x + iy|.
        rho: f32,
        /// (x + iy)/ρ.
        rotor: [f32; 2],
        /// Keeps the size a multiple of 16 bytes.
        unused: [u32; 2],
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
    /// Vertical gradient, linear Rec. 709, and how the environment map lies.
    Background {
        /// At the upper edge.
        top: [f32; 4],
        /// At the lower edge.
        bottom: [f32; 4],
        /// The picture's axis to the right, in world space.
        picture_x: [f32; 3],
        /// Factor on the environment map; 0 for the gradient.
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
    FrameUniforms {
        /// The camera.
        camera: Camera,
        /// Its eyes.
        eyes: Eyes,
        /// The set.
        fractal: Fractal,
        /// The surface.
        surface: Surface,
        /// Indirect light.
        indirect: Indirect,
        /// The background.
        background: Background,
        /// Tone settings.
        tone: Tone,
        /// Bloom settings.
        bloom: Bloom,
        /// One eye's whole picture, pixels.
        picture_px: [u32; 2],
        /// The region's upper left corner in it, pixels.
        origin_px: [u32; 2],
        /// The region with all its eyes, pixels.
        size_px: [u32; 2],
        /// How normals are found: 0 none, 1 three, 2 six, 3 eighteen, 4 twenty-six, 5 analytic.
        normals: u32,
        /// Keeps the offset of what follows a multiple of 16 bytes.
        unused: u32,
        /// The series approximation before the near steps.
        series: SeriesApproximation,
        /// The places between which those steps are.
        near: [ReferencePoint; NEAR_POINTS],
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
        /// Position of the first sample in its pixel.
        jitter: [f32; 2],
        /// 1: G-buffer in dispatch order.
        compact: u32,
        /// 1: add to the film.
        accumulate: u32,
        /// The visibility bit of a shadow dispatch's light, 0 to 63.
        light_bit: u32,
        /// How far a blocker may be, in the view's unit.
        light_reach: f32,
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
        /// The lattice level that indirect light's neighbours are taken from.
        neighbour_level: u32,
        /// Direction toward a shadow dispatch's light, or its position; world space.
        light_vector: [f32; 3],
        /// 0 environment, 1 point.
        light_kind: u32,
        /// Blocks of a dispatch that goes through all of them.
        blocks: u32,
        /// The ray list that a dispatch writes or reads.
        ray_queue: u32,
        /// Samples of a pixel that are computed together.
        samples: u32,
        /// log2 of the threads that they have.
        samples_shift: u32,
        /// From each of them to the next, round the pixel.
        jitter_step: [f32; 2],
        /// Padding.
        unused: [u32; 2],
    }
    /// What is known of a film as a whole.
    Statistics {
        /// Width and height of one eye's part of the film, pixels.
        eye_px: [u32; 2],
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
        /// How far a blocker may be, in the view's unit.
        shadow_reach: f32,
        /// Which visibility bit is its own, 0 to 63.
        bit: u32,
        /// Keeps the size a multiple of 16 bytes.
        unused_a: u32,
        /// The same.
        unused_b: u32,
    }
}
