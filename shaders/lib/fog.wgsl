// Fog: its optical depth along rays, and where rays meet it. The density is full up to a level and falls
// exponentially above, in a ball; everything is in closed form.
// uses: types/frame_uniforms

// The distance of a collision that does not happen.
const NO_COLLISION = 1e30;

// Density along a ray, as a function of the height over the level in scale heights.
struct FogRay {
    // Distances between which the ray is in the fog.
    start: f32,
    end: f32,
    // Height at `start`.
    height: f32,
    // Change of the height per unit of distance; 0 if the density is the same all along.
    rise: f32,
    // Extinction coefficient at full density, or all along.
    extinction: f32,
}

// A ray through fog of equal density up to this change of the height has an equal density.
const EVEN_RISE = 1e-3;

fn fog_ray(origin: vec3f, direction: vec3f, farthest: f32) -> FogRay {
    let fog = frame.fog;
    if (fog.density <= 0.0) { return FogRay(0.0, 0.0, 0.0, 0.0, 0.0); }
    let from_center = origin - fog.center;
    let along = dot(from_center, direction);
    let beside = (from_center - along * direction) / fog.radius;
    let half_chord = fog.radius * sqrt(max(1.0 - dot(beside, beside), 0.0));
    let start = max(-along - half_chord, 0.0);
    let end = max(min(-along + half_chord, farthest), start);
    let height = ((from_center + start * direction).z - fog.level) * fog.inverse_height;
    let rise = direction.z * fog.inverse_height;
    let whole = rise * (end - start);
    if (abs(whole) < EVEN_RISE) {
        let density = fog.density * exp(-max(height + 0.5 * whole, 0.0));
        return FogRay(start, end, height, 0.0, density);
    }
    return FogRay(start, end, height, rise, fog.density);
}

// The integral of exp(-max(x, 0)) from 0 to `height`.
fn density_below(height: f32) -> f32 {
    return select(1.0 - exp(-max(height, 0.0)), height, height < 0.0);
}

// The height below which the integral is `whole`; large if there is none.
fn height_of(whole: f32) -> f32 {
    if (whole >= 1.0) { return NO_COLLISION; }
    return select(-log(1.0 - max(whole, 0.0)), whole, whole < 0.0);
}

// The part of light that passes the fog from `origin` over `distance` in a unit direction.
fn fog_transmittance(origin: vec3f, direction: vec3f, distance: f32) -> f32 {
    let ray = fog_ray(origin, direction, distance);
    let way = ray.end - ray.start;
    if (ray.rise == 0.0) { return exp(-ray.extinction * way); }
    let depth = (density_below(ray.height + ray.rise * way) - density_below(ray.height)) / ray.rise;
    return exp(-ray.extinction * max(depth, 0.0));
}

// The distance at which a ray first meets the fog, by a random number of 0 to 1; `NO_COLLISION` if the ray goes
// `farthest` without.
fn fog_collision(origin: vec3f, direction: vec3f, farthest: f32, u: f32) -> f32 {
    let ray = fog_ray(origin, direction, farthest);
    if (ray.extinction <= 0.0) { return NO_COLLISION; }
    let depth = -log(max(1.0 - u, 1e-12)) / ray.extinction;
    var way = depth;
    if (ray.rise != 0.0) { way = (height_of(density_below(ray.height) + depth * ray.rise) - ray.height) / ray.rise; }
    let at = ray.start + way;
    return select(NO_COLLISION, at, way >= 0.0 && at < ray.end);
}

// The radiance of a point, seen through fog from `distance` away in a unit direction. Direct light lights fog evenly.
fn through_fog(radiance: vec3f, origin: vec3f, direction: vec3f, distance: f32) -> vec3f {
    return mix(frame.fog.ambient, radiance, fog_transmittance(origin, direction, distance));
}
