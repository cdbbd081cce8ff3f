//! The G-buffer decoded to plain numbers, for tests and tools.

use glam::{Vec2, Vec3};

/// The centre samples of a region, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Samples {
    /// Depth along each pixel's unit ray, in scene units; 0 on a miss.
    pub depth: Vec<f32>,
    /// Unit normals; undefined where the depth is 0.
    pub normal: Vec<Vec3>,
    /// One bit per light that casts shadows; the other bits are undefined.
    pub visibility: Vec<u64>,
}

impl Samples {
    /// Decodes the buffers that `shaders/types/gbuffer.wgsl` declares.
    ///
    /// Depths in the buffers are in units of `scale` scene units.
    pub fn decode(surface: &[u8], visibility: &[u8], scale: f64) -> Self {
        let scaled = |depth: f32| (f64::from(depth) * scale) as f32;
        let word = |bytes: [u8; 4]| u32::from_le_bytes(bytes);
        let surface = surface.as_chunks::<4>().0.as_chunks::<2>().0;
        Self {
            depth: surface.iter().map(|[depth, _]| scaled(f32::from_bits(word(*depth)))).collect(),
            normal: surface.iter().map(|[_, normal]| octahedral_unpack(word(*normal))).collect(),
            visibility: visibility
                .as_chunks::<8>()
                .0
                .iter()
                .map(|pair| u64::from_le_bytes(*pair))
                .collect(),
        }
    }
}

/// The inverse of `octahedral_pack` in `shaders/lib/octahedral.wgsl`.
fn octahedral_unpack(packed: u32) -> Vec3 {
    let part = |bits: u32| (f32::from(bits as u16 as i16) / 32767.0).max(-1.0);
    let flat = Vec2::new(part(packed), part(packed >> 16));
    let z = 1.0 - flat.x.abs() - flat.y.abs();
    let sign = |v: f32| if v < 0.0 { -1.0 } else { 1.0 };
    let folded = if z < 0.0 {
        Vec2::new((1.0 - flat.y.abs()) * sign(flat.x), (1.0 - flat.x.abs()) * sign(flat.y))
    } else {
        flat
    };
    folded.extend(z).normalize_or_zero()
}
