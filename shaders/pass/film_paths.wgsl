// Adds the light of finished paths to the film.
// uses: lib/background, lib/camera, lib/eye, lib/film_mean, lib/lattice, lib/luminance, lib/put_on_film
// uses: lib/shared_exponent
// uses: types/direct, types/dispatch_params, types/frame_uniforms, types/guides, types/traced_paths

// Steps of the counts of light, per firefly limit.
const LIGHT_STEPS = 8.0;
// Above this count of light, counting stops.
const MAX_LIGHT = 0x80000000u;

// Luminance of a thread's paths: of all, and of what the firefly limit took away.
var<workgroup> counted: array<vec2f, WORKGROUP_THREADS>;

// The light of a path that the firefly limit leaves.
fn limited(light: vec3f, count: ptr<function, vec2f>) -> vec3f {
    if (frame.paths.firefly_limit <= 0.0) { return light; }
    let whole = luminance(light);
    let left = min(whole, frame.paths.firefly_limit);
    *count += vec2f(whole, whole - left);
    return light * (left / max(whole, 1e-30));
}

// Adds a workgroup's light to the counts.
fn count_light() {
    var sum = vec2f(0.0);
    for (var i = 0u; i < WORKGROUP_THREADS; i++) { sum += counted[i]; }
    if (atomicLoad(&path_counts.light) >= MAX_LIGHT) { return; }
    let steps = vec2u(round(min(sum * (LIGHT_STEPS / frame.paths.firefly_limit), vec2f(1e8))));
    atomicAdd(&path_counts.light, steps.x);
    atomicAdd(&path_counts.clamped, steps.y);
}

// Films the paths of a thread's pixel, and returns their luminance, as in `counted`.
fn film(first: Site) -> vec2f {
    var count = vec2f(0.0);
    if (!first.is_there || paths[first.ray].end == PATH_SKIPPED) { return count; }
    var sum = vec3f(0.0);
    var weight = f32(dispatch.samples);
    var seen = Guides(vec3f(0.0), vec3f(0.0), 0.0);
    for (var i = 0u; i < dispatch.samples; i++) {
        let site = sample_site(first, i);
        let path = paths[site.ray];
        let here = unpack_path_guides(path.guides);
        seen.albedo += here.albedo;
        seen.normal += here.normal;
        if (path.end == PATH_SCATTERED) {
            sum += limited(path.radiance, &count);
            continue;
        }
        if (is_transparent()) { weight -= 1.0; }
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
    let added = f32(dispatch.samples);
    let part = added / (before + added);
    let albedo = mix(known.albedo, seen.albedo / added, part);
    guides[index] = pack_guides(Guides(albedo, mix(known.normal, seen.normal / added, part), 0.0));
    put_on_film(first.pixel, sum, weight);
    return count;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    counted[local_index] = film(pixel_site(thread.x));
    workgroupBarrier();
    if (local_index == 0u && frame.paths.firefly_limit > 0.0) { count_light(); }
}
