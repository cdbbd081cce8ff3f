//! Colours of four bytes: nine bits per channel and a shared exponent.
//!
//! The format RGB9E5 is defined by WebGPU and Khronos' `EXT_texture_shared_exponent`. Its twin is
//! `shaders/lib/shared_exponent.wgsl`.

/// Bits of a channel, and the bias of the exponent.
const MANTISSA_BITS: i32 = 9;
const EXPONENT_BIAS: i32 = 15;

/// Packs three channels, each finite and from 0 to 65408: red lowest, the exponent highest.
pub fn pack(color: [f32; 3]) -> u32 {
    let largest = color.into_iter().fold(0.0, f32::max);
    // The smallest exponent with which the largest channel, rounded, fits its bits.
    let least = -EXPONENT_BIAS;
    let mut exponent = if largest > 0.0 { largest.log2().floor() as i32 + 1 } else { least };
    exponent = exponent.clamp(least, 31 - EXPONENT_BIAS);
    let rounded = |exponent: i32| {
        let scale = f64::from(MANTISSA_BITS - exponent).exp2();
        color.map(|channel| (f64::from(channel) * scale).round() as u32)
    };
    let mut mantissas = rounded(exponent);
    if mantissas.iter().any(|&mantissa| mantissa >= 1 << MANTISSA_BITS)
        && exponent < 31 - EXPONENT_BIAS
    {
        exponent += 1;
        mantissas = rounded(exponent);
    }
    let [r, g, b] = mantissas.map(|mantissa| mantissa.min((1 << MANTISSA_BITS) - 1));
    r | g << 9 | b << 18 | ((exponent + EXPONENT_BIAS) as u32) << 27
}

/// The channels of a packed colour, by the format's definition.
pub fn unpack(bits: u32) -> [f64; 3] {
    let scale = f64::from((bits >> 27) as i32 - EXPONENT_BIAS - MANTISSA_BITS).exp2();
    [0, 9, 18].map(|shift| f64::from(bits >> shift & 511) * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_colours_come_back_to_half_a_step_of_their_largest_channel() {
        let colours = [
            [0.0, 0.0, 0.0],
            [1.0, 0.5, 0.25],
            [0.999_9, 0.1, 0.0],
            [1e-4, 2e-5, 0.0],
            [65_408.0, 1.0, 300.0],
            [511.75, 511.75, 3.0],
            [3e-9, 0.0, 0.0],
            [0.7, 0.700_1, 123.456],
        ];
        for colour in colours {
            let back = unpack(pack(colour));
            let largest = f64::from(colour.into_iter().fold(0.0, f32::max));
            // Half a step of 9 bits, or of the smallest exponent.
            let step = (largest / 256.0).max((-24.0_f64).exp2());
            for (a, b) in colour.into_iter().zip(back) {
                assert!((f64::from(a) - b).abs() <= 0.501 * step, "{colour:?} {back:?}");
            }
        }
        assert_eq!(unpack(pack([65_408.0; 3])), [65_408.0; 3]);
        assert_eq!(unpack(pack([1.0; 3])), [1.0; 3]);
    }
}
