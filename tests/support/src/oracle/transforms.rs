//! The transforms of `formulas/steps/`, written once more in f64.

use glam::{DVec3, DVec4, Vec4Swizzles as _};
use mandelight::formula::Fractal;

use super::{
    folds::{box_folded, number, sphere_factor, turned, vec3},
    formulas::{Distance, Equations, usual},
};

/// The equations of the transform called `id`.
pub fn equations(id: &str) -> Option<Equations> {
    let step: fn(&Fractal, DVec4, DVec4, f64, f64) -> (DVec4, f64) = match id {
        "rotate" => |f, z, _, dr, _| (turned(f, z.xyz()).extend(0.0), dr),
        "scale" => |f, z, _, dr, _| {
            let factor = number(f, "factor");
            ((factor * z.xyz()).extend(0.0), factor.abs() * dr)
        },
        "translate" => |f, z, _, dr, _| ((z.xyz() + vec3(f, "shift")).extend(0.0), dr),
        "box_fold" => |f, z, _, dr, _| (box_folded(z.xyz(), vec3(f, "limit")).extend(0.0), dr),
        "sphere_fold" => |f, z, _, dr, _| {
            let k = sphere_factor(z.xyz(), number(f, "inner_radius"), number(f, "outer_radius"));
            ((k * z.xyz()).extend(0.0), k * dr)
        },
        "mirror" => |f, z, _, dr, _| {
            let mut z = z.xyz().to_array();
            for (x, name) in z.iter_mut().zip(["mirror_x", "mirror_y", "mirror_z"]) {
                *x = if f.is_on(name) { x.abs() } else { *x };
            }
            if f.is_on("diagonals") {
                z.sort_by(|a, b| b.total_cmp(a));
            }
            (DVec3::from_array(z).extend(0.0), dr)
        },
        "twist" => |f, z, _, dr, _| {
            let rate = number(f, "twist").to_radians();
            let (sine, cosine) = (rate * z.z).sin_cos();
            let next = DVec3::new(cosine * z.x - sine * z.y, sine * z.x + cosine * z.y, z.z);
            // The larger singular value of the shear ((1, s), (0, 1)).
            let shear = rate.abs() * z.xy().length();
            let squared = 1.0 + 0.5 * shear * shear + shear * (1.0 + 0.25 * shear * shear).sqrt();
            (next.extend(0.0), squared.sqrt() * dr)
        },
        "polar_repeat" => |f, z, _, dr, _| {
            let sector = std::f64::consts::TAU / number(f, "count");
            let angle = z.y.atan2(z.x);
            let (sine, cosine) = (angle - sector * (angle / sector).round()).sin_cos();
            let r = z.xy().length();
            (DVec4::new(r * cosine, r * sine, z.z, 0.0), dr)
        },
        _ => return None,
    };
    Some(Equations { step, distance: Distance::Linear(0.0), ..usual() })
}
