// Where a jittered sample's ray passes the lens (thin lens: R. Cook et al., Distributed Ray Tracing, SIGGRAPH 1984).
// uses: lib/jittered, lib/lattice, types/frame_uniforms, types/ray

// The seed of the lens's random numbers: no light has it.
const LENS_SEED = 0x1e45u;

// Whether the samples of the dispatch see through a lens; centre samples see through its middle.
fn sees_through_lens() -> bool {
    return frame.camera.lens_radius > 0.0 && is_jittered();
}

// A point of the aperture, evenly spread: of the unit disc, or of a regular polygon in it.
fn aperture_point(at: vec2f) -> vec2f {
    let blades = f32(frame.camera.blades);
    if (frame.camera.blades < 3u) {
        let turn = 6.2831853 * (at.y - 0.5);
        return sqrt(at.x) * vec2f(cos(turn), sin(turn));
    }
    // One of the triangles from the middle to an edge, and a point in it.
    let blade = min(floor(at.y * blades), blades - 1.0);
    let along = at.y * blades - blade;
    // From -pi to pi, where WGSL's functions are exact.
    let corners = 6.2831853 * (vec2f(blade, blade + 1.0) / blades - 0.5);
    let first = vec2f(cos(corners.x), sin(corners.x));
    let second = vec2f(cos(corners.y), sin(corners.y));
    return sqrt(at.x) * mix(first, second, along);
}

// The ray of a sample through a point of the lens; it meets the pinhole's ray at the focus.
fn through_lens(ray: Ray, site: Site) -> Ray {
    if (!sees_through_lens()) { return ray; }
    let at = frame.camera.lens_radius * aperture_point(random_pair(site, LENS_SEED));
    let aside = at.x * frame.camera.right + at.y * frame.camera.up;
    let reach = frame.camera.focus / max(dot(ray.direction, frame.camera.forward), 1e-6);
    return Ray(ray.origin + aside, ray.radius, normalize(reach * ray.direction - aside), ray.spread);
}
