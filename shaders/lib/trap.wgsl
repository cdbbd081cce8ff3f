// The orbit traps of the colour layers. Host twin: `formula::trap`.
// uses: types/frame_uniforms

// The distance that counts as farthest.
const MAX_TRAP = 2.0;

// The distance of a point of an orbit from the layer's trap; 0 for layers without one.
fn trap_distance(layer: ColorLayer, z: vec3f) -> f32 {
    let away = z - layer.center;
    switch layer.source {
        case COLOR_POINT_TRAP: { return length(away); }
        case COLOR_AXIS_TRAP: { return length(cross(away, layer.axis)); }
        case COLOR_PLANE_TRAP: { return abs(dot(away, layer.axis)); }
        case COLOR_SPHERE_TRAP: { return abs(length(away) - layer.size); }
        case COLOR_CUBE_TRAP: {
            let beyond = abs(away) - layer.size;
            let inside = min(max(beyond.x, max(beyond.y, beyond.z)), 0.0);
            return abs(length(max(beyond, vec3f(0.0))) + inside);
        }
        default: { return 0.0; }
    }
}

// The least distances from the layers' traps, with one more point.
fn nearer_traps(traps: vec2f, z: vec3f) -> vec2f {
    return min(traps, vec2f(trap_distance(frame.first_layer, z), trap_distance(frame.second_layer, z)));
}
