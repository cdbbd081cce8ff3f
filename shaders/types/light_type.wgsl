// One light. Host twin: `render::uniforms::Light`.

struct Light {
    // Environment light: unit vector toward the light. Point light: position in render space.
    vector: vec3f,
    // 0 environment, 1 point.
    kind: u32,
    // Irradiance of a surface that faces the light, over pi; of point lights at distance 1. Black while muted.
    color: vec3f,
    // 1 if surfaces block the light.
    casts_shadows: u32,
    // Greatest distance of a blocker from the point, in render space.
    shadow_reach: f32,
    // Index of the light's visibility bit.
    bit: u32,
    // Environment light: sine of half its apparent diameter. Point light: radius in render space.
    size: f32,
    // Index among the scene's lights.
    seed: u32,
}
