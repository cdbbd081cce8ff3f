//! The numbers of a path: scrambled points of Sobol's sequence (B. Burley, Practical Hash-based Owen Scrambling, JCGT
//! 9(4), 2020), in the same integer arithmetic as the shaders.

use glam::DVec2;

/// Number of the first pair of a path's first vertex.
const FIRST_PAIR: u32 = 0x100;
/// Pairs of a vertex.
const PAIRS: u32 = 5;

/// What a pair of numbers of a vertex is for.
#[derive(Clone, Copy, Debug)]
pub enum Purpose {
    /// The lobe, and whether the path goes on.
    Lobe,
    /// The direction within a lobe.
    Direction,
    /// The light of a shadow ray, and the light that the next ray sees.
    Light,
    /// The place on a light, or within a cell of the sky.
    Place,
    /// The cell of the sky.
    Cell,
}

/// The random numbers of one path.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    /// Column and row of the pixel.
    pub pixel: [u32; 2],
    /// Index of the path among those of its pixel.
    pub index: u32,
}

impl Numbers {
    /// A pair of a vertex, 0 to 1.
    pub fn pair(&self, bounce: u32, purpose: Purpose) -> DVec2 {
        let [x, y] = self.pixel;
        let number = FIRST_PAIR + PAIRS * bounce + purpose as u32;
        point(self.index, hash_two(x | y << 16, number))
    }
}

/// The finalizer of MurmurHash3.
fn hash(x: u32) -> u32 {
    let h = (x ^ x >> 16).wrapping_mul(0x85eb_ca6b);
    let h = (h ^ h >> 13).wrapping_mul(0xc2b2_ae35);
    h ^ h >> 16
}

fn hash_two(a: u32, b: u32) -> u32 {
    hash(a ^ hash(b).wrapping_add(0x9e37_79b9))
}

/// Owen's scrambling by the hash of S. Laine and T. Karras, with Burley's constants.
fn scrambled(x: u32, seed: u32) -> u32 {
    let start = x.reverse_bits().wrapping_add(seed);
    let factors = [0x6c50_b47c_u32, 0xb82f_1e52, 0xc7af_e638, 0x8d22_f6e6];
    factors.into_iter().fold(start, |y, factor| y ^ y.wrapping_mul(factor)).reverse_bits()
}

/// The second coordinate of Sobol's sequence: its generator matrix is Pascal's triangle modulo 2.
fn second(index: u32) -> u32 {
    let mut column = 1_u32 << 31;
    let mut sum = 0;
    for bit in 0..32 {
        if index >> bit & 1 == 1 {
            sum ^= column;
        }
        column ^= column >> 1;
    }
    sum
}

/// A point of the sequence of a seed.
pub fn point(index: u32, seed: u32) -> DVec2 {
    let shuffled = scrambled(index, seed);
    let part = |bits: u32| f64::from(bits >> 8) / f64::from(1 << 24);
    DVec2::new(
        part(scrambled(shuffled.reverse_bits(), hash_two(seed, 1))),
        part(scrambled(second(shuffled), hash_two(seed, 2))),
    )
}
