// Section planes: each cuts away what is above it.
// uses: types/frame_uniforms

// Height of a point over a plane, in render space.
fn height_over(plane: vec4f, point: vec3f) -> f32 {
    return dot(plane.xyz, point) - plane.w;
}

// The part of a ray's interval under all planes; exit < entry if there is none.
fn clip_interval(interval: vec2f, origin: vec3f, direction: vec3f) -> vec2f {
    var left = interval;
    for (var k = 0u; k < frame.sections.count; k++) {
        let plane = frame.sections.planes[k];
        let rise = dot(plane.xyz, direction);
        let crossing = -height_over(plane, origin) / select(min(rise, -1e-20), max(rise, 1e-20), rise >= 0.0);
        if (rise >= 0.0) { left.y = min(left.y, crossing); } else { left.x = max(left.x, crossing); }
    }
    return left;
}

// Where a ray comes under all planes.
struct SectionEntry {
    // The depth; 0 if the ray starts there. Of no meaning if the clipped interval is empty.
    depth: f32,
    // Distance from the set within which that plane is drawn.
    band_reach: f32,
}

// The farthest plane that a ray crosses downward.
fn section_entry(origin: vec3f, direction: vec3f) -> SectionEntry {
    var entry = SectionEntry(0.0, 0.0);
    for (var k = 0u; k < frame.sections.count; k++) {
        let plane = frame.sections.planes[k];
        let depth = height_over(plane, origin) / max(-dot(plane.xyz, direction), 1e-20);
        if (depth > entry.depth) { entry = SectionEntry(depth, frame.sections.band_reach[k]); }
    }
    return entry;
}

// The normal of the plane that a point of a cut lies on.
fn section_normal(point: vec3f) -> vec3f {
    var highest = -1e30;
    var normal = vec3f(0.0, 0.0, 1.0);
    for (var k = 0u; k < frame.sections.count; k++) {
        let plane = frame.sections.planes[k];
        let height = height_over(plane, point);
        if (height > highest) {
            highest = height;
            normal = plane.xyz;
        }
    }
    return normal;
}

// The least depth at which a ray of a cone is under all planes. The rays start at `origin`, and their unit directions
// differ from `axis` by at most `spread`. Negative if none gets there.
fn cone_section_entry(origin: vec3f, axis: vec3f, spread: f32) -> f32 {
    var entry = 0.0;
    for (var k = 0u; k < frame.sections.count; k++) {
        let plane = frame.sections.planes[k];
        let height = height_over(plane, origin);
        if (height <= 0.0) { continue; }
        let fall = spread - dot(plane.xyz, axis);
        if (fall <= 0.0) { return -1.0; }
        entry = max(entry, height / fall);
    }
    return entry;
}

// The greatest distance along a unit direction at which a ray of a cone rises over a plane. The rays' origins are at
// most `width` from the axis through `origin`.
fn cone_section_exit(origin: vec3f, direction: vec3f, width: f32) -> f32 {
    var exit = 1e30;
    for (var k = 0u; k < frame.sections.count; k++) {
        let plane = frame.sections.planes[k];
        let rise = dot(plane.xyz, direction);
        if (rise > 0.0) { exit = min(exit, (width - height_over(plane, origin)) / max(rise, 1e-20)); }
    }
    return exit;
}

// Whether a plane is drawn around the set, so that cones may not pass it.
fn has_section_bands() -> bool {
    return any(frame.sections.band_reach > vec4f(0.0));
}
