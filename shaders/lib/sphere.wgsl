// Where a ray is inside the sphere that holds the whole set.

// Distances of entry and exit along a unit direction; exit < entry where the ray passes by.
fn bounding_interval(origin: vec3f, direction: vec3f) -> vec2f {
    let b = dot(origin, direction);
    // The closest approach itself, rather than |origin|² - b²: no cancellation from afar.
    let closest = origin - b * direction;
    let half_chord_squared = picture.fractal.bounding_radius * picture.fractal.bounding_radius
        - dot(closest, closest);
    if (half_chord_squared <= 0.0) { return vec2f(1.0, -1.0); }
    let half_chord = sqrt(half_chord_squared);
    return vec2f(max(-b - half_chord, 0.0), half_chord - b);
}

// The least distance at which a ray from `origin` enters the sphere whose unit direction differs
// from `axis` by `spread` at most; negative where none of them does.
fn bounding_entry(origin: vec3f, axis: vec3f, spread: f32) -> f32 {
    // The direction among them that comes nearest to the centre.
    let toward = -origin / max(length(origin), 1e-30);
    let aside = toward - dot(toward, axis) * axis;
    // A little more than there is, for the arc is longer than its tangent.
    let edge = normalize(axis + 1.01 * spread / max(length(aside), 1e-30) * aside);
    let nearest = select(edge, toward, distance(toward, axis) <= spread);
    let interval = bounding_interval(origin, nearest);
    return select(interval.x, -1.0, interval.y < interval.x);
}
