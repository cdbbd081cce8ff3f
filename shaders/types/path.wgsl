// A light path in progress. Host twin: `render::uniforms::PathState`.

// The camera ray met a surface.
const PATH_SCATTERED = 0u;
// The camera ray met no surface.
const PATH_ESCAPED = 1u;
// The pixel gets no more samples.
const PATH_SKIPPED = 2u;

struct PathState {
    // Part of the radiance at the next vertex that reaches the film.
    throughput: vec3f,
    // Distance from which on the path's ray sees `ahead`.
    ahead_distance: f32,
    // Light gathered so far, as it reaches the film.
    radiance: vec3f,
    // A `PATH_` constant.
    end: u32,
    // Light of the light that the path's ray points at, as it reaches the film.
    ahead: vec3f,
    // Distance of the chosen light, at most its reach.
    shadow_distance: f32,
    // Light of the chosen light, as it reaches the film if nothing blocks it.
    pending: vec3f,
    // Unit vector toward the chosen light.
    toward: vec3f,
}
