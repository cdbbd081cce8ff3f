// The next vertex of each path, at a surface or in a medium: gathers the light that the path's ray has met, selects a
// light for a shadow ray, and the direction of the path's next ray (J. Kajiya, The Rendering Equation, SIGGRAPH 1986).
// uses: lib/bsdf, lib/camera, lib/fog, lib/jittered, lib/lattice, lib/material, lib/octahedral, lib/path_cone
// uses: lib/path_light, lib/phase
// uses: types/dispatch_params, types/enqueue, types/frame_uniforms, types/gbuffer, types/guides, types/paths, types/ray

// Whether paths scatter in the set: 0 or 1; -1 reads it from the uniforms.
override HAS_MEDIUM: i32 = -1;

fn has_medium() -> bool {
    if (HAS_MEDIUM >= 0) { return HAS_MEDIUM == 1; }
    return frame.medium.kind != MEDIUM_NONE;
}

// Numbers of the random pairs of a vertex; other purposes have other numbers.
const FIRST_PAIR = 0x100u;
const PAIRS = 5u;
const PAIR_LOBE = 0u;
const PAIR_DIRECTION = 1u;
const PAIR_LIGHT = 2u;
const PAIR_PLACE = 3u;
const PAIR_CELL = 4u;

fn vertex_pair(site: Site, pair: u32) -> vec2f {
    return random_pair(site, FIRST_PAIR + PAIRS * dispatch.bounce + pair);
}

// Numbers of the random pairs of rays in fog.
const FIRST_FOG_PAIR = 0x400u;

// Distance at which a path's ray collides with fog, within `farthest`; the camera's ray has the number 0.
fn fog_distance_of(site: Site, number: u32, origin: vec3f, direction: vec3f, farthest: f32) -> f32 {
    if (!has_fog()) { return NO_COLLISION; }
    return fog_collision(origin, direction, farthest, random_pair(site, FIRST_FOG_PAIR + number).x);
}

// Number of bounces before paths may end at random.
const BOUNCES_BEFORE_ROULETTE = 2u;

// A ray shorter than this many hit distances lies in a gap below the resolved detail.
const GAP = 4.0;

// The hit distance at the path's vertex. In a gap it doubles from vertex to vertex, until the path has left the gap.
fn vertex_hit_distance(ray: Ray, depth: f32) -> f32 {
    let start = ray.radius / frame.march.shadow_margin;
    return select(ray.radius, 2.0 * start, dispatch.bounce > 0u && depth < GAP * start);
}

// Where a path scatters: at a surface, or in a medium.
struct Vertex {
    // At a surface lifted off it, so that the surface near the point does not shade it.
    point: vec3f,
    // `NO_NORMAL` in a medium.
    normal: vec3f,
    // Of a surface.
    f: Bsdf,
    // Of a medium: direction of the ray, and mean cosine of scattering.
    along: vec3f,
    anisotropy: f32,
    // Part of the light that a medium scatters.
    albedo: vec3f,
    // Sum of the lights' importance.
    total_importance: f32,
    // The hit distance there.
    hit_distance: f32,
}

fn is_in_medium(vertex: Vertex) -> bool {
    return (has_fog() || has_medium()) && all(vertex.normal == NO_NORMAL);
}

// Part of the light from `wi` that goes on along the path, with the cosine at a surface.
fn scattered(vertex: Vertex, wi: vec3f) -> vec3f {
    if (is_in_medium(vertex)) { return vertex.albedo * phase_value(vertex.anisotropy, vertex.along, wi); }
    return bsdf_value(vertex.f, wi);
}

// Density over solid angle with which `next_direction` selects `wi`.
fn direction_density(vertex: Vertex, wi: vec3f) -> f32 {
    if (is_in_medium(vertex)) { return phase_value(vertex.anisotropy, vertex.along, wi); }
    return bsdf_density(vertex.f, wi);
}

fn next_direction(vertex: Vertex, lobe: f32, at: vec2f) -> vec3f {
    if (is_in_medium(vertex)) { return phase_sample(vertex.anisotropy, vertex.along, at); }
    return bsdf_sample(vertex.f, lobe, at);
}

