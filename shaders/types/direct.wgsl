// Light of the centre samples, packed by `shared_exponent_pack`: the source of indirect light, later the direct picture
// that fades out.
@group(2) @binding(3) var<storage, read_write> direct: array<u32>;
