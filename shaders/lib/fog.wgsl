// Fog: its optical depth along rays, and where rays collide with it. The density is full up to a level and falls
// exponentially above, in a ball; everything is in closed form.
// uses: types/frame_uniforms

// Whether this pipeline computes fog: 0 or 1; -1 reads it from the uniforms.
override HAS_FOG: i32 = -1;

// The distance of a collision that does not happen, and of what is infinitely far away.
const NO_COLLISION = 1e30;

// Density along a ray, as a function of the height over the level in scale heights.
struct FogRay {
    // Distances between which the ray is in the fog.
    start: f32,
    end: f32,
    // Height at `start`.
    height: f32,
    // Change of the height per unit of distance.
    rise: f32,
}

fn has_fog() -> bool {
    if (HAS_FOG >= 0) { return HAS_FOG == 1; }
    return frame.fog.density > 0.0;
}

// The part of a ray in the fog; for scenes with fog.
fn fog_ray(origin: vec3f, direction: vec3f, farthest: f32) -> FogRay {
    let fog = frame.fog;
    let from_center = origin - fog.center;
    let along = dot(from_center, direction);
    let beside = (from_center - along * direction) / fog.radius;
    let half_chord = fog.radius * sqrt(max(1.0 - dot(beside, beside), 0.0));
    let start = max(-along - half_chord, 0.0);
    let end = max(min(-along + half_chord, farthest), start);
    let height = ((from_center + start * direction).z - fog.level) * fog.inverse_height;
    return FogRay(start, end, height, direction.z * fog.inverse_height);
}

// Below this change of the height in scale heights, exponentials are replaced by their series.
const SMALL_CLIMB = 0.02;

// The integral of exp(-height) over a length on which the height begins at 0.
fn depth_from_level(rise: f32, length: f32) -> f32 {
    let climb = rise * length;
    if (abs(climb) < SMALL_CLIMB) { return length * (1.0 - climb * (0.5 - climb / 6.0)); }
    return (1.0 - exp(-climb)) / rise;
}

// The length over which that integral is `depth`; `NO_COLLISION` if it never is.
fn length_from_level(rise: f32, depth: f32) -> f32 {
    let climb = rise * depth;
    if (climb >= 1.0) { return NO_COLLISION; }
    if (abs(climb) < SMALL_CLIMB) { return depth * (1.0 + climb * (0.5 + climb / 3.0)); }
    return -log(1.0 - climb) / rise;
}

// The length at which a ray crosses the level; 0 if it does not come there.
fn level_crossing(ray: FogRay) -> f32 {
    let is_coming = (ray.height > 0.0 && ray.rise < 0.0) || (ray.height <= 0.0 && ray.rise > 0.0);
    return select(0.0, -ray.height / select(1.0, ray.rise, is_coming), is_coming);
}

// The integral of the density over full density, on this length from the ray's start on.
fn density_integral(ray: FogRay, length: f32) -> f32 {
    let crossing = level_crossing(ray);
    if (ray.height <= 0.0) {
        // Full density up to the level.
        if (ray.rise <= 0.0 || length <= crossing) { return length; }
        return crossing + depth_from_level(ray.rise, length - crossing);
    }
    let thin = select(length, min(length, crossing), ray.rise < 0.0);
    let above = exp(-ray.height) * depth_from_level(ray.rise, thin);
    return above + (length - thin);
}

// The length over which the integral is `depth`; `NO_COLLISION` if it never is.
fn length_of_integral(ray: FogRay, depth: f32) -> f32 {
    let crossing = level_crossing(ray);
    if (ray.height <= 0.0) {
        if (ray.rise <= 0.0 || depth <= crossing) { return depth; }
        return crossing + length_from_level(ray.rise, depth - crossing);
    }
    let density = exp(-ray.height);
    if (ray.rise < 0.0) {
        let above = density * depth_from_level(ray.rise, crossing);
        if (depth > above) { return crossing + (depth - above); }
    }
    if (density <= 1e-30) { return NO_COLLISION; }
    return length_from_level(ray.rise, min(depth / density, NO_COLLISION));
}

// The part of light that passes the fog from `origin` over `distance` in a unit direction.
fn fog_transmittance(origin: vec3f, direction: vec3f, distance: f32) -> f32 {
    if (!has_fog()) { return 1.0; }
    let ray = fog_ray(origin, direction, distance);
    return exp(-frame.fog.density * max(density_integral(ray, ray.end - ray.start), 0.0));
}

// The distance at which a ray first collides with the fog, by a random number of 0 to 1; `NO_COLLISION` if the ray goes
// `farthest` without. For scenes with fog.
fn fog_collision(origin: vec3f, direction: vec3f, farthest: f32, u: f32) -> f32 {
    let ray = fog_ray(origin, direction, farthest);
    let length = length_of_integral(ray, -log(max(1.0 - u, 1e-12)) / frame.fog.density);
    return select(NO_COLLISION, ray.start + length, length >= 0.0 && ray.start + length < ray.end);
}

// Fog in direct light: dims the radiance of a point `distance` away in a unit direction, and adds the fog's own.
fn through_fog(radiance: vec3f, origin: vec3f, direction: vec3f, distance: f32) -> vec3f {
    return mix(frame.fog.ambient, radiance, fog_transmittance(origin, direction, distance));
}
