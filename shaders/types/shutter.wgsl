// The sub-frames of motion blur so far, one element a pixel. Host twin: `render::uniforms::ShutterPixel`.

struct ShutterPixel {
    // Sum of the mean radiance of each sub-frame.
    light: vec3f,
    // Sum of the number of samples.
    samples: f32,
    // Mean guides of the denoiser, packed by `pack_guides`; of traced pictures alone, like what follows.
    guides: vec2u,
    // Sum of `moments`.
    moment: f32,
}

@group(1) @binding(0) var<storage, read_write> shutter: array<ShutterPixel>;
// See `types/traced_paths.wgsl`.
@group(1) @binding(1) var<storage, read_write> moments: array<f32>;
@group(1) @binding(2) var<storage, read_write> guides: array<vec2u>;