// Next-event estimation: one light, chosen at random, times BSDF or phase function, transmittance and MIS weight.
fn sample_light(site: Site, vertex: Vertex) -> WeightedLight {
    if (frame.paths.strategy == STRATEGY_BSDF) { return NO_WEIGHTED_LIGHT; }
    let chosen = chosen_light(vertex.point, vertex.normal, vertex.total_importance, vertex_pair(site, PAIR_LIGHT).x);
    if (chosen == NO_LIGHT) { return NO_WEIGHTED_LIGHT; }
    let place = vertex_pair(site, PAIR_PLACE);
    let is_both = frame.paths.strategy == STRATEGY_MIS;
    if (chosen == SKY) {
        let seen = sky_sample(vertex_pair(site, PAIR_CELL), place);
        let density = frame.paths.sky_importance / vertex.total_importance * seen.density;
        let other = select(0.0, direction_density(vertex, seen.direction), is_both);
        let part = scattered(vertex, seen.direction) / max(density + other, 1e-30);
        let passed = fog_transmittance(vertex.point, seen.direction, NO_COLLISION);
        return WeightedLight(passed * part * sky_radiance(seen.direction), seen.direction, frame.paths.sky_reach);
    }
    let light = path_light(chosen);
    let cone = cone_of(light, vertex.point);
    let seen = cone_sample(cone, place);
    let share = light_importance(light, cone, vertex.normal) / vertex.total_importance;
    let density = share * cone_density(cone);
    var weight = 1.0;
    if (is_both && density > 0.0) { weight = balance_weight(density, direction_density(vertex, seen.toward)); }
    let passed = fog_transmittance(vertex.point, seen.toward, seen.distance);
    let irradiance = light.color * (PI * seen.gain * weight * passed / share);
    return WeightedLight(
        irradiance * scattered(vertex, seen.toward), seen.toward, blocked_distance(light, seen.distance));
}

// MIS-weighted light that the path's next ray may meet before it ends in fog; of several lights one, at random by
// luminance.
fn light_along_ray(vertex: Vertex, direction: vec3f, density: f32, fog_distance: f32, u: f32) -> WeightedLight {
    if (frame.paths.strategy == STRATEGY_LIGHTS) { return NO_WEIGHTED_LIGHT; }
    let is_both = frame.paths.strategy == STRATEGY_MIS;
    var seen = NO_WEIGHTED_LIGHT;
    var whole = 0.0;
    var left = u;
    if (has_sky() && fog_distance >= NO_COLLISION) {
        // In a black sky no light may reach the vertex at all.
        let other = frame.paths.sky_importance / max(vertex.total_importance, 1e-30) * sky_density(direction);
        seen.radiance = sky_radiance(direction) * balance_weight(density, select(0.0, other, is_both));
        seen.distance = frame.paths.sky_reach;
        whole = luminance(seen.radiance);
    }
    for (var k = 0u; k < path_light_count(); k++) {
        let light = path_light(k);
        if (light.size <= 0.0) { continue; }
        let cone = cone_of(light, vertex.point);
        let off = direction - cone.axis;
        // 1 minus the cosine of the angle to the axis.
        let one_minus_cos = 0.5 * dot(off, off);
        let importance = light_importance(light, cone, vertex.normal);
        if (one_minus_cos >= cone.one_minus_cos || importance <= 0.0) { continue; }
        let distance = cone_distance(cone, one_minus_cos);
        if (distance > fog_distance) { continue; }
        let other = importance / vertex.total_importance * cone_density(cone);
        let radiance = cone_radiance(light, cone) * balance_weight(density, select(0.0, other, is_both));
        let luminous = luminance(radiance);
        whole += luminous;
        let part = luminous / max(whole, 1e-30);
        if (left < part) {
            seen.radiance = radiance;
            seen.distance = blocked_distance(light, distance);
            left = left / max(part, 1e-30);
        } else {
            left = (left - part) / max(1.0 - part, 1e-30);
        }
    }
    seen.radiance *= whole / max(luminance(seen.radiance), 1e-30);
    return seen;
}

// The normal, bent toward the viewer where it faces away.
fn facing(n: vec3f, wo: vec3f) -> vec3f {
    let cosine = dot(n, wo);
    if (cosine >= 1e-3) { return n; }
    return normalize(n + (1e-3 - cosine) * wo);
}

fn new_path() -> PathState {
    let none = vec3f(0.0);
    let white = pack_path_guides(vec3f(1.0), none);
    return PathState(vec3f(1.0), 0.0, none, PATH_SCATTERED, none, 0.0, none, white, none);
}

// The vertex of a path at a surface, which may emit.
fn surface_vertex(site: Site, path: ptr<function, PathState>, ray: Ray, seen: vec2u) -> Vertex {
    let wo = -ray.direction;
    let outward = octahedral_unpack(seen.y);
    let m = material_at(color_data[site.index], seen.y);
    (*path).radiance += (*path).throughput * m.emission;
    let n = facing(outward, wo);
    let clearance = vertex_hit_distance(ray, bitcast<f32>(seen.x));
    let point = ray.origin + outward * (2.0 * clearance);
    let total = total_importance(point, n);
    if (dispatch.bounce == 0u) { (*path).guides = pack_path_guides(m.color, outward); }
    return Vertex(point, n, bsdf_of(m, n, wo), vec3f(0.0), 0.0, vec3f(0.0), total, clearance);
}

