// The picture of the surroundings, equirectangular: its upper edge is +z, its middle +y in its
// own frame. Host twin: `scene::panorama`.

@group(3) @binding(0) var surroundings: texture_2d<f32>;
@group(3) @binding(1) var surroundings_sampler: sampler;

// Radiance from a direction of length 1 in the picture's frame.
fn surroundings_at(direction: vec3f) -> vec3f {
    let aside = length(direction.xy);
    // Straight up and down there is no azimuth.
    let azimuth = select(0.0, atan2(direction.x, direction.y), aside > 1e-7);
    let polar = atan2(aside, direction.z);
    let place = vec2f(azimuth * 0.15915494 + 0.5, polar * 0.31830989);
    return textureSampleLevel(surroundings, surroundings_sampler, place, 0.0).rgb;
}
