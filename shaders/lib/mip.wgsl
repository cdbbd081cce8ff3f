// Mip levels of a film. An element of level n is the mean of the 2^n x 2^n pixels below it, or of
// as many of them as there are at the right and lower edges: each level has as many elements as
// it takes to cover the film. Where two eyes share the film, each one's part is covered for
// itself: no element holds light of both. Host twin: `render::post::Levels`.

// The finest level that is kept.
const FIRST_MIP_LEVEL = 2u;

struct Levels {
    // One eye's part of the film, in pixels.
    eye_px: vec2u,
    // Columns and rows of eyes.
    eyes: vec2u,
}

// The levels of the film that a region has.
fn film_levels() -> Levels {
    let eyes = 1u + vec2u(frame.eyes.second_at > vec2u(0u));
    return Levels(frame.size_px / eyes, eyes);
}

// Columns and rows of the elements of one eye.
fn mip_eye_size(levels: Levels, level: u32) -> vec2u {
    return (levels.eye_px + ((1u << level) - 1u)) >> vec2u(level);
}

// Those of all eyes.
fn mip_size(levels: Levels, level: u32) -> vec2u {
    return mip_eye_size(levels, level) * levels.eyes;
}

// The element of `mips` at which a level starts.
fn mip_start(levels: Levels, level: u32) -> u32 {
    var start = 0u;
    for (var finer = FIRST_MIP_LEVEL; finer < level; finer++) {
        let size = mip_size(levels, finer);
        start += size.x * size.y;
    }
    return start;
}

// The first pixel below an element.
fn mip_pixel(levels: Levels, level: u32, cell: vec2u) -> vec2u {
    let size = mip_eye_size(levels, level);
    return cell / size * levels.eye_px + ((cell % size) << vec2u(level));
}

// How many pixels an element spans along each axis.
fn mip_span(levels: Levels, level: u32, cell: vec2u) -> vec2u {
    let own = cell % mip_eye_size(levels, level);
    return min((own + 1u) << vec2u(level), levels.eye_px) - (own << vec2u(level));
}

// A thread's number in a dispatch over a level's elements.
fn mip_index(workgroup: u32, local_index: u32) -> u32 {
    return (slice.first_workgroup + workgroup) * 64u + local_index;
}
