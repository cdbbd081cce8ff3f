// Where a ray is inside the sphere that holds the whole set.

// A point of the view in scene units from the set's centre: squares of lengths that a deep view
// counts in its own unit may be past what an f32 holds.
fn in_scene(point: vec3f) -> vec3f {
    if (DEEP) { return frame.fractal.anchor + frame.fractal.scale * point; }
    return point;
}

// A length in scene units in those of the view.
fn in_view(length: f32) -> f32 {
    if (DEEP) { return length / frame.fractal.scale; }
    return length;
}

// Distances of entry and exit along a unit direction; exit < entry where the ray passes by.
fn bounding_interval(origin: vec3f, direction: vec3f) -> vec2f {
    let from_center = in_scene(origin);
    let b = dot(from_center, direction);
    // The closest approach itself, rather than |origin|² - b²: no cancellation from afar.
    let closest = from_center - b * direction;
    let half_chord_squared = frame.fractal.bounding_radius * frame.fractal.bounding_radius
        - dot(closest, closest);
    if (half_chord_squared <= 0.0) { return vec2f(1.0, -1.0); }
    let half_chord = sqrt(half_chord_squared);
    return vec2f(in_view(max(-b - half_chord, 0.0)), in_view(half_chord - b));
}

// How far along a unit direction the last of the rays leaves whose origins are `width` from one
// at most.
fn bounding_exit(origin: vec3f, direction: vec3f, width: f32) -> f32 {
    let from_center = in_scene(origin);
    let b = dot(from_center, direction);
    let aside = max(length(from_center - b * direction) - frame.fractal.scale * width, 0.0);
    let radius = frame.fractal.bounding_radius;
    return in_view(sqrt(max(radius * radius - aside * aside, 0.0)) - b);
}

// The least distance at which a ray from `origin` enters the sphere whose unit direction differs
// from `axis` by `spread` at most; negative where none of them does.
fn bounding_entry(origin: vec3f, axis: vec3f, spread: f32) -> f32 {
    // The direction among them that comes nearest to the centre.
    let from_center = in_scene(origin);
    let toward = -from_center / max(length(from_center), 1e-30);
    let aside = toward - dot(toward, axis) * axis;
    // A little more than there is, for the arc is longer than its tangent.
    let edge = normalize(axis + 1.01 * spread / max(length(aside), 1e-30) * aside);
    let nearest = select(edge, toward, distance(toward, axis) <= spread);
    let interval = bounding_interval(origin, nearest);
    return select(interval.x, -1.0, interval.y < interval.x);
}
