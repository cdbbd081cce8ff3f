// Averages the films of sub-frames: puts the mean of this and all earlier sub-frames on the film.
// uses: lib/film_mean, lib/lattice, types/dispatch_params, types/film, types/frame_uniforms, types/guides
// uses: types/shutter

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = pixel_of_rows(workgroup.xy, local_index);
    if (!inside_region(pixel)) { return; }
    let index = pixel_index(pixel);
    var all = ShutterPixel(vec3f(0.0), 0.0, vec2u(0u), 0.0);
    if (dispatch.iteration > 0u) { all = shutter[index]; }
    let samples = film_bw[index].y;
    // Before a transparent background a moment counts by its opacity; else all moments of the shutter time count
    // alike, however many samples they needed.
    let is_transparent = frame.background.transparent_samples > 0.0;
    all.light += sample_mean(index) * select(1.0, samples, is_transparent);
    all.samples += samples;
    let share = 1.0 / f32(dispatch.iteration + 1u);
    if (frame.paths.ray_reach > 0.0) {
        all.moment += abs(moments[index]);
        moments[index] = all.moment;
        let before = unpack_guides(all.guides);
        let here = unpack_guides(guides[index]);
        let albedo = mix(before.albedo, here.albedo, share);
        all.guides = pack_guides(Guides(albedo, mix(before.normal, here.normal, share), 0.0));
        guides[index] = all.guides;
    }
    shutter[index] = all;
    let sum = all.light * select(share * all.samples, 1.0, is_transparent);
    film_rg[index] = sum.rg;
    film_bw[index] = vec2f(sum.b, all.samples);
}
