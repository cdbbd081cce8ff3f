// One iteration of the denoiser: an edge-avoiding a-trous wavelet filter (H. Dammertz et al., Edge-Avoiding A-Trous Wavelet
// Transform for fast Global Illumination Filtering, HPG 2010), with the pixel's own error as the width in light
// (C. Schied et al., Spatiotemporal Variance-Guided Filtering, HPG 2017). Each iteration doubles the distances.
// uses: lib/eye, lib/film_mean, lib/lattice, lib/luminance, lib/shared_exponent, lib/standard_error
// uses: types/dispatch_params, types/film, types/frame_uniforms, types/guides

@group(1) @binding(0) var<storage, read> guides: array<vec2u>;
// Of centre samples: x is the depth, as in `types/gbuffer`.
@group(1) @binding(1) var<storage, read> surface: array<vec2u>;
// Even iterations read the first and write the second, odd ones the other way. The last one is even.
@group(1) @binding(2) var<storage, read_write> even: array<u32>;
@group(1) @binding(3) var<storage, read_write> odd: array<u32>;

// Number of the last iteration; `LAST_ITERATION` in `render::pass::denoise`.
const LAST_ITERATION = 4u;

// Weights of a cubic B-spline by the distance in steps.
const SPLINE = array<f32, 3>(0.375, 0.25, 0.0625);

// Widths of the weights: difference of the light in standard errors, of normals, of albedo.
const LIGHT_WIDTH = 1.5;
const NORMAL_WIDTH = 0.2;
const ALBEDO_WIDTH = 0.15;
// Difference of the depth over that across a pixel of a surface that faces the eye.
const DEPTH_WIDTH = 4.0;

// Largest change of a pixel's light, in standard errors: so denoised light converges to the truth as the error falls.
const MAX_CHANGE = 2.0;
// The same for pixels with few rounds of samples.
const MAX_CHANGE_OF_FEW = 4.0;

fn light_at(index: u32) -> vec3f {
    if ((dispatch.iteration & 1u) == 0u) { return shared_exponent_unpack(even[index]); }
    return shared_exponent_unpack(odd[index]);
}

// What the filter compares of a pixel.
struct FilterPixel {
    light: vec3f,
    guides: Guides,
    // 0 in the background.
    depth: f32,
}

fn filter_pixel(index: u32) -> FilterPixel {
    // Depths are those of a surface, which paths in a medium do not see.
    let depth = select(0.0, bitcast<f32>(surface[index].x), frame.medium.kind == MEDIUM_NONE);
    return FilterPixel(light_at(index), unpack_guides(guides[index]), depth);
}

// How alike two pixels are, `distance` pixels apart, 0 to 1.
fn edge_weight(a: FilterPixel, b: FilterPixel, distance: f32) -> f32 {
    if ((a.depth > 0.0) != (b.depth > 0.0)) { return 0.0; }
    // The error falls with each iteration, as the light gets smooth.
    let error = (a.guides.error + 1e-3 * luminance(a.light)) * exp2(-f32(dispatch.iteration));
    let light = abs(luminance(a.light) - luminance(b.light)) / max(LIGHT_WIDTH * error, 1e-20);
    let normal = (a.guides.normal - b.guides.normal) / NORMAL_WIDTH;
    let albedo = (a.guides.albedo - b.guides.albedo) / ALBEDO_WIDTH;
    let pixel = 2.0 * frame.camera.half_height / f32(frame.picture_px.y);
    let depth = abs(a.depth - b.depth) / max(DEPTH_WIDTH * pixel * distance * min(a.depth, b.depth), 1e-20);
    return exp(-0.5 * light * light - 0.5 * dot(normal, normal) - 0.5 * dot(albedo, albedo) - depth);
}

fn filtered(pixel: vec2u) -> vec3f {
    let own = filter_pixel(pixel_index(pixel));
    let step = 1i << dispatch.iteration;
    var sum = vec3f(0.0);
    var total = 0.0;
    for (var y = -2i; y <= 2i; y++) {
        for (var x = -2i; x <= 2i; x++) {
            let at = vec2i(pixel) + step * vec2i(x, y);
            if (any(at < vec2i(0)) || any(at >= vec2i(frame.size_px))) { continue; }
            if (is_second_eye(vec2u(at)) != is_second_eye(pixel)) { continue; }
            var weight = SPLINE[abs(x)] * SPLINE[abs(y)];
            var light = own.light;
            if (x != 0i || y != 0i) {
                let other = filter_pixel(pixel_index(vec2u(at)));
                weight *= edge_weight(own, other, f32(step) * length(vec2f(vec2i(x, y))));
                light = other.light;
            }
            sum += weight * light;
            total += weight;
        }
    }
    return sum / total;
}

// The radiance of a pixel with this light over its albedo.
fn output_of(index: u32, light: vec3f) -> vec3f {
    let here = unpack_guides(guides[index]);
    let albedo = demodulator(here.albedo);
    let own = film_mean(index) / albedo;
    let off = light - own;
    // The errors of few samples are guesses.
    let most = select(MAX_CHANGE, MAX_CHANGE_OF_FEW, has_few_rounds(index));
    let part = min(most * here.error / max(luminance(abs(off)), 1e-20), 1.0);
    return albedo * (own + part * off);
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    read_frame();
    let pixel = pixel_of_rows(workgroup.xy, local_index);
    if (!inside_region(pixel)) { return; }
    let index = pixel_index(pixel);
    var light = filtered(pixel);
    if (dispatch.iteration == LAST_ITERATION) { light = output_of(index, light); }
    let packed = shared_exponent_pack(light);
    if ((dispatch.iteration & 1u) == 0u) { odd[index] = packed; } else { even[index] = packed; }
}
