// Light and colour of a sample. Shading marches no ray: it reads visibility bits.
// uses: lib/color_value, lib/environment_map, lib/eye, lib/lattice, lib/light_sample, lib/octahedral, types/dispatch_params
// uses: types/film, types/frame_uniforms, types/light, types/ray

// Whether this pipeline shows the environment map: 0 no, 1 yes, -1 reads it from the uniforms.
override HAS_ENVIRONMENT_MAP: i32 = -1;

fn has_environment_map() -> bool {
    if (HAS_ENVIRONMENT_MAP >= 0) { return HAS_ENVIRONMENT_MAP == 1; }
    return frame.background.map_gain > 0.0;
}

const GRADIENT_ENTRIES = 256u;
// The gradients of the first and the second colour layer, linear Rec. 709, periodic.
@group(0) @binding(4) var<uniform> gradients: array<vec4f, 2u * GRADIENT_ENTRIES>;

// The colour at `u` in the gradient whose first entry is `first`.
fn gradient_color(first: u32, u: f32) -> vec3f {
    let x = fract(u) * f32(GRADIENT_ENTRIES);
    let low = u32(x) % GRADIENT_ENTRIES;
    let next = (low + 1u) % GRADIENT_ENTRIES;
    return mix(gradients[first + low].rgb, gradients[first + next].rgb, fract(x));
}

// Number of knots of a colour curve.
const COLOR_KNOTS = 64u;

// A layer's colour curve at a value: linear between knots, constant beyond them. `first` is its first knot.
fn color_curve(layer: ColorLayer, first: u32, value: f32) -> f32 {
    let along = (value - layer.curve_low) * layer.curve_per_value;
    let place = clamp(along, 0.0, 1.0) * f32(COLOR_KNOTS - 1u);
    let before = min(u32(place), COLOR_KNOTS - 2u);
    let low = first + before;
    // Read from the uniforms themselves: an index into the private copy would keep the copy in memory.
    let a = frame_uniforms.color_curves[low / 4u][low % 4u];
    let b = frame_uniforms.color_curves[(low + 1u) / 4u][(low + 1u) % 4u];
    return mix(a, b, place - f32(before));
}

// The colour of one layer; `number` is 0 or 1.
fn layer_color(layer: ColorLayer, number: u32, stored: f32, normal: u32) -> vec3f {
    var value = color_value(layer, stored, normal);
    if (layer.follows_view != 0u) { value = color_curve(layer, number * COLOR_KNOTS, value); }
    return gradient_color(number * GRADIENT_ENTRIES, value * layer.repeats + layer.offset);
}

// The colour of a section plane where orbits take so many smooth iterations (thesis eq. 3.1); -1: inside the set.
fn section_color(iterations: f32) -> vec3f {
    if (iterations < 0.0) { return frame.sections.inside; }
    return gradient_color(0u, iterations * frame.sections.repeats + frame.first_layer.offset);
}

// The colour of a sample with the layers' values `stored` and the packed normal `normal`.
fn surface_color(stored: vec2f, normal: u32) -> vec3f {
    if (stored.y == ON_SECTION) { return section_color(stored.x); }
    let color = layer_color(frame.first_layer, 0u, stored.x, normal);
    if (frame.second_layer.source == COLOR_NONE) { return color; }
    let second = layer_color(frame.second_layer, 1u, stored.y, normal);
    return mix(color, second, frame.second_layer.amount);
}

// Blinn-Phong (Blinn 1977) summed over the lights that reach the point. Without normals (thesis
// fig. 3.3 a) every point faces every light, and there are no highlights.
fn reflected(site: Site, point: vec3f, n: vec3f, toward_eye: vec3f, color: vec3f, bits: vec2u) -> vec3f {
    var sum = color * frame.surface.ambient;
    for (var k = 0u; k < frame.surface.light_count; k++) {
        let light = lights[k];
        // Black lights and lights without shadows have no shadow rays: their visibility bits are undefined.
        if (all(light.color == vec3f(0.0))) { continue; }
        if (light.casts_shadows != 0u && !has_light(bits, light)) { continue; }
        let seen = light_sample(LightShape(light.vector, light.kind, light.size, light.seed), point, site);
        let toward_light = seen.toward;
        let radiance = seen.gain * light.color;
        if (frame.normals == NORMALS_NONE) {
            sum += radiance * color * frame.surface.diffuse;
            continue;
        }
        let cosine = dot(n, toward_light);
        if (cosine <= 0.0) { continue; }
        let half_way = normalize(toward_light + toward_eye);
        let highlight = pow(max(dot(n, half_way), 0.0), frame.surface.shininess);
        sum += radiance * (color * (frame.surface.diffuse * cosine) + frame.surface.specular * highlight);
    }
    return sum;
}

// The background that a ray without a hit sees; `height` is 0 at the picture's upper edge, 1 at the lower.
fn background(direction: vec3f, height: f32) -> vec3f {
    let behind = frame.background;
    if (!has_environment_map()) { return mix(behind.top.rgb, behind.bottom.rgb, height); }
    let in_map = vec3f(
        dot(direction, behind.map_x), dot(direction, behind.map_y), dot(direction, behind.map_z));
    return behind.map_gain * environment_at(in_map);
}

// Direct light that a sample reflects to the eye. The ray starts at the sample's surface point, if it has
// one.
fn direct_radiance(site: Site, ray: Ray) -> vec3f {
    let seen = surface[site.index];
    if (seen.x == 0u) {
        return background(ray.direction, eye_position(site.pixel, place_in_pixel(site.sample)).y);
    }
    let color = surface_color(color_data[site.index], seen.y);
    return reflected(site, ray.origin, octahedral_unpack(seen.y), -ray.direction, color, visibility[site.index]);
}

// Adds the sum of a pixel's samples to the film, or replaces the film's value.
fn put_on_film(pixel: vec2u, sum: vec3f) {
    let at = pixel_index(pixel);
    let blue_weight = vec2f(sum.b, f32(dispatch.samples));
    if (dispatch.accumulate != 0u) {
        film_rg[at] += sum.rg;
        film_bw[at] += blue_weight;
    } else {
        film_rg[at] = sum.rg;
        film_bw[at] = blue_weight;
    }
}
