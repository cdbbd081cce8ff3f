// Points of a sample sequence that fill the unit square evenly: two dimensions of Sobol's sequence, shuffled and
// scrambled by hashes (B. Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020). Every seed gives another
// sequence; the first 2^k points of each lie in different cells of every grid of 2^k equal cells.

// A hash of one number (finalizer of MurmurHash3).
fn hash(x: u32) -> u32 {
    var h = x;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

fn hash_pair(a: u32, b: u32) -> u32 {
    return hash(a ^ (hash(b) + 0x9e3779b9u));
}

// Owen's nested scrambling of a number's bits, from the highest down (Burley 2020, listing 3).
fn scrambled(x: u32, seed: u32) -> u32 {
    var y = reverseBits(x) + seed;
    y ^= y * 0x6c50b47cu;
    y ^= y * 0xb82f1e52u;
    y ^= y * 0xc7afe638u;
    y ^= y * 0x8d22f6e6u;
    return reverseBits(y);
}

// The second dimension of Sobol's sequence: the first is the index with its bits reversed.
fn sobol_second(index: u32) -> u32 {
    var column = 0x80000000u;
    var sum = 0u;
    for (var rest = index; rest != 0u; rest >>= 1u) {
        sum ^= select(0u, column, (rest & 1u) != 0u);
        column ^= column >> 1u;
    }
    return sum;
}

// A number of 32 bits as a fraction below 1.
fn fraction(bits: u32) -> f32 {
    return f32(bits >> 8u) / 16777216.0;
}

// The point with the number `index` of a sequence, 0 to 1.
fn sobol_point(index: u32, seed: u32) -> vec2f {
    let shuffled = scrambled(index, seed);
    return vec2f(
        fraction(scrambled(reverseBits(shuffled), hash_pair(seed, 1u))),
        fraction(scrambled(sobol_second(shuffled), hash_pair(seed, 2u))));
}
