// Lights as a path sees them: the scene's single lights, the sun, and the sky, each with a share in the choice.
// uses: lib/light_sample, lib/luminance, lib/sky, types/frame_uniforms, types/light

// The index of the sky among a path's lights; the sun is the one after the single lights.
const SKY = 0xffffu;
// The index if no light reaches the point.
const NO_LIGHT = 0xfffeu;

// Strategies that gather light; both together are multiple importance sampling by the balance heuristic
// (E. Veach, Robust Monte Carlo Methods for Light Transport Simulation, 1997, section 9.2.2).
const STRATEGY_MIS = 0u;
const STRATEGY_LIGHTS = 1u;
const STRATEGY_BSDF = 2u;

fn path_light_count() -> u32 {
    return frame.paths.light_count + 1u;
}

fn path_light(index: u32) -> Light {
    if (index < frame.paths.light_count) { return lights[index]; }
    return frame.paths.sun;
}

fn cone_of(light: Light, point: vec3f) -> LightCone {
    return light_cone(LightShape(light.vector, light.kind, light.size, light.seed), point);
}

// The normal of points in a medium, which all lights reach.
const NO_NORMAL = vec3f(0.0);

// Unnormalised selection probability of a light: an estimate of its irradiance over pi.
fn light_importance(light: Light, cone: LightCone, n: vec3f) -> f32 {
    let strength = luminance(light.color) * cone.gain;
    if (all(n == NO_NORMAL)) { return strength; }
    let sine = sqrt(cone.one_minus_cos * (2.0 - cone.one_minus_cos));
    return strength * saturate(dot(n, cone.axis) + sine);
}

// Sum over all lights.
fn total_importance(point: vec3f, n: vec3f) -> f32 {
    var sum = frame.paths.sky_importance;
    for (var k = 0u; k < path_light_count(); k++) {
        let light = path_light(k);
        sum += light_importance(light, cone_of(light, point), n);
    }
    return sum;
}

// The light that a random number `u` selects, 0 to 1.
fn chosen_light(point: vec3f, n: vec3f, whole: f32, u: f32) -> u32 {
    if (whole <= 0.0) { return NO_LIGHT; }
    var left = u * whole - frame.paths.sky_importance;
    if (left < 0.0) { return SKY; }
    var chosen = NO_LIGHT;
    for (var k = 0u; k < path_light_count(); k++) {
        let light = path_light(k);
        let importance = light_importance(light, cone_of(light, point), n);
        if (importance <= 0.0) { continue; }
        chosen = k;
        left -= importance;
        if (left < 0.0) { break; }
    }
    return chosen;
}

// Density over solid angle of a light's sampled directions; 0 for lights without a size.
fn cone_density(cone: LightCone) -> f32 {
    return select(0.0, 1.0 / (6.2831853 * cone.one_minus_cos), cone.one_minus_cos > 0.0);
}

// Radiance of a light with a size: pi times its `color` is the irradiance of a surface that faces the light.
fn cone_radiance(light: Light, cone: LightCone) -> vec3f {
    return light.color * (0.5 * cone.gain * cone_gain(cone) / cone.one_minus_cos);
}

// Greatest distance of a surface that blocks a light at `distance`.
fn blocked_distance(light: Light, distance: f32) -> f32 {
    return select(0.0, min(distance, light.shadow_reach), light.casts_shadows != 0u);
}

// Weight of a sample of density `own` whose direction the other kind of sample has with density `other`.
fn balance_weight(own: f32, other: f32) -> f32 {
    return own / max(own + other, 1e-30);
}

// Light from one direction.
struct WeightedLight {
    // MIS-weighted radiance over the sample's density; times the BSDF if a light was sampled.
    radiance: vec3f,
    direction: vec3f,
    // Distance up to which surfaces block the light.
    distance: f32,
}

const NO_WEIGHTED_LIGHT = WeightedLight(vec3f(0.0), vec3f(0.0, 0.0, 1.0), 0.0);
