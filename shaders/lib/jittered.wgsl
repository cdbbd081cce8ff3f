// Random numbers of jittered samples.
// uses: lib/eye, lib/lattice, lib/sobol, types/dispatch_params, types/frame_uniforms

// Whether the samples of the dispatch are jittered; else they are centre samples, which have no random numbers.
fn is_jittered() -> bool {
    return dispatch.compact != 0u;
}

// Two random numbers of a sample, 0 to 1; each purpose has its own.
fn random_pair(site: Site, purpose: u32) -> vec2f {
    let place = frame.origin_px + eye_pixel(site.pixel);
    return sobol_point(dispatch.first_sample + site.sample, hash_pair(place.x | (place.y << 16u), purpose));
}
