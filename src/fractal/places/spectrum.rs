//! Eigenvalues and singular values of 3×3 matrices.

use glam::DMat3;

/// Halvings that locate a real eigenvalue to an f64's precision.
const HALVINGS: u32 = 64;

/// The moduli of the eigenvalues of `matrix`, ascending; NaN if an entry is not finite.
pub fn eigenvalue_moduli(matrix: &DMat3) -> [f64; 3] {
    let scale = matrix.to_cols_array().into_iter().fold(0.0, |most: f64, it| most.max(it.abs()));
    if scale == 0.0 {
        return [0.0; 3];
    }
    let unit = *matrix * scale.recip();
    // The characteristic polynomial is x³ − trace x² + minors x − determinant.
    let [a, b, c] = [unit.x_axis, unit.y_axis, unit.z_axis];
    let trace = a.x + b.y + c.z;
    let minors = a.x * b.y - a.y * b.x + a.x * c.z - a.z * c.x + b.y * c.z - b.z * c.y;
    let determinant = unit.determinant();
    // Every eigenvalue is at most three times the largest entry.
    let (mut low, mut high) = (-4.0, 4.0);
    for _ in 0..HALVINGS {
        let middle: f64 = 0.5 * (low + high);
        let value = ((middle - trace) * middle + minors) * middle - determinant;
        *(if value < 0.0 { &mut low } else { &mut high }) = middle;
    }
    let real: f64 = 0.5 * (low + high);
    // The other two solve x² + sum x + product.
    let sum = real - trace;
    let product = minors + real * sum;
    let discriminant = 0.25 * sum * sum - product;
    let others = if discriminant < 0.0 {
        [product.max(0.0).sqrt(); 2]
    } else {
        let root = discriminant.sqrt();
        [(-0.5 * sum - root).abs(), (-0.5 * sum + root).abs()]
    };
    let mut moduli = [real.abs(), others[0], others[1]].map(|it| it * scale);
    moduli.sort_by(f64::total_cmp);
    moduli
}

/// The largest singular value of `matrix` over the smallest; infinite if that is zero.
pub fn condition(matrix: &DMat3) -> f64 {
    let [least, _, greatest] = eigenvalue_moduli(&(matrix.transpose() * *matrix));
    if least > 0.0 { (greatest / least).sqrt() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn diagonal(x: f64, y: f64, z: f64) -> DMat3 {
        DMat3::from_diagonal(DVec3::new(x, y, z))
    }

    fn assert_close(found: [f64; 3], expected: [f64; 3]) {
        let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs() / b).fold(0.0, f64::max);
        assert!(worst < 1e-6, "{found:?} instead of {expected:?}");
    }

    #[test]
    fn moduli_are_those_of_known_matrices() {
        assert_close(eigenvalue_moduli(&diagonal(-3.0, 0.5, 7e4)), [0.5, 3.0, 7e4]);
        // A turn by a radian that doubles lengths, and a third axis: a complex pair.
        let turn = DMat3::from_rotation_z(1.0) * diagonal(2.0, 2.0, 5.0);
        assert_close(eigenvalue_moduli(&turn), [2.0, 2.0, 5.0]);
        // The same in another basis.
        let basis = DMat3::from_cols(
            DVec3::new(1.0, 0.3, 0.0),
            DVec3::new(-0.2, 1.0, 0.4),
            DVec3::new(0.5, 0.1, 1.0),
        );
        assert_close(eigenvalue_moduli(&(basis * turn * basis.inverse())), [2.0, 2.0, 5.0]);
        assert_eq!(eigenvalue_moduli(&DMat3::ZERO), [0.0; 3]);
    }

    #[test]
    fn the_condition_of_a_rotated_stretch_is_the_stretch() {
        let turned = DMat3::from_rotation_x(0.7) * diagonal(6.0, 2.0, 1.5);
        assert!((condition(&turned) - 4.0).abs() < 1e-6);
        assert_eq!(condition(&DMat3::ZERO), f64::INFINITY);
    }
}
