// How a surface point reflects light.
// uses: lib/luminance, lib/surface_color, types/frame_uniforms

// The model that this pipeline computes: a `SURFACE_` constant; -1 reads it from the uniforms.
override SURFACE_MODEL: i32 = -1;

fn is_blinn_phong() -> bool {
    if (SURFACE_MODEL >= 0) { return u32(SURFACE_MODEL) == SURFACE_BLINN_PHONG; }
    return frame.surface.model == SURFACE_BLINN_PHONG;
}

struct Material {
    // The surface's colour.
    color: vec3f,
    // Physical: GGX width, roughness squared. Blinn-Phong: the exponent.
    alpha: f32,
    // Part of the light that the diffuse lobe reflects; for physical surfaces before the lobes above take theirs.
    diffuse: vec3f,
    // Part of the surface under a clear coat.
    coat: f32,
    // Part that is metal.
    metalness: f32,
    // Strength of Blinn-Phong's highlight.
    specular: f32,
    // GGX width of the coat.
    coat_alpha: f32,
    // Emitted radiance.
    emission: vec3f,
}

// Least squared roughness: smoother surfaces are mirrors to an f32.
const MIN_ALPHA = 1e-3;

fn alpha_of(roughness: f32) -> f32 {
    return max(roughness * roughness, MIN_ALPHA);
}

// A value of the surface, times the second layer's brightness if the layer drives the value.
fn driven(value: f32, flag: u32, brightness: f32) -> f32 {
    return value * select(1.0, brightness, (frame.surface.driven & flag) != 0u);
}

// The material of a sample with the layers' values `stored` and the packed normal `normal`.
fn material_at(stored: vec2f, normal: u32) -> Material {
    let color = surface_color(stored, normal);
    let s = frame.surface;
    var drive = vec3f(1.0);
    if (s.driven != 0u && stored.y != ON_SECTION) {
        drive = layer_color(frame.second_layer, 1u, stored.y, normal);
    }
    let brightness = luminance(drive);
    // Cuts have no second layer.
    let is_driven = (s.driven & DRIVES_EMISSION) != 0u && stored.y != ON_SECTION;
    let emission_color = select(color, drive, is_driven);
    let emission = s.emission * emission_color;
    if (is_blinn_phong()) {
        return Material(color, s.shininess, s.diffuse * color, 0.0, 0.0, s.specular, 0.0, emission);
    }
    let metalness = driven(s.metalness, DRIVES_METALNESS, brightness);
    return Material(
        color,
        alpha_of(driven(s.roughness, DRIVES_ROUGHNESS, brightness)),
        (1.0 - metalness) * color,
        driven(s.coat, DRIVES_COAT, brightness),
        metalness,
        0.0,
        alpha_of(s.coat_roughness),
        emission);
}
