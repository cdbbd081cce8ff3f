// The G-buffer: a struct of arrays, one element a sample point. Host twin: `render::targets`.

// x: depth along the pixel's ray in the view's unit, the bits of an f32; 0 where the ray met nothing.
// y: unit normal, octahedral, two 16-bit signed normalised numbers.
@group(1) @binding(0) var<storage, read_write> surface: array<vec2u>;
// Smooth iterations / (iterations + 1) and origin trap / 2; axis trap / 2 and plane trap / 2.
@group(1) @binding(1) var<storage, read_write> color_data: array<vec2u>;
// One bit a light that casts shadows: set where the light reaches the point.
@group(1) @binding(2) var<storage, read_write> visibility: array<vec2u>;
