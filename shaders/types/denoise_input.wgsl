// What the input of the denoiser is made from, and where it goes.

// The noise of pixels: see `types/traced_paths`.
@group(1) @binding(0) var<storage, read> moments: array<f32>;
@group(1) @binding(1) var<storage, read_write> guides: array<vec2u>;
// Light over albedo, packed by `shared_exponent_pack`.
@group(1) @binding(2) var<storage, read_write> light: array<u32>;
