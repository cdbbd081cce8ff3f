// A ray, and the cone about it that its pixel sees (ray cones: Akenine-Möller et al. 2021). Host twin:
// `render::uniforms::Ray`.
// uses: types/frame_uniforms

struct Ray {
    // In render space: the eye, then the surface point.
    origin: vec3f,
    // Radius of the cone at the origin; at a surface point, the hit distance.
    radius: f32,
    // Unit vector.
    direction: vec3f,
    // Radius of the cone per unit of depth, where that is more than the radius at the origin.
    spread: f32,
}

// Distance to the surface below which a ray at this depth has hit.
fn hit_distance(ray: Ray, depth: f32) -> f32 {
    return max(max(ray.radius, ray.spread * depth), frame.march.finest_hit);
}

// Radius that the balls of a camera ray grow from behind its cone, in hit distances: about half the last safe step of a cone
// of 4×2 pixels.
const BALL_BEHIND_CONE = 10.0;

// Radius of the largest ball that counts as empty where a camera ray begins behind its cone, at a depth.
fn largest_ball_behind_cone(ray: Ray, depth: f32) -> f32 {
    return frame.march.ball_growth * BALL_BEHIND_CONE * hit_distance(ray, depth);
}

// The ray from its point at a depth on.
fn advanced(ray: Ray, depth: f32) -> Ray {
    return Ray(ray.origin + depth * ray.direction, hit_distance(ray, depth), ray.direction, ray.spread);
}
