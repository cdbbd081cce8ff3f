// Adds the light of finished paths to the film.
// uses: lib/background, lib/camera, lib/eye, lib/film_mean, lib/lattice, lib/luminance, lib/put_on_film
// uses: lib/shared_exponent
// uses: types/direct, types/dispatch_params, types/frame_uniforms, types/guides, types/traced_paths

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    frame = frame_uniforms;
    let first = pixel_site(thread.x);
    if (!first.is_there) { return; }
    if (paths[first.ray].end == PATH_SKIPPED) { return; }
    var sum = vec3f(0.0);
    var seen = Guides(vec3f(0.0), vec3f(0.0), 0.0);
    for (var i = 0u; i < dispatch.samples; i++) {
        let site = sample_site(first, i);
        let path = paths[site.ray];
        let here = unpack_path_guides(path.guides);
        seen.albedo += here.albedo;
        seen.normal += here.normal;
        if (path.end == PATH_SCATTERED) {
            sum += path.radiance;
            continue;
        }
        let height = eye_position(site.pixel, place_in_pixel(site.sample)).y;
        sum += background(camera_ray(site).direction, height);
    }
    let index = pixel_index(first.pixel);
    let squared = luminance(sum) * luminance(sum) / f32(dispatch.samples);
    if (dispatch.accumulate == 0u) {
        direct[index] = shared_exponent_pack(sample_mean(index));
        moments[index] = squared;
    } else {
        moments[index] = abs(moments[index]) + squared;
    }
    // The mean of the guides over all samples.
    let known = unpack_guides(guides[index]);
    let before = f32(dispatch.accumulate) * film_bw[index].y;
    let count = f32(dispatch.samples);
    let part = count / (before + count);
    let albedo = mix(known.albedo, seen.albedo / count, part);
    guides[index] = pack_guides(Guides(albedo, mix(known.normal, seen.normal / count, part), 0.0));
    put_on_film(first.pixel, sum);
}
