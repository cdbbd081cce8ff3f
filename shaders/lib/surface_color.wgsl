// The colour of a surface point: its layers' gradients, or the colours of a section plane.
// uses: lib/color_value, types/frame_uniforms

const GRADIENT_ENTRIES = 256u;
// The gradients of the first and the second colour layer, linear Rec. 709, periodic.
@group(0) @binding(4) var<uniform> gradients: array<vec4f, 2u * GRADIENT_ENTRIES>;

// The colour at `u` in the gradient whose first entry is `first`.
fn gradient_color(first: u32, u: f32) -> vec3f {
    let x = fract(u) * f32(GRADIENT_ENTRIES);
    let low = u32(x) % GRADIENT_ENTRIES;
    let next = (low + 1u) % GRADIENT_ENTRIES;
    return mix(gradients[first + low].rgb, gradients[first + next].rgb, fract(x));
}

// Number of knots of a colour curve.
const COLOR_KNOTS = 64u;

// A layer's colour curve at a value: linear between knots, constant beyond them. `first` is its first knot.
fn color_curve(layer: ColorLayer, first: u32, value: f32) -> f32 {
    let along = (value - layer.curve_low) * layer.curve_per_value;
    let place = clamp(along, 0.0, 1.0) * f32(COLOR_KNOTS - 1u);
    let before = min(u32(place), COLOR_KNOTS - 2u);
    let low = first + before;
    // Read from the uniforms themselves: an index into the private copy would keep the copy in memory.
    let a = frame_uniforms.color_curves[low / 4u][low % 4u];
    let b = frame_uniforms.color_curves[(low + 1u) / 4u][(low + 1u) % 4u];
    return mix(a, b, place - f32(before));
}

// The colour of one layer; `number` is 0 or 1.
fn layer_color(layer: ColorLayer, number: u32, stored: f32, normal: u32) -> vec3f {
    var value = color_value(layer, stored, normal);
    if (layer.follows_view != 0u) { value = color_curve(layer, number * COLOR_KNOTS, value); }
    return gradient_color(number * GRADIENT_ENTRIES, value * layer.repeats + layer.offset);
}

// The colour of a section plane where orbits take so many smooth iterations (thesis eq. 3.1); -1: inside the set.
fn section_color(iterations: f32) -> vec3f {
    if (iterations < 0.0) { return frame.sections.inside; }
    return gradient_color(0u, iterations * frame.sections.repeats + frame.first_layer.offset);
}

// The colour of a sample with the layers' values `stored` and the packed normal `normal`.
fn surface_color(stored: vec2f, normal: u32) -> vec3f {
    if (stored.y == ON_SECTION) { return section_color(stored.x); }
    let color = layer_color(frame.first_layer, 0u, stored.x, normal);
    if (frame.second_layer.source == COLOR_NONE) { return color; }
    let second = layer_color(frame.second_layer, 1u, stored.y, normal);
    return mix(color, second, frame.second_layer.amount);
}
