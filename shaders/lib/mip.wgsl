// Mip levels of a film. An element of level n is the mean of the 2^n x 2^n pixels below it, or of the
// pixels that exist at the right and lower edges: each level has as many elements as cover the film.
// If two eyes share the film, each eye's part has its own elements: no element mixes light of both
// eyes. Host twin: `render::post::Levels`.
// uses: types/dispatch_params, types/frame_uniforms

// The finest stored level.
const FIRST_MIP_LEVEL = 2u;

struct Levels {
    // One eye's part of the film, in pixels.
    eye_px: vec2u,
    // Columns and rows of eyes.
    eyes: vec2u,
}

// The mip levels of a region's film.
fn film_levels() -> Levels {
    let eyes = 1u + vec2u(frame.eyes.second_at > vec2u(0u));
    return Levels(frame.size_px / eyes, eyes);
}

// Columns and rows of the elements of one eye.
fn mip_eye_size(levels: Levels, level: u32) -> vec2u {
    return (levels.eye_px + ((1u << level) - 1u)) >> vec2u(level);
}

// Columns and rows of the elements of all eyes.
fn mip_size(levels: Levels, level: u32) -> vec2u {
    return mip_eye_size(levels, level) * levels.eyes;
}

// The index in `mips` of a level's first element.
fn mip_start(levels: Levels, level: u32) -> u32 {
    var start = 0u;
    for (var finer = FIRST_MIP_LEVEL; finer < level; finer++) {
        let size = mip_size(levels, finer);
        start += size.x * size.y;
    }
    return start;
}

// The upper left pixel below an element.
fn mip_pixel(levels: Levels, level: u32, cell: vec2u) -> vec2u {
    let size = mip_eye_size(levels, level);
    return cell / size * levels.eye_px + ((cell % size) << vec2u(level));
}

// Number of pixels below an element, along each axis.
fn mip_span(levels: Levels, level: u32, cell: vec2u) -> vec2u {
    let own = cell % mip_eye_size(levels, level);
    return min((own + 1u) << vec2u(level), levels.eye_px) - (own << vec2u(level));
}

// A thread's index in a dispatch over a level's elements.
fn mip_index(workgroup: u32, local_index: u32) -> u32 {
    return (dispatch.first_workgroup + workgroup) * 64u + local_index;
}
