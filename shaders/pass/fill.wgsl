// Fills the pixels between those of a sparse lattice, one lattice level per dispatch. Each new
// pixel has four known neighbours in two opposite pairs; the pair that differs less lies along
// the edge and gets more weight.
// uses: lib/eye, lib/film_mean, lib/lattice, lib/luminance, types/dispatch_params, types/film
// uses: types/frame_uniforms

// Perceived contrast: the difference of the tone-compressed luminances.
fn contrast(a: vec3f, b: vec3f) -> f32 {
    let la = luminance(a);
    let lb = luminance(b);
    return abs(la / (1.0 + la) - lb / (1.0 + lb));
}

fn film_at(position: vec2i) -> vec3f {
    return film_mean(pixel_index(vec2u(position)));
}

fn in_region(position: vec2i) -> bool {
    return all(position >= vec2i(0)) && all(position < vec2i(frame.size_px));
}

// True if `position` is a pixel of the region and of the same eye as `at`.
fn is_neighbor(at: vec2i, position: vec2i) -> bool {
    return in_region(position) && is_second_eye(vec2u(position)) == is_second_eye(vec2u(at));
}

// The known colours on both sides of a new pixel. At the border of the eye's part the colour of the
// opposite side replaces a missing one; `sure` replaces both if both are missing.
fn pair(at: vec2i, offset: vec2i, sure: vec3f) -> array<vec3f, 2> {
    let ahead = is_neighbor(at, at + offset);
    let behind = is_neighbor(at, at - offset);
    var colors = array<vec3f, 2>(sure, sure);
    if (ahead) { colors[0] = film_at(at + offset); }
    if (behind) { colors[1] = film_at(at - offset); }
    if (ahead && !behind) { colors[1] = colors[0]; }
    if (behind && !ahead) { colors[0] = colors[1]; }
    return colors;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel) || is_kept(pixel)) { return; }
    let at = vec2i(pixel);
    let s = i32(dispatch.spacing);
    // Staggered levels have neighbours beside and above, other levels on the diagonals. One neighbour
    // toward the origin always exists: a staggered pixel of the first column lies in an odd row. A
    // neighbour of the other eye is used only if no neighbour is of the same eye.
    let staggered = dispatch.stagger != 0u;
    let one = select(vec2i(s, s), vec2i(s, 0), staggered);
    let other = select(vec2i(-s, s), vec2i(0, s), staggered);
    var sure = at - vec2i(s, s);
    if (staggered) { sure = select(at - vec2i(0, s), at - vec2i(s, 0), at.x >= s); }
    if (!is_neighbor(at, sure)) {
        let around = array<vec2i, 4>(one, other, -one, -other);
        for (var i = 0u; i < 4u; i++) {
            if (is_neighbor(at, at + around[i])) { sure = at + around[i]; }
        }
    }
    let fallback = film_at(sure);
    let first = pair(at, one, fallback);
    let second = pair(at, other, fallback);
    // Squared: the better pair clearly dominates, without a visible switch.
    let along_first = 1.0 / (contrast(first[0], first[1]) + 0.01);
    let along_second = 1.0 / (contrast(second[0], second[1]) + 0.01);
    let w1 = along_first * along_first;
    let w2 = along_second * along_second;
    let color = 0.5 * ((first[0] + first[1]) * w1 + (second[0] + second[1]) * w2) / (w1 + w2);
    let index = pixel_index(pixel);
    film_rg[index] = color.rg;
    film_bw[index] = vec2f(color.b, 1.0);
}
