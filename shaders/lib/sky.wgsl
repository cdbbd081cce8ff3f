// The sky: light from all directions, of an environment map or a gradient. A table selects directions by their
// energy (alias method: M. Vose, IEEE Trans. Software Engineering 17(9), 1991).
// uses: lib/environment_map, types/frame_uniforms

// A cell of the sky, as in the environment map: x the cell to take instead, y the bits of the part of the cell that
// stays, z the bits of the cell's probability over its solid angle.
@group(3) @binding(2) var sky_table: texture_2d<u32>;

const TAU = 6.2831853;

// A sampled direction.
struct SkySample {
    // Unit vector in world space.
    direction: vec3f,
    // Probability density over solid angle.
    density: f32,
}

fn has_sky() -> bool {
    return frame.paths.sky_gain > 0.0;
}

// A unit direction of world space in the sky's own frame.
fn in_sky(direction: vec3f) -> vec3f {
    let paths = frame.paths;
    return vec3f(dot(direction, paths.sky_x), dot(direction, paths.sky_y), dot(direction, paths.sky_z));
}

// Radiance from a unit direction.
fn sky_radiance(direction: vec3f) -> vec3f {
    return frame.paths.sky_gain * environment_at(in_sky(direction));
}

// Probability density with which `sky_sample` selects a direction.
fn sky_density(direction: vec3f) -> f32 {
    let size = textureDimensions(sky_table);
    let d = in_sky(direction);
    let azimuth = select(0.0, atan2(d.x, d.y), length(d.xy) > 1e-7);
    let column = u32(fract(azimuth / TAU + 0.5) * f32(size.x));
    let row = u32(max(0.5 - 0.5 * d.z, 0.0) * f32(size.y));
    return bitcast<f32>(textureLoad(sky_table, min(vec2u(column, row), size - 1u), 0).z);
}

// A direction: a cell by its energy, and a place in it, evenly by solid angle.
fn sky_sample(cell: vec2f, place: vec2f) -> SkySample {
    let size = textureDimensions(sky_table);
    let count = size.x * size.y;
    var index = min(u32(cell.x * f32(count)), count - 1u);
    var entry = textureLoad(sky_table, vec2u(index % size.x, index / size.x), 0);
    if (cell.y >= bitcast<f32>(entry.y)) {
        index = entry.x;
        entry = textureLoad(sky_table, vec2u(index % size.x, index / size.x), 0);
    }
    let at = (vec2f(vec2u(index % size.x, index / size.x)) + place) / vec2f(size);
    let z = 1.0 - 2.0 * at.y;
    let sin_theta = sqrt(max(1.0 - z * z, 0.0));
    let azimuth = TAU * (at.x - 0.5);
    let d = vec3f(sin_theta * sin(azimuth), sin_theta * cos(azimuth), z);
    let paths = frame.paths;
    return SkySample(d.x * paths.sky_x + d.y * paths.sky_y + d.z * paths.sky_z, bitcast<f32>(entry.z));
}
