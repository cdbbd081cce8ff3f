// Direct light of the centre samples, stored only as the source of indirect light. Packed by
// `shared_exponent_pack`.
@group(2) @binding(3) var<storage, read_write> direct: array<u32>;
