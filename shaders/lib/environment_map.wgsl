// The environment map, equirectangular: the upper edge is +z, the middle +y in the map's
// own frame. Host twin: `scene::environment_map`.

@group(3) @binding(0) var environment_map: texture_2d<f32>;
@group(3) @binding(1) var environment_sampler: sampler;

// Radiance from a unit direction in the map's frame.
fn environment_at(direction: vec3f) -> vec3f {
    let aside = length(direction.xy);
    // The azimuth is undefined straight up and down.
    let azimuth = select(0.0, atan2(direction.x, direction.y), aside > 1e-7);
    let polar = atan2(aside, direction.z);
    let place = vec2f(azimuth * 0.15915494 + 0.5, polar * 0.31830989);
    return textureSampleLevel(environment_map, environment_sampler, place, 0.0).rgb;
}
