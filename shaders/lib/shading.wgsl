// Light and colour of a sample. Shading marches no ray: it reads visibility bits.
// uses: lib/environment_map, lib/eye, lib/lattice, lib/octahedral, types/dispatch_params
// uses: types/film, types/frame_uniforms, types/light, types/ray

// Whether this pipeline shows the environment map: 0 no, 1 yes, -1 reads it from the uniforms.
override HAS_ENVIRONMENT_MAP: i32 = -1;

fn has_environment_map() -> bool {
    if (HAS_ENVIRONMENT_MAP >= 0) { return HAS_ENVIRONMENT_MAP == 1; }
    return frame.background.map_gain > 0.0;
}

const SOURCE_ITERATIONS = 0u;
const SOURCE_ORIGIN_TRAP = 1u;
const SOURCE_AXIS_TRAP = 2u;

const GRADIENT_ENTRIES = 256u;
// The surface's colour gradient, linear Rec. 709, periodic.
@group(0) @binding(4) var<uniform> gradient: array<vec4f, GRADIENT_ENTRIES>;

fn gradient_color(u: f32) -> vec3f {
    let x = fract(u) * f32(GRADIENT_ENTRIES);
    let low = u32(x) % GRADIENT_ENTRIES;
    return mix(gradient[low].rgb, gradient[(low + 1u) % GRADIENT_ENTRIES].rgb, fract(x));
}

fn surface_color(data: vec2u) -> vec3f {
    let first = unpack2x16unorm(data.x);
    let second = unpack2x16unorm(data.y) * 2.0;
    var value = second.y;
    if (frame.surface.color_source == SOURCE_ITERATIONS) {
        value = first.x * f32(frame.march.iterations + 1u);
    } else if (frame.surface.color_source == SOURCE_ORIGIN_TRAP) {
        value = first.y * 2.0;
    } else if (frame.surface.color_source == SOURCE_AXIS_TRAP) {
        value = second.x;
    }
    return gradient_color(value * frame.surface.color_repeats + frame.surface.color_offset);
}

// Blinn-Phong (Blinn 1977) summed over the lights that reach the point. Without normals (thesis
// fig. 3.3 a) every point faces every light, and there are no highlights.
fn reflected(point: vec3f, n: vec3f, toward_eye: vec3f, color: vec3f, bits: vec2u) -> vec3f {
    var sum = color * frame.surface.ambient;
    for (var k = 0u; k < frame.surface.light_count; k++) {
        let light = lights[k];
        // Black lights and lights without shadows have no shadow rays: their visibility bits are undefined.
        if (all(light.color == vec3f(0.0))) { continue; }
        if (light.casts_shadows != 0u && !has_light(bits, light)) { continue; }
        var toward_light = light.vector;
        var radiance = light.color;
        if (light.kind == LIGHT_POINT) {
            let offset = light.vector - point;
            let distance_squared = max(dot(offset, offset), 1e-24);
            toward_light = offset * inverseSqrt(distance_squared);
            radiance /= distance_squared;
        }
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
    let color = surface_color(color_data[site.index]);
    return reflected(ray.origin, octahedral_unpack(seen.y), -ray.direction, color, visibility[site.index]);
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
