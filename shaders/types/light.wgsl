// The lights of the scene.
// uses: types/light_type

const MAX_LIGHTS = 64u;

@group(0) @binding(3) var<uniform> lights: array<Light, MAX_LIGHTS>;

// True if a light's bit is set in `bits`.
fn has_light(bits: vec2u, light: Light) -> bool {
    return ((bits[light.bit >> 5u] >> (light.bit & 31u)) & 1u) != 0u;
}
