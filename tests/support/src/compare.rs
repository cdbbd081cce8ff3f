//! Two pictures, RGBA with eight bits a channel, compared.

/// Mean and largest difference of two pictures' colour channels, in steps of 1/255.
pub fn difference(a: &[u8], b: &[u8]) -> (f64, u8) {
    assert_eq!(a.len(), b.len(), "pictures of different sizes");
    let steps = || a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    let sum: u64 = steps().map(u64::from).sum();
    (sum as f64 / a.len() as f64 * 4.0 / 3.0, steps().max().unwrap_or(0))
}

/// Holds two pictures to be the same but for a few pixels: rays that graze the surface end a little
/// otherwise where a bundle of other rays went before them, and which rays these are depends on
/// how the lattice was filled.
pub fn assert_same(a: &[u8], b: &[u8], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}: pictures of different sizes");
    let pixels = a.len() / 4;
    let far = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 12);
    let different = a.chunks(4).zip(b.chunks(4)).filter(|pair| far(*pair)).count();
    let most = 3.max(pixels / 50);
    assert!(different <= most, "{what}: {different} of {pixels} pixels differ");
}
