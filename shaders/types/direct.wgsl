// Light that comes straight from its source, for the centre samples; only where indirect light is
// made of it. Packed by `shared_exponent_pack`.
@group(2) @binding(3) var<storage, read_write> direct: array<u32>;
