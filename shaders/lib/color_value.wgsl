// The value of a sample's colour data that selects its colour.
// uses: types/frame_uniforms

const SOURCE_ITERATIONS = 0u;
const SOURCE_ORIGIN_TRAP = 1u;
const SOURCE_AXIS_TRAP = 2u;

// The value over its greatest: 0 to 1.
fn color_value(data: vec2u) -> f32 {
    let first = unpack2x16unorm(data.x);
    let second = unpack2x16unorm(data.y);
    if (frame.surface.color_source == SOURCE_ITERATIONS) { return first.x; }
    if (frame.surface.color_source == SOURCE_ORIGIN_TRAP) { return first.y; }
    if (frame.surface.color_source == SOURCE_AXIS_TRAP) { return second.x; }
    return second.y;
}
