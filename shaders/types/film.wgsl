// The film: sums of linear radiance, in two halves so that each stays within a binding's limit.

// Red, green.
@group(2) @binding(0) var<storage, read_write> film_rg: array<vec2f>;
// Blue, number of samples.
@group(2) @binding(1) var<storage, read_write> film_bw: array<vec2f>;
