// The interval of a ray inside the set's bounding sphere, between the section planes.
// uses: lib/section, types/frame_uniforms

// A render-space point as scene units from the set's centre. Squares of lengths in a deep view's
// small unit may overflow an f32.
fn in_scene(point: vec3f) -> vec3f {
    return frame.march.anchor + frame.march.scale * point;
}

// A length in scene units, converted to render space.
fn in_view(length: f32) -> f32 {
    return length / frame.march.scale;
}

// Distances of entry and exit along a unit direction; exit < entry if the ray misses the sphere. Of a ray that passes
// beside the sphere, the distances are those of a sphere with the radius `beside`, in scene units.
fn sphere_interval(origin: vec3f, direction: vec3f, beside: f32) -> vec2f {
    let from_center = in_scene(origin);
    let b = dot(from_center, direction);
    // The closest approach itself instead of |origin|² - b²: no cancellation for a far origin.
    let closest = from_center - b * direction;
    let radius = frame.march.bounding_radius;
    var half_chord_squared = radius * radius - dot(closest, closest);
    if (half_chord_squared <= 0.0) { half_chord_squared = beside * beside - dot(closest, closest); }
    if (half_chord_squared <= 0.0) { return vec2f(1.0, -1.0); }
    let half_chord = sqrt(half_chord_squared);
    return vec2f(in_view(max(-b - half_chord, 0.0)), in_view(half_chord - b));
}

// The same for the part of the sphere under all section planes.
fn bounding_interval(origin: vec3f, direction: vec3f, beside: f32) -> vec2f {
    return clip_interval(sphere_interval(origin, direction, beside), origin, direction);
}

// The distance along a unit direction at which the last ray of a cone has left the sphere, or is over a section plane.
// The rays' origins are at most `width` from the axis through `origin`.
fn bounding_exit(origin: vec3f, direction: vec3f, width: f32) -> f32 {
    let from_center = in_scene(origin);
    let b = dot(from_center, direction);
    let aside = max(length(from_center - b * direction) - frame.march.scale * width, 0.0);
    let radius = frame.march.bounding_radius;
    let exit = in_view(sqrt(max(radius * radius - aside * aside, 0.0)) - b);
    return min(exit, cone_section_exit(origin, direction, width));
}

// The least distance at which a ray from `origin` is in the sphere and under all section planes, among rays whose unit
// directions differ from `axis` by at most `spread`; negative if all rays miss.
fn bounding_entry(origin: vec3f, axis: vec3f, spread: f32) -> f32 {
    // The direction among them that passes nearest to the centre.
    let from_center = in_scene(origin);
    let toward = -from_center / max(length(from_center), 1e-30);
    let aside = toward - dot(toward, axis) * axis;
    // Slightly more than `spread`, since the arc is longer than its tangent.
    let edge = normalize(axis + 1.01 * spread / max(length(aside), 1e-30) * aside);
    let nearest = select(edge, toward, distance(toward, axis) <= spread);
    let interval = sphere_interval(origin, nearest, frame.march.radius_beside);
    let entry = cone_section_entry(origin, axis, spread);
    return select(max(interval.x, entry), -1.0, interval.y < interval.x || entry < 0.0);
}
