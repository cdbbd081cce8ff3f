// Display values of a sparse lattice's samples, row by row: 11, 11 and 10 bits of red, green and blue,
// sRGB. They reuse the buffer of rays.
// uses: types/dispatch_params, types/frame_uniforms

@group(1) @binding(3) var<storage, read_write> sparse_display: array<u32>;

const DISPLAY_STEPS = vec3f(2047.0, 2047.0, 1023.0);

// Lattice points in a row, in cells of `spacing` pixels. A staggered lattice leaves out every other
// point of a row.
fn sparse_columns() -> u32 {
    return ((frame.size_px.x - 1u) >> dispatch.shift) + 1u;
}

fn sparse_index(cell: vec2u) -> u32 {
    return cell.y * sparse_columns() + cell.x;
}

fn display_pack(color: vec3f) -> u32 {
    let steps = vec3u(color * DISPLAY_STEPS + 0.5);
    return steps.r | (steps.g << 11u) | (steps.b << 22u);
}

fn display_unpack(packed: u32) -> vec3f {
    return vec3f(vec3u(packed & 2047u, (packed >> 11u) & 2047u, packed >> 22u)) / DISPLAY_STEPS;
}
