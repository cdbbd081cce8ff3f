// Light of the centre samples, packed by `shared_exponent_pack`: their direct light, as the source of indirect light; then
// the direct picture, which light paths replace.
@group(2) @binding(3) var<storage, read_write> direct: array<u32>;
