// Unit vectors in 32 bits (Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014): maximum error about 0.003 degrees at 16 bits a component.

fn sign_not_zero(v: vec2f) -> vec2f {
    return select(vec2f(-1.0), vec2f(1.0), v >= vec2f(0.0));
}

// The unit vector's place in the octahedron's square, -1 to 1.
fn octahedral_fold(n: vec3f) -> vec2f {
    let flat = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return select(flat, (1.0 - abs(flat.yx)) * sign_not_zero(flat), n.z < 0.0);
}

fn octahedral_unfold(flat: vec2f) -> vec3f {
    let z = 1.0 - abs(flat.x) - abs(flat.y);
    let unfolded = select(flat, (1.0 - abs(flat.yx)) * sign_not_zero(flat), z < 0.0);
    return normalize(vec3f(unfolded, z));
}

fn octahedral_pack(n: vec3f) -> u32 {
    return pack2x16snorm(octahedral_fold(n));
}

fn octahedral_unpack(packed: u32) -> vec3f {
    return octahedral_unfold(unpack2x16snorm(packed));
}
