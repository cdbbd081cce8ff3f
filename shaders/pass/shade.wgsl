// Light and colour of each sample: to the film, or to `direct` as the source of indirect light.
// uses: lib/lattice, lib/put_on_film, lib/shading, lib/shared_exponent, types/direct, types/dispatch_params
// uses: types/frame_uniforms, types/gbuffer, types/ray

// True if this pipeline shades single samples: a loop of one turn is slow on llvmpipe.
override SINGLE: bool = false;

fn shaded(site: Site) -> vec3f {
    // Fog between the eye and a surface does not dim the light that the surface sends to others.
    if (frame.indirect.kind != INDIRECT_OFF) { return clear_radiance(site, rays[site.ray]); }
    return direct_radiance(site, rays[site.ray]);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let first = pixel_site(thread.x);
    if (!first.is_there) { return; }
    var sum = vec3f(0.0);
    var weight = 0.0;
    if (SINGLE) {
        sum = shaded(first);
        weight = opacity(first, rays[first.ray]);
    }
    for (var i = 0u; !SINGLE && i < dispatch.samples; i++) {
        let site = sample_site(first, i);
        sum += shaded(site);
        weight += opacity(site, rays[site.ray]);
    }
    if (frame.indirect.kind == INDIRECT_OFF) {
        put_on_film(first.pixel, sum, weight);
    } else {
        // Centre samples only.
        direct[pixel_index(first.pixel)] = shared_exponent_pack(sum);
    }
}