// The vertex of a path at the start of `ray`, in a medium.
fn medium_vertex(ray: Ray, albedo: vec3f, anisotropy: f32) -> Vertex {
    var vertex: Vertex;
    vertex.point = ray.origin;
    vertex.normal = NO_NORMAL;
    vertex.along = ray.direction;
    vertex.anisotropy = anisotropy;
    vertex.albedo = albedo;
    vertex.total_importance = total_importance(ray.origin, NO_NORMAL);
    vertex.hit_distance = ray.radius;
    return vertex;
}

// Extends a path at a vertex; true if the path's next ray is needed.
fn scatter_path(site: Site, path: ptr<function, PathState>, vertex: Vertex) -> bool {
    let sampled = sample_light(site, vertex);
    (*path).nee_radiance = (*path).throughput * sampled.radiance;
    (*path).nee_direction = sampled.direction;
    (*path).nee_distance = sampled.distance;

    let lobe = vertex_pair(site, PAIR_LOBE);
    let direction = next_direction(vertex, lobe.x, vertex_pair(site, PAIR_DIRECTION));
    // The next ray starts at the lifted point, with the clearance of shadow rays.
    rays[site.ray] = Ray(vertex.point, frame.march.shadow_margin * vertex.hit_distance, direction, path_cone());
    (*path).ray_light = vec3f(0.0);
    let fog_distance = fog_distance_of(site, dispatch.bounce + 1u, vertex.point, direction, NO_COLLISION);
    store_fog_distance(site.index, fog_distance);
    let density = direction_density(vertex, direction);
    if (density <= 0.0) { return false; }
    let part = scattered(vertex, direction) / density;
    var throughput = (*path).throughput * part;
    let ahead = light_along_ray(vertex, direction, density, fog_distance, vertex_pair(site, PAIR_LIGHT).y);
    (*path).ray_light = throughput * ahead.radiance;
    (*path).ray_light_distance = ahead.distance;
    if (dispatch.bounce >= frame.paths.bounces) { return any((*path).ray_light > vec3f(0.0)); }
    // Russian roulette: the paths that go on carry the light of those that end.
    if (dispatch.bounce >= BOUNCES_BEFORE_ROULETTE) {
        let survival = min(max(throughput.r, max(throughput.g, throughput.b)), 1.0);
        if (lobe.y >= survival) {
            (*path).ray_light = vec3f(0.0);
            return false;
        }
        throughput /= survival;
        (*path).ray_light /= survival;
    }
    (*path).throughput = throughput;
    return any(throughput > vec3f(0.0));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let site = path_site(thread.x);
    if (!site.is_there) { return; }
    let seen = surface[site.index];
    let is_first = dispatch.bounce == 0u;
    var path = new_path();
    if (is_first && seen.x == SKIPPED) {
        path.end = PATH_SKIPPED;
        paths[site.ray] = path;
        return;
    }
    let depth = bitcast<f32>(seen.x);
    // Starts at its surface point, if it has one.
    var ray = rays[site.ray];
    var fog_distance = NO_COLLISION;
    if (is_first && has_fog()) {
        let farthest = select(NO_COLLISION, depth, depth > 0.0);
        let from_eye = camera_ray(site);
        fog_distance = fog_distance_of(site, 0u, from_eye.origin, from_eye.direction, farthest);
        if (fog_distance < NO_COLLISION) { ray = from_eye; }
    }
    if (!is_first) {
        fog_distance = stored_fog_distance(site.index);
        path = paths[site.ray];
        if (depth == 0.0 || depth >= path.ray_light_distance) { path.radiance += path.ray_light; }
        path.ray_light = vec3f(0.0);
    }
    path.nee_radiance = vec3f(0.0);
    let is_within_bounces = dispatch.bounce <= frame.paths.bounces;
    let is_within_reach = is_first || (depth < frame.paths.reach && is_within_bounces);
    let is_in_fog = has_fog() && fog_distance < NO_COLLISION && (is_first || depth == 0.0);
    let is_at_set = !is_in_fog && depth > 0.0 && is_within_reach;
    if (is_at_set || (is_in_fog && is_within_bounces)) {
        var vertex: Vertex;
        if (is_in_fog) {
            vertex = medium_vertex(advanced(ray, fog_distance), frame.fog.color, frame.fog.anisotropy);
        } else if (has_medium()) {
            vertex = medium_vertex(ray, frame.medium.color, frame.medium.anisotropy);
        } else {
            vertex = surface_vertex(site, &path, ray, seen);
        }
        let goes_on = scatter_path(site, &path, vertex);
        if (any(path.nee_radiance > vec3f(0.0))) { enqueue_sample(SHADOW_REGION, dispatch.ray_queue + 1u, site.ray); }
        if (goes_on) { enqueue_sample(next_region(), dispatch.ray_queue + 2u, site.ray); }
    } else if (is_first) {
        path.end = PATH_ESCAPED;
    }
    paths[site.ray] = path;
}
