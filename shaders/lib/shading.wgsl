// Direct light of a sample. Shading marches no ray: it reads visibility bits.
// uses: lib/background, lib/bsdf, lib/eye, lib/fog, lib/lattice, lib/light_sample, lib/material, lib/octahedral
// uses: types/dispatch_params, types/frame_uniforms, types/light, types/ray

// Light of all lights that reach the point, reflected toward the eye; ambient light and the surface's own light. Without
// normals (thesis fig. 3.3 a) every point faces every light, and there are no highlights.
fn reflected(site: Site, point: vec3f, n: vec3f, toward_eye: vec3f, m: Material, bits: vec2u) -> vec3f {
    let f = bsdf_of(m, n, toward_eye);
    var sum = m.emission + frame.surface.ambient * m.color;
    for (var k = 0u; k < frame.surface.light_count; k++) {
        let light = lights[k];
        // Black lights and lights without shadows have no shadow rays: their visibility bits are undefined.
        if (all(light.color == vec3f(0.0))) { continue; }
        if (light.casts_shadows != 0u && !has_light(bits, light)) { continue; }
        let seen = light_sample(LightShape(light.vector, light.kind, light.size, light.seed), point, site);
        let radiance = seen.gain * light.color;
        if (frame.normals == NORMALS_NONE) {
            sum += radiance * m.diffuse;
            continue;
        }
        sum += PI * radiance * bsdf_value(f, seen.toward);
    }
    return sum;
}

// Direct light that a sample reflects to the eye, without fog. The ray starts at the sample's surface point, if it has
// one.
fn clear_radiance(site: Site, ray: Ray) -> vec3f {
    let seen = surface[site.index];
    if (seen.x == 0u) {
        return background(ray.direction, eye_position(site.pixel, place_in_pixel(site.sample)).y);
    }
    let m = material_at(color_data[site.index], seen.y);
    return reflected(site, ray.origin, octahedral_unpack(seen.y), -ray.direction, m, visibility[site.index]);
}

// The part of a sample that a transparent background leaves to fog and surface.
fn opacity(site: Site, ray: Ray) -> f32 {
    if (!is_transparent() || surface[site.index].x != 0u) { return 1.0; }
    return 1.0 - fog_transmittance(ray.origin, ray.direction, NO_COLLISION);
}

// The same through fog.
fn direct_radiance(site: Site, ray: Ray) -> vec3f {
    let radiance = clear_radiance(site, ray);
    let depth = bitcast<f32>(surface[site.index].x);
    if (depth == 0.0) { return through_fog(radiance, ray.origin, ray.direction, NO_COLLISION); }
    return through_fog(radiance, ray.origin, -ray.direction, depth);
}
