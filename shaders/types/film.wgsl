// The film: sums of linear radiance, in two halves so that each stays within a binding's limit.

// Red, green.
@group(2) @binding(0) var<storage, read_write> film_rg: array<vec2f>;
// Blue, number of samples.
@group(2) @binding(1) var<storage, read_write> film_bw: array<vec2f>;

// A pixel's contribution to a sum over many pixels. NaN, negative and infinite values count as 0: one NaN
// would spoil the whole sum.
fn film_part(index: u32) -> vec3f {
    let color = film_mean(index);
    return select(vec3f(0.0), color, (color >= vec3f(0.0)) & (color < vec3f(1e30)));
}

fn film_mean(index: u32) -> vec3f {
    let bw = film_bw[index];
    return vec3f(film_rg[index], bw.x) / max(bw.y, 1.0);
}
