// A light path in progress. Host twin: `render::uniforms::PathState`.

// The camera ray met a surface.
const PATH_SCATTERED = 0u;
// The camera ray met no surface.
const PATH_ESCAPED = 1u;
// The pixel gets no more samples.
const PATH_SKIPPED = 2u;

struct PathState {
    // Path throughput: factor from radiance at the next vertex to the film.
    throughput: vec3f,
    // Surfaces nearer than this block `ray_light`.
    ray_light_distance: f32,
    // Light gathered so far, as it reaches the film.
    radiance: vec3f,
    // A `PATH_` constant.
    end: u32,
    // Film radiance of the light along the path's ray.
    ray_light: vec3f,
    // Distance of the sampled light, at most its reach.
    nee_distance: f32,
    // Film radiance of the sampled light, if nothing blocks the light (next-event estimation).
    nee_radiance: vec3f,
    // Albedo and normal of the first vertex, packed by `pack_path_guides`.
    guides: u32,
    // Unit vector toward the sampled light.
    nee_direction: vec3f,
}
