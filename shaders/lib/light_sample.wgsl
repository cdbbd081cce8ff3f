// Where a sample sees a light: lights with a size are seen at another place by each sample, so that the mean of
// many samples has soft shadows.
// uses: lib/jittered, lib/lattice, types/dispatch_params, types/frame_uniforms

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

struct LightSample {
    // Unit vector toward the sampled place.
    toward: vec3f,
    // Distance of that place; large for environment lights.
    distance: f32,
    // Irradiance of a surface that faces the place, over the light's radiance or strength.
    gain: f32,
}

// The light as `point` sees it. Centre samples see its centre.
//
// A place on the light is sampled evenly by solid angle (M. Pharr et al., Physically Based Rendering, 4th ed. 2023,
// section 6.2.4), and counts as the whole light: the mean over all places is the light's irradiance.
fn light_sample(light: LightShape, point: vec3f, site: Site) -> LightSample {
    var toward = light.vector;
    var distance = 1e30;
    var gain = 1.0;
    if (light.kind == LIGHT_POINT) {
        let offset = light.vector - point;
        let squared = max(dot(offset, offset), 1e-24);
        // A point within a light sees its surface's strength.
        gain = 1.0 / max(squared, light.size * light.size);
        toward = offset * inverseSqrt(squared);
        distance = length(offset);
    }
    if (light.size <= 0.0 || !is_jittered()) { return LightSample(toward, distance, gain); }
    // From within a light, half of all directions see it.
    let sine = min(select(light.size, light.size / max(distance, 1e-30), light.kind == LIGHT_POINT), 1.0);
    let cosine = sqrt(1.0 - sine * sine);
    let at = random_pair(site, light.seed);
    // Height below 1 of a direction on the unit sphere about `toward`.
    let drop = at.x * sine * sine / (1.0 + cosine);
    let across = sqrt(max(drop * (2.0 - drop), 0.0));
    let turn = 6.2831853 * (at.y - 0.5);
    let side = orthogonal(toward);
    let direction =
        (1.0 - drop) * toward + across * (cos(turn) * side + sin(turn) * cross(toward, side));
    if (light.kind == LIGHT_POINT) {
        // The nearer of the two places where the ray meets the light's surface.
        let height = distance * (1.0 - drop);
        let beside = distance * across;
        distance = height - sqrt(max(light.size * light.size - beside * beside, 0.0));
    }
    // Without normals no cosine is applied, which the weight would make up for.
    let weight = select(2.0 / (1.0 + cosine), 1.0, frame.normals == NORMALS_NONE);
    return LightSample(direction, max(distance, 0.0), weight * gain);
}

// A unit vector at a right angle to a unit vector (T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017).
fn orthogonal(n: vec3f) -> vec3f {
    let sign = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (sign + n.z);
    return vec3f(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}
