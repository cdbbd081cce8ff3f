// One light as the shaders see it. Host twin: `render::uniforms::Light`.

struct Light {
    // Environment: unit vector toward the light. Point: its position. World space.
    vector: vec3f,
    // 0 environment, 1 point.
    kind: u32,
    // Linear radiance; black while muted.
    color: vec3f,
    // 1 where surfaces block it.
    casts_shadows: u32,
    // How far a blocker may be, in the view's unit.
    shadow_reach: f32,
    // Which visibility bit is its own.
    bit: u32,
    unused_a: u32,
    unused_b: u32,
}

const MAX_LIGHTS = 64u;

@group(0) @binding(3) var<uniform> lights: array<Light, MAX_LIGHTS>;

// Whether a light's bit is among these.
fn has_light(bits: vec2u, light: Light) -> bool {
    return ((bits[light.bit >> 5u] >> (light.bit & 31u)) & 1u) != 0u;
}
