// Where a sample sees a light: lights with a size are seen at another place by each sample, so that the mean of
// many samples has soft shadows.
// uses: lib/basis, lib/jittered, lib/lattice, types/dispatch_params, types/frame_uniforms

// A light, as far as rays toward it go.
struct LightShape {
    // Environment light: unit vector toward the light. Point light: position in render space.
    vector: vec3f,
    // 0 environment, 1 point.
    kind: u32,
    // Environment light: sine of half its apparent diameter. Point light: radius in render space.
    size: f32,
    // The light's own number, for its random numbers.
    seed: u32,
}

// A light as a point sees it: a cone of directions.
struct LightCone {
    // Unit vector toward the centre.
    axis: vec3f,
    // Distance of the centre; large for environment lights.
    distance: f32,
    // 1 minus the cosine of half the cone's angle; 0 for lights without a size.
    one_minus_cos: f32,
    // Radius of a point light; 0 for environment lights.
    radius: f32,
    // Factor from `Light.color` to the irradiance over pi of a surface that faces the centre, if all light came from there.
    gain: f32,
}

fn light_cone(light: LightShape, point: vec3f) -> LightCone {
    var axis = light.vector;
    var distance = 1e30;
    var gain = 1.0;
    var sine = light.size;
    var radius = 0.0;
    if (light.kind == LIGHT_POINT) {
        let offset = light.vector - point;
        let squared = max(dot(offset, offset), 1e-24);
        // A point within a light sees its surface's strength.
        gain = 1.0 / max(squared, light.size * light.size);
        axis = offset * inverseSqrt(squared);
        distance = length(offset);
        radius = light.size;
        // From within a light, half of all directions see it.
        sine = min(radius / max(distance, 1e-30), 1.0);
    }
    return LightCone(axis, distance, sine * sine / (1.0 + sqrt(max(1.0 - sine * sine, 0.0))), radius, gain);
}

// Irradiance of a surface that faces the place of a light where `cone` is sampled evenly by solid angle, over that of
// a light that is all at the centre: the mean over all places is then the light's irradiance.
fn cone_gain(cone: LightCone) -> f32 {
    return 2.0 / (2.0 - cone.one_minus_cos);
}

struct LightSample {
    // Unit vector toward the sampled place.
    toward: vec3f,
    // Distance of that place; large for environment lights.
    distance: f32,
    // Irradiance of a surface that faces the place, over the light's radiance or strength.
    gain: f32,
}

// Distance at which a direction of the cone meets the light; `one_minus_cos` is 1 minus the cosine of its angle to the axis.
fn cone_distance(cone: LightCone, one_minus_cos: f32) -> f32 {
    if (cone.radius <= 0.0) { return cone.distance; }
    // The nearer of the two places where the ray meets the light's surface.
    let beside_squared = cone.distance * cone.distance * one_minus_cos * (2.0 - one_minus_cos);
    let half_chord = sqrt(max(cone.radius * cone.radius - beside_squared, 0.0));
    return max(cone.distance * (1.0 - one_minus_cos) - half_chord, 0.0);
}

// A place on the light, sampled evenly by solid angle
// (M. Pharr et al., Physically Based Rendering, 4th ed. 2023, section 6.2.4).
fn cone_sample(cone: LightCone, at: vec2f) -> LightSample {
    let one_minus_cos = at.x * cone.one_minus_cos;
    let sin_theta = sqrt(max(one_minus_cos * (2.0 - one_minus_cos), 0.0));
    let direction = from_polar(cone.axis, sin_theta, 1.0 - one_minus_cos, at.y);
    return LightSample(direction, cone_distance(cone, one_minus_cos), cone_gain(cone) * cone.gain);
}

// The light as `point` sees it. Centre samples see its centre.
fn light_sample(light: LightShape, point: vec3f, site: Site) -> LightSample {
    let cone = light_cone(light, point);
    if (light.size <= 0.0 || !is_jittered()) { return LightSample(cone.axis, cone.distance, cone.gain); }
    var seen = cone_sample(cone, random_pair(site, light.seed));
    // Without normals no cosine is applied, which the gain would make up for.
    if (frame.normals == NORMALS_NONE) { seen.gain = cone.gain; }
    return seen;
}
