// Upsamples a sparse lattice to a whole picture, in display values. Each pixel lies in a cell of four
// samples: a square, which stands on its corner if the lattice is staggered. A diagonal halves the
// cell, and each half is interpolated linearly. The diagonal whose ends differ less follows an edge
// through the cell (Su and Willis 2004) and gets more weight.
// uses: lib/lattice, lib/srgb, types/dispatch_params, types/frame_uniforms, types/tonemap_sparse

@group(2) @binding(2) var display: texture_storage_2d<rgba8unorm, write>;

// Difference of two samples that counts as the same colour, in display values.
const SAME = 0.024;

// The nearest sample inside the region, for a cell that extends past the region's border.
fn within(cell: vec2i) -> vec2u {
    let cells = vec2i(((frame.size_px - 1u) >> vec2u(dispatch.shift)) + 1u);
    let back = 1 + i32(dispatch.stagger);
    var inside = cell + select(vec2i(0), vec2i(back), cell < vec2i(0));
    inside -= select(vec2i(0), vec2i(back), inside >= cells);
    // A region narrower than a cell uses its corner sample.
    return vec2u(select(vec2i(0), inside, all(inside >= vec2i(0)) && all(inside < cells)));
}

fn sample_at(cell: vec2i) -> vec3f {
    return display_unpack(sparse_display[sparse_index(within(cell))]);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = pixel_of_rows(workgroup.xy, local_index);
    if (!inside_region(pixel)) { return; }
    let place = vec2f(pixel) / f32(1u << dispatch.shift);
    let staggered = dispatch.stagger != 0u;
    // Coordinates in which cells have integer corners.
    let turned = select(place, 0.5 * vec2f(place.x + place.y, place.x - place.y), staggered);
    let corner = floor(turned);
    let part = turned - corner;
    let a = vec2i(corner);
    let origin = select(a, vec2i(a.x + a.y, a.x - a.y), staggered);
    let along = select(vec2i(1, 0), vec2i(1, 1), staggered);
    let across = select(vec2i(0, 1), vec2i(1, -1), staggered);
    let c00 = sample_at(origin);
    let c10 = sample_at(origin + along);
    let c01 = sample_at(origin + across);
    let c11 = sample_at(origin + along + across);
    let main_differs = dot(abs(c00 - c11), vec3f(0.3, 0.6, 0.1));
    let other_differs = dot(abs(c10 - c01), vec3f(0.3, 0.6, 0.1));
    // The cell halved along the main diagonal, then along the other one.
    let in_first = part.x >= part.y;
    let by_main = select(
        c00 + part.y * (c01 - c00) + part.x * (c11 - c01),
        c00 + part.x * (c10 - c00) + part.y * (c11 - c10),
        in_first,
    );
    let before = part.x + part.y <= 1.0;
    let rest = 1.0 - part;
    let by_other = select(
        c11 + rest.x * (c01 - c11) + rest.y * (c10 - c11),
        c00 + part.x * (c10 - c00) + part.y * (c01 - c00),
        before,
    );
    // Squared: the better one clearly dominates, without a visible switch.
    let ratio = (other_differs + SAME) / (main_differs + SAME);
    let color = mix(by_other, by_main, ratio * ratio / (ratio * ratio + 1.0));
    textureStore(display, pixel, vec4f(color + dither(frame.origin_px + pixel) / 255.0, 1.0));
}
