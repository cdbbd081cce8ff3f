// Writes samples to the film.
// uses: lib/lattice, types/dispatch_params, types/film

// Adds the sum of a pixel's samples to the film, or replaces the film's value. `weight` is the sum of their weights:
// their number, less what of them is transparent.
fn put_on_film(pixel: vec2u, sum: vec3f, weight: f32) {
    let at = pixel_index(pixel);
    let blue_weight = vec2f(sum.b, weight);
    if (dispatch.accumulate != 0u) {
        film_rg[at] += sum.rg;
        film_bw[at] += blue_weight;
    } else {
        film_rg[at] = sum.rg;
        film_bw[at] = blue_weight;
    }
}
