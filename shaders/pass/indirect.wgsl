// Indirect light from a sample's neighbours on the screen, added to its direct light (thesis
// 4.5, "Global Illumination"). Neighbours are centre samples, all of them or those of a lattice
// level; pixels outside the picture and background pixels contribute nothing. The operator works on the
// screen: it places the sample and its neighbours by their pixels and depths. (A binding of the rays would exceed
// the 8 storage buffers of a stage.)
// uses: lib/camera, lib/eye, lib/lattice, lib/noise, lib/octahedral, lib/put_on_film, lib/shading, lib/surface_color
// uses: lib/shared_exponent, types/direct, types/dispatch_params, types/frame_uniforms
// uses: types/indirect, types/ray, types/sample

struct Neighbour {
    // 0 without a neighbour, less than 1 if the neighbour is far in front or behind.
    weight: f32,
    // From the sample to the neighbour.
    offset: vec3f,
    normal: vec3f,
    // The neighbour's direct light.
    radiance: vec3f,
}

const NOBODY = Neighbour(0.0, vec3f(0.0), vec3f(0.0), vec3f(0.0));

// The pixel of the dispatch's lattice level nearest to a pixel of an eye's picture.
fn on_lattice(at: vec2i) -> vec2i {
    let shift = vec2u(dispatch.neighbour_level / 2u);
    let half_way = (vec2i(1) << shift) / 2;
    var cell = (at + half_way) >> shift;
    // Odd levels are chessboards.
    if ((dispatch.neighbour_level & 1u) != 0u && ((cell.x + cell.y) & 1) != 0) { cell.x ^= 1; }
    return cell << shift;
}

// The neighbour `aside` of a pixel's sample, in parts of the picture's height. `reach` is the operator's
// radius at the sample's own depth: a neighbour farther away belongs to another surface, and its weight
// falls to 0.
fn neighbour(site: Site, point: vec3f, aside: vec2f, reach: f32) -> Neighbour {
    let eye_px = frame.indirect.source_px;
    let middle = eye_position(site.pixel, place_in_pixel(site.sample)) * vec2f(eye_px);
    // Converts heights to pixels, which need not be square.
    let px = vec2f(f32(eye_px.x) / frame.camera.aspect, f32(eye_px.y));
    let at = on_lattice(vec2i(floor(middle + aside * px)));
    if (any(at < vec2i(0)) || any(at >= vec2i(eye_px))) { return NOBODY; }
    let film_px = vec2u(round(vec2f(eye_px) / frame.eyes.share));
    let corner = vec2u(round(eye_corner(site.pixel) * vec2f(film_px)));
    let index = (corner.y + u32(at.y)) * film_px.x + corner.x + u32(at.x);
    let seen = neighbour_surface[index];
    let t = bitcast<f32>(seen.x);
    if (t <= 0.0) { return NOBODY; }
    let ray = eye_ray((vec2f(at) + 0.5) / vec2f(eye_px), eye_side(site.pixel));
    let offset = ray.origin + t * ray.direction - point;
    let weight = saturate(2.0 - length(offset) / reach);
    return Neighbour(weight, offset, octahedral_unpack(seen.y), shared_exponent_unpack(direct[index]));
}

// Noise from 0 to 1, different for each sample of a pixel.
fn noise(site: Site, salt: f32) -> f32 {
    let place = vec2f(frame.origin_px + eye_pixel(site.pixel)) + salt;
    let shift = dot(place_in_pixel(site.sample), vec2f(1.0));
    return fract(interleaved(place) + shift);
}

// Eq. 4.1 over a square of half width `radius`: the mean of the neighbours' light, weighted by the
// cosine between the two normals, clamped at 0. If the square has more pixels than samples, the samples
// lie on a grid, one at a noisy position in each cell.
fn uniform_light(site: Site, point: vec3f, n: vec3f, reach: f32) -> vec3f {
    let count = i32(frame.indirect.samples);
    let stride = frame.indirect.radius / (f32(count) + 0.5);
    let place = vec2f(noise(site, 0.0), noise(site, 37.0)) - 0.5;
    var sum = vec3f(0.0);
    var total = 0.0;
    for (var y = -count; y <= count; y++) {
        for (var x = -count; x <= count; x++) {
            let other = neighbour(site, point, (vec2f(vec2i(x, y)) + place) * stride, reach);
            sum += other.weight * max(dot(n, other.normal), 0.0) * other.radiance;
            total += other.weight;
        }
    }
    return sum / max(total, 1e-6);
}

// Algorithm 2: along each direction on the screen, every neighbour above the horizon so far adds
// its light and the ambient factor, with less weight the higher it stands. As printed, the algorithm never
// resets the horizon between directions, and divides an empty sum by zero: here each direction
// starts with its own horizon, and a sample without neighbours gets the ambient light alone.
fn horizon_light(site: Site, point: vec3f, n: vec3f, reach: f32) -> vec3f {
    let ambient = vec3f(frame.indirect.ambient);
    let turn = noise(site, 0.0);
    let along = noise(site, 37.0);
    var sum = vec3f(0.0);
    var total = 0.0;
    for (var d = 0u; d < frame.indirect.directions; d++) {
        let angle = 6.2831853 * (f32(d) + turn) / f32(frame.indirect.directions);
        let direction = vec2f(cos(angle), sin(angle));
        var horizon = 0.0;
        for (var k = 0u; k < frame.indirect.samples; k++) {
            let part = (f32(k) + along) / f32(frame.indirect.samples);
            let other = neighbour(site, point, direction * (part * frame.indirect.radius), reach);
            let distance = length(other.offset);
            // Skips pixels so near that they may be the sample's own.
            if (other.weight <= 0.0 || distance < 0.02 * part * reach) { continue; }
            let height = saturate(dot(n, other.offset / distance));
            if (height < horizon) { continue; }
            horizon = height;
            sum += other.weight * (1.0 - height) * (ambient + other.radiance);
            total += other.weight;
        }
    }
    if (total <= 0.0) { return ambient; }
    return sum / total;
}

// All light that a sample reflects to the eye.
fn radiance_of(site: Site) -> vec3f {
    let seen = surface[site.index];
    let t = bitcast<f32>(seen.x);
    let ray = advanced(camera_ray(site), t);
    let radiance = direct_radiance(site, ray);
    if (t <= 0.0) { return radiance; }
    let point = ray.origin;
    let n = octahedral_unpack(seen.y);
    let reach = frame.indirect.radius * 2.0 * frame.camera.half_height * t;
    var arriving: vec3f;
    if (frame.indirect.kind == INDIRECT_UNIFORM) {
        arriving = uniform_light(site, point, n, reach);
    } else {
        arriving = horizon_light(site, point, n, reach);
    }
    let passed = fog_transmittance(point, -ray.direction, t);
    let color = surface_color(color_data[site.index], seen.y);
    return radiance + passed * frame.indirect.strength * color * arriving;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    let first = pixel_site(thread.x);
    if (!first.is_there) { return; }
    var sum = vec3f(0.0);
    var weight = 0.0;
    for (var i = 0u; i < dispatch.samples; i++) {
        let site = sample_site(first, i);
        sum += radiance_of(site);
        weight += opacity(site, camera_ray(site));
    }
    put_on_film(first.pixel, sum, weight);
}
