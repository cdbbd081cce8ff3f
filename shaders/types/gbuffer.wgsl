// The G-buffer: a struct of arrays, one element a sample point. Host twin: `render::targets`.

// Depth along the pixel's ray in scene units; 0 where the ray met nothing.
@group(1) @binding(0) var<storage, read_write> depth: array<f32>;
// Unit normal, octahedral, two 16-bit signed normalised numbers.
@group(1) @binding(1) var<storage, read_write> normal: array<u32>;
// Smooth iterations / (iterations + 1) and origin trap / 2; axis trap / 2 and plane trap / 2.
@group(1) @binding(2) var<storage, read_write> color_data: array<vec2u>;
// One bit a light: set where the light reaches the point.
@group(1) @binding(3) var<storage, read_write> visibility: array<vec2u>;
