//! The formulas of `formulas/`, written once more in f64 from their published equations.

use std::f64::consts::PI;

use glam::{DVec2, DVec3, DVec4, Vec4Swizzles as _};
use mandelight::formula::Fractal;

use super::{
    folds::{
        box_folded, cube, folded, mirrored, number, sorted, sphere_factor, tetrahedral, triplex,
        turned, vec3, vector,
    },
    quaternion,
};

/// How an orbit's end gives a distance.
#[derive(Clone, Copy)]
pub enum Distance {
    /// ½ r ln r / dr.
    Log,
    /// (r − offset) / dr.
    Linear(f64),
    /// A function of state, derivative and point.
    Own(fn(&Fractal, DVec4, f64, DVec3) -> f64),
}

/// A formula's equations: one step from (z, c, dr, dc) to (z, dr).
#[derive(Clone, Copy)]
pub struct Equations {
    /// The step.
    pub step: fn(&Fractal, DVec4, DVec4, f64, f64) -> (DVec4, f64),
    /// Whether `step` gives dr.
    pub gives_derivative: bool,
    /// The size that is compared with the bailout.
    pub size: fn(DVec4) -> f64,
    /// The state at the start.
    pub start: fn(&Fractal, DVec3) -> DVec4,
    /// The estimate.
    pub distance: Distance,
    /// Components of the state: 3 or 4.
    pub components: usize,
}

/// The Mandelbulb's |z| and derivative for an n-th power.
fn power_derivative(z: DVec3, n: f64, dr: f64, dc: f64) -> f64 {
    n * z.length().powf(n - 1.0) * dr + dc
}

/// Equations without a step.
pub fn usual() -> Equations {
    Equations {
        step: |_, z, _, dr, _| (z, dr),
        gives_derivative: true,
        size: |z| z.length(),
        start: |_, p| p.extend(0.0),
        distance: Distance::Log,
        components: 3,
    }
}

/// Four-dimensional sets begin at the point in the slice.
fn in_slice(fractal: &Fractal, p: DVec3) -> DVec4 {
    p.extend(number(fractal, "slice"))
}

