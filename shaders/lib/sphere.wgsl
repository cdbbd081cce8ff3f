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
