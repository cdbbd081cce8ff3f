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

// Direct light that a sample reflects to the eye. The ray starts at the sample's surface point, if it has
// one.
fn direct_radiance(site: Site, ray: Ray) -> vec3f {
    let seen = surface[site.index];
    if (seen.x == 0u) {
        let behind = background(ray.direction, eye_position(site.pixel, place_in_pixel(site.sample)).y);
        return through_fog(behind, ray.origin, ray.direction, NO_COLLISION);
    }
    let m = material_at(color_data[site.index], seen.y);
    let n = octahedral_unpack(seen.y);
    let radiance = reflected(site, ray.origin, n, -ray.direction, m, visibility[site.index]);
    return through_fog(radiance, ray.origin, -ray.direction, bitcast<f32>(seen.x));
}