/// The equations of the formula called `id`, if it is of `formulas/` itself.
pub fn equations(id: &str) -> Option<Equations> {
    let found = match id {
        "quaternion_julia" => Equations {
            components: 4,
            start: in_slice,
            step: |f, z, _, dr, _| {
                let c = DVec4::from_slice(&vector(f, "constant"));
                (quaternion::product(z, z) + c, 2.0 * z.length() * dr)
            },
            ..usual()
        },
        "quaternion_mandelbrot" => Equations {
            components: 4,
            start: in_slice,
            step: |_, z, c, dr, dc| (quaternion::product(z, z) + c, 2.0 * z.length() * dr + dc),
            ..usual()
        },
        "bicomplex_mandelbrot" => Equations {
            components: 4,
            start: in_slice,
            // (a + j b)² with complex a, b and j² = −1; the derivative's norm is that of the idempotent parts.
            step: |_, z, c, dr, dc| {
                let (a, b) = (z.xy(), z.zw());
                let square = |v: DVec2| DVec2::new(v.x * v.x - v.y * v.y, 2.0 * v.x * v.y);
                let product = DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
                let (real, jay) = (square(a) - square(b), 2.0 * product);
                let i_b = DVec2::new(-b.y, b.x);
                let widest = (a - i_b).length().max((a + i_b).length());
                (DVec4::new(real.x, real.y, jay.x, jay.y) + c, 2.0 * widest * dr + dc)
            },
            ..usual()
        },
        "mandelbulb_cosine" => Equations {
            step: |f, z, c, dr, dc| {
                let (z, n) = (z.xyz(), number(f, "power"));
                let r = z.length();
                let (theta, phi) = (n * (z.z / r).acos(), n * z.y.atan2(z.x));
                let direction =
                    DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
                ((r.powf(n) * direction).extend(0.0) + c, power_derivative(z, n, dr, dc))
            },
            ..usual()
        },
        "mandelbulb" => Equations {
            step: |f, z, c, dr, dc| {
                let n = number(f, "power");
                let mut next = triplex(z.xyz(), n);
                if f.is_on("negative_sine") {
                    next.z = -next.z;
                }
                (next.extend(0.0) + c, power_derivative(z.xyz(), n, dr, dc))
            },
            ..usual()
        },
        "juliabulb" => Equations {
            step: |f, z, _, dr, _| {
                let n = number(f, "power");
                let next = triplex(z.xyz(), n) + vec3(f, "addend");
                (next.extend(0.0), power_derivative(z.xyz(), n, dr, 0.0))
            },
            ..usual()
        },
        "burning_ship_bulb" => Equations {
            gives_derivative: false,
            step: |f, z, c, dr, _| {
                let magnitude = |name: &str, x: f64| if f.is_on(name) { x.abs() } else { x };
                let z = DVec3::new(
                    magnitude("folds_x", z.x),
                    magnitude("folds_y", z.y),
                    magnitude("folds_z", z.z),
                );
                (triplex(z, number(f, "power")).extend(0.0) + c, dr)
            },
            ..usual()
        },
        "mandelbox" => Equations {
            step: |f, z, c, dr, dc| {
                let scale = number(f, "scale");
                let z = box_folded(z.xyz(), DVec3::splat(number(f, "fold_limit")));
                let k = sphere_factor(z, number(f, "inner_radius"), number(f, "outer_radius"));
                ((scale * k * z).extend(0.0) + c, scale.abs() * k * dr + dc)
            },
            distance: Distance::Linear(0.0),
            ..usual()
        },
        "amazing_box_mod" => Equations {
            step: |f, z, c, dr, dc| {
                let scale = number(f, "scale");
                let z = box_folded(z.xyz(), vec3(f, "fold_limits"));
                let k = sphere_factor(z, number(f, "inner_radius"), 1.0);
                (turned(f, scale * k * z).extend(0.0) + c, scale.abs() * k * dr + dc)
            },
            distance: Distance::Linear(0.0),
            ..usual()
        },
        "amazing_surf" => Equations {
            step: |f, z, c, dr, dc| {
                let (scale, limit) = (number(f, "scale"), number(f, "fold_limit"));
                let z = DVec3::new(folded(z.x, limit), folded(z.y, limit), z.z);
                let k = sphere_factor(z, number(f, "inner_radius"), 1.0);
                let next = turned(f, scale * k * z + c.xyz());
                (next.extend(0.0), scale.abs() * k * dr + dc)
            },
            distance: Distance::Linear(0.0),
            ..usual()
        },
        "box_fold_bulb" => Equations {
            gives_derivative: false,
            step: |f, z, c, dr, _| {
                let z = box_folded(z.xyz(), DVec3::splat(number(f, "fold_limit")));
                let z = sphere_factor(z, number(f, "inner_radius"), 1.0) * z;
                let height = DVec3::new(1.0, 1.0, number(f, "height"));
                ((triplex(z, 2.0) * height).extend(0.0) + c, dr)
            },
            ..usual()
        },
        "menger_sponge" => Equations {
            step: |f, z, _, dr, _| {
                let scale = number(f, "scale");
                let mut z = scale * sorted(turned(f, z.xyz()).abs());
                z.x -= scale - 1.0;
                z.y -= scale - 1.0;
                if z.z > 0.5 * (scale - 1.0) {
                    z.z -= scale - 1.0;
                }
                (z.extend(0.0), scale * dr)
            },
            distance: Distance::Own(|_, z, dr, _| cube(z.xyz()) / dr),
            ..usual()
        },
        "koch_cube" => Equations {
            components: 4,
            start: |_, p| p.extend(10.0),
            step: |f, z, _, dr, _| {
                let scale = number(f, "scale");
                let nearest = z.w.min(cube(z.xyz()) / dr);
                let z = z.xyz().abs();
                // Largest first; of the others, z stays last.
                let (x, y) = (z.x.max(z.y), z.x.min(z.y));
                let (x, w) = (x.max(z.z), x.min(z.z));
                let z = turned(f, scale * (DVec3::new(x, y, w) - DVec3::X * (1.0 + 1.0 / scale)));
                (z.extend(nearest), scale * dr)
            },
            size: |z| z.xyz().length(),
            distance: Distance::Own(|_, z, _, _| z.w),
            ..usual()
        },
        "sierpinski_tetrahedron" => Equations {
            step: |f, z, _, dr, _| {
                let scale = number(f, "scale");
                let z = tetrahedral(turned(f, z.xyz()));
                ((scale * z - (scale - 1.0)).extend(0.0), scale * dr)
            },
            distance: Distance::Own(|_, z, dr, _| {
                let faces = [
                    DVec3::new(-1.0, -1.0, -1.0),
                    DVec3::new(1.0, 1.0, -1.0),
                    DVec3::new(-1.0, 1.0, 1.0),
                    DVec3::new(1.0, -1.0, 1.0),
                ];
                let highest = faces.map(|n| n.dot(z.xyz())).into_iter().fold(f64::MIN, f64::max);
                (highest - 1.0) / (3.0_f64.sqrt() * dr)
            }),
            ..usual()
        },
        "kaleidoscopic_tetrahedron" => Equations {
            step: |f, z, _, dr, _| shrunk(f, tetrahedral(turned(f, z.xyz())), dr),
            distance: Distance::Linear(1.5),
            ..usual()
        },
        "kaleidoscopic_octahedron" => Equations {
            step: |f, z, _, dr, _| {
                let mut z = turned(f, z.xyz());
                for normal in [(1.0, -1.0, 0.0), (1.0, 1.0, 0.0), (1.0, 0.0, -1.0), (1.0, 0.0, 1.0)]
                {
                    z = mirrored(z, DVec3::from(normal).normalize());
                }
                shrunk(f, z, dr)
            },
            distance: Distance::Linear(1.0),
            ..usual()
        },
        "kaleidoscopic_icosahedron" => Equations {
            step: |f, z, _, dr, _| {
                let cosine = (PI / 5.0).cos();
                let normal = DVec3::new(-0.5, -cosine, (0.75 - cosine * cosine).sqrt());
                let mut z = turned(f, z.xyz());
                for _ in 0..4 {
                    z = mirrored(DVec3::new(z.x.abs(), z.y.abs(), z.z), normal);
                }
                shrunk(f, DVec3::new(z.x.abs(), z.y.abs(), z.z), dr)
            },
            distance: Distance::Linear(1.0),
            ..usual()
        },
        "pseudo_kleinian" => Equations {
            step: |f, z, _, dr, _| {
                let z = box_folded(z.xyz(), vec3(f, "box_size"));
                let k = (number(f, "inversion") / z.length_squared()).max(1.0);
                ((k * z + vec3(f, "shift")).extend(0.0), k * dr)
            },
            distance: Distance::Own(|f, z, dr, _| {
                let thickness = number(f, "thickness");
                let pattern = (z.xy().length() * z.z).abs() - thickness;
                0.5 * pattern / ((z.length_squared() + thickness).sqrt() * dr)
            }),
            ..usual()
        },
        "kleinian" => Equations {
            start: |f, p| DVec4::new(p.x, p.z + 0.5 * number(f, "real"), p.y, 0.0),
            step: |f, z, _, dr, _| {
                let (a, b) = (number(f, "real"), number(f, "imaginary"));
                let wrap = |x: f64| (x + 1.0).rem_euclid(2.0) - 1.0;
                let mut z = DVec3::new(wrap(z.x + b / a * z.y) - b / a * z.y, z.y, wrap(z.z));
                let off = z.x + 0.5 * b;
                let side = if b < 0.0 { -0.45 } else { 0.45 };
                let bend = side * off.signum() * (1.0 - (-7.2 * off.abs()).exp());
                if z.y >= a * (0.5 + 0.25 * bend) {
                    z = DVec3::new(-b, a, 0.0) - z;
                }
                let inverse = 1.0 / z.length_squared();
                let inverted = -inverse * z;
                let next = DVec3::new(-b - inverted.x, a + inverted.y, inverted.z);
                (next.extend(0.0), inverse * dr)
            },
            size: |_| 0.0,
            distance: Distance::Own(|f, z, dr, p| {
                let a = number(f, "real");
                (z.y.min(a - z.y) / dr.max(2.0)).max(p.z.abs() - 0.5 * a)
            }),
            ..usual()
        },
        "apollonian" => Equations {
            step: |f, z, _, dr, _| {
                let z = (0.5 * z.xyz() + 0.5).map(|x| 2.0 * x.rem_euclid(1.0) - 1.0);
                let k = number(f, "inversion") / z.length_squared();
                ((k * z).extend(0.0), k * dr)
            },
            size: |_| 0.0,
            distance: Distance::Own(|_, z, dr, _| 0.25 * z.y.abs() / dr),
            ..usual()
        },
        "bristorbrot" => Equations {
            gives_derivative: false,
            step: |_, z, c, dr, _| {
                let [x, y, w, _] = z.to_array();
                let next =
                    DVec3::new(x * x - y * y - w * w, 2.0 * x * y - y * w, 2.0 * x * w + y * w);
                (next.extend(0.0) + c, dr)
            },
            ..usual()
        },
        "benesi_pine_tree" => Equations {
            gives_derivative: false,
            step: |f, z, c, dr, _| {
                // A complex square of x and the distance from the x axis, at twice the angle about it; then y and z
                // change places.
                let (x, rho) = (z.x, z.y.hypot(z.z));
                let angle = 2.0 * z.z.atan2(z.y);
                let across = number(f, "lift") * 2.0 * x * rho;
                let next =
                    DVec3::new(x * x - rho * rho, across * angle.sin(), across * angle.cos());
                (next.extend(0.0) + DVec4::new(c.x, c.z, c.y, c.w), dr)
            },
            ..usual()
        },
        "aexion" => Equations {
            components: 4,
            gives_derivative: false,
            start: |_, p| {
                DVec4::new(p.x + p.y + p.z, -p.x - p.y + p.z, -p.x + p.y - p.z, p.x - p.y - p.z)
                    .abs()
            },
            step: |_, z, c, dr, _| {
                let (xy, zw) = (2.0 * z.x * z.y, 2.0 * z.z * z.w);
                let (left, right) = (z.x * z.x - z.y * z.y, z.z * z.z - z.w * z.w);
                (DVec4::new(left + zw, zw - left, right + xy, xy - right) + c, dr)
            },
            ..usual()
        },
        "riemann_sphere" => Equations {
            gives_derivative: false,
            step: |f, z, c, dr, _| {
                let (z, n) = (z.xyz(), number(f, "power"));
                let r = z.length();
                // Stereographic projection from the pole, a complex power, and back.
                let s = DVec2::new(z.x, z.y) / (r - z.z);
                let (size, angle) = (s.length().powf(n), n * s.y.atan2(s.x));
                let below = size * size + 1.0;
                let direction = DVec3::new(
                    2.0 * size * angle.cos() / below,
                    2.0 * size * angle.sin() / below,
                    (size * size - 1.0) / below,
                );
                ((r.powf(n) * direction).extend(0.0) + c, dr)
            },
            ..usual()
        },
        "newton" => Equations {
            gives_derivative: false,
            step: |f, z, _, dr, _| {
                // z − k (z³ − 1) / (3 z²), where z³ / z² is z.
                let (z, k) = (z.xyz(), number(f, "relaxation"));
                ((z - k * (z - triplex(z, -2.0)) / 3.0).extend(0.0), dr)
            },
            size: |z| 1.0 / (triplex(z.xyz(), 3.0) - DVec3::X).length().max(1e-6),
            ..usual()
        },
        "coastalbrot" => Equations {
            gives_derivative: false,
            step: |f, z, c, dr, _| {
                let z = z.xyz();
                let sines = (PI / 3.0 + PI * z).map(|x| x.sin().sin().sin());
                ((z.length().powf(number(f, "power")) * sines).extend(0.0) + c, dr)
            },
            ..usual()
        },
        _ => return None,
    };
    Some(found)
}

/// Scaled about the offset.
fn shrunk(fractal: &Fractal, z: DVec3, dr: f64) -> (DVec4, f64) {
    let (scale, offset) = (number(fractal, "scale"), vec3(fractal, "offset"));
    ((scale * z - (scale - 1.0) * offset).extend(0.0), scale * dr)
}
