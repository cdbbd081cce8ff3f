// The film: sums of linear radiance, in two halves so that each stays within a binding's limit.

// Red, green.
@group(2) @binding(0) var<storage, read_write> film_rg: array<vec2f>;
// Blue, number of samples.
@group(2) @binding(1) var<storage, read_write> film_bw: array<vec2f>;

fn film_mean(index: u32) -> vec3f {
    let bw = film_bw[index];
    return vec3f(film_rg[index], bw.x) / max(bw.y, 1.0);
}
