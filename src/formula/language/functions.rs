//! The functions that a formula's text can call.
//!
//! Each has its signature, a sentence of help and an example; `docs/formulas.md` lists them, and a test
//! compiles every example.

use super::graph::{Binary, Graph, NodeId, Unary};

/// What a function takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// A number.
    Float,
    /// A vec2.
    Vec2,
    /// A vec3.
    Vec3,
    /// A vec4.
    Vec4,
    /// A vector of any size.
    Vector,
    /// A number or vector: all such arguments have one size, and numbers stand for each component.
    Any,
    /// A condition.
    Condition,
    /// One or more numbers and vectors with this many components in all, or one number for all components.
    Parts(usize),
}

impl Argument {
    /// The argument in words.
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Float => "a float",
            Self::Vec2 => "a vec2",
            Self::Vec3 => "a vec3",
            Self::Vec4 => "a vec4",
            Self::Vector => "a vector",
            Self::Any => "a float or a vector",
            Self::Condition => "a condition",
            Self::Parts(_) => "floats and vectors",
        }
    }

    /// The number of components that the argument must have; none if several are accepted.
    pub const fn size(self) -> Option<usize> {
        match self {
            Self::Float | Self::Condition => Some(1),
            Self::Vec2 => Some(2),
            Self::Vec3 => Some(3),
            Self::Vec4 => Some(4),
            Self::Vector | Self::Any | Self::Parts(_) => None,
        }
    }
}

/// Adds a function's operations to a graph. The arguments are checked; those of kind
/// [`Argument::Any`] have one size.
type Lower = fn(&mut Graph, &[Vec<NodeId>]) -> Vec<NodeId>;

/// A function of the language.
pub struct Function {
    /// The function's name.
    pub name: &'static str,
    /// The arguments' names, as the docs show them.
    pub arguments: &'static [(&'static str, Argument)],
    /// What the function computes.
    pub help: &'static str,
    /// A call.
    pub example: &'static str,
    /// Adds the function's operations.
    pub lower: Lower,
}

/// The function called `name`.
pub fn find(name: &str) -> Option<&'static Function> {
    FUNCTIONS.iter().find(|function| function.name == name)
}

/// Declares the functions.
macro_rules! functions {
    ($($name:ident($($argument:ident: $kind:expr),*) $help:literal, $example:literal, $lower:expr;)*) => {
        /// Every function, in the order of the docs.
        pub const FUNCTIONS: &[Function] = &[$(
            Function {
                name: stringify!($name),
                arguments: &[$((stringify!($argument), $kind)),*],
                help: $help,
                example: $example,
                lower: $lower,
            }
        ),*];
    };
}

use Argument::{Any, Condition, Float, Parts, Vec2, Vec3, Vec4, Vector};

functions! {
    vec2(parts: Parts(2)) "A vec2 of two numbers, or of one for both.", "vec2(z.x, 1.0)", |_, a| spread(a, 2);
    vec3(parts: Parts(3)) "A vec3 of numbers and vectors, or of one number.", "vec3(z.xy, 0.0)", |_, a| spread(a, 3);
    vec4(parts: Parts(4)) "A vec4 of numbers and vectors, or of one number.", "vec4(z, 0.0)", |_, a| spread(a, 4);
    select(condition: Condition, yes: Any, no: Any) "`yes` where the condition holds, else `no`.", "select(z.x < 0.0, -z, z)",
        |g, a| each2(g, &a[1], &a[2], |g, yes, no| g.select(a[0][0], yes, no));
    abs(x: Any) "The magnitude of each component.", "abs(z)", |g, a| each(g, a, |g, x| g.unary(Unary::Abs, x));
    sign(x: Any) "−1, 0 or 1 as each component is negative, zero or positive.", "sign(z)", |g, a| each(g, a, |g, x| g.unary(Unary::Sign, x));
    floor(x: Any) "The largest whole number not above x.", "floor(z.x)", |g, a| each(g, a, |g, x| g.unary(Unary::Floor, x));
    round(x: Any) "The nearest whole number.", "round(z.x)", |g, a| each(g, a, rounded);
    fract(x: Any) "x − floor(x).", "fract(z)", |g, a| each(g, a, |g, x| { let below = g.unary(Unary::Floor, x); g.minus(x, below) });
    modulo(x: Any, y: Any) "x − y · floor(x / y).", "modulo(z, 2.0)", |g, a| each2(g, &a[0], &a[1], modulo);
    min(x: Any, y: Any) "The smaller of two.", "min(z, 1.0)", |g, a| each2(g, &a[0], &a[1], |g, x, y| g.binary(Binary::Min, x, y));
    max(x: Any, y: Any) "The larger of two.", "max(z.x, z.y)", |g, a| each2(g, &a[0], &a[1], |g, x, y| g.binary(Binary::Max, x, y));
    clamp(x: Any, low: Any, high: Any) "x, but at least `low` and at most `high`.", "clamp(z, -1.0, 1.0)",
        |g, a| { let low = each2(g, &a[0], &a[1], |g, x, y| g.binary(Binary::Max, x, y)); each2(g, &low, &a[2], |g, x, y| g.binary(Binary::Min, x, y)) };
    mix(x: Any, y: Any, part: Any) "From x for part 0 to y for part 1.", "mix(z, c, 0.25)",
        |g, a| { let way = each2(g, &a[1], &a[0], Graph::minus); let way = each2(g, &way, &a[2], Graph::times); each2(g, &a[0], &way, Graph::plus) };
    sqrt(x: Any) "The square root; of a negative number 0.", "sqrt(z.x)", |g, a| each(g, a, |g, x| g.unary(Unary::Sqrt, x));
    exp(x: Any) "e to the power of x.", "exp(-z.x)", |g, a| each(g, a, |g, x| g.unary(Unary::Exp, x));
    log(x: Any) "The natural logarithm; an x below 1.2e-38 counts as 1.2e-38.", "log(length(z))", |g, a| each(g, a, |g, x| g.unary(Unary::Log, x));
    pow(x: Any, y: Any) "x to the power of y. A negative x counts as 1.2e-38, unless y is a constant whole number of at most 16.", "pow(length(z), 2.5)",
        |g, a| each2(g, &a[0], &a[1], |g, x, y| g.binary(Binary::Power, x, y));
    radians(x: Any) "An angle in radians, from degrees.", "radians(45.0)", |g, a| each(g, a, |g, x| { let one = g.constant(std::f64::consts::PI / 180.0); g.times(x, one) });
    sin(x: Any) "The sine of radians.", "sin(z.x)", |g, a| each(g, a, |g, x| g.unary(Unary::Sin, x));
    cos(x: Any) "The cosine of radians.", "cos(z.x)", |g, a| each(g, a, |g, x| g.unary(Unary::Cos, x));
    tan(x: Any) "The tangent of radians.", "tan(0.5 * z.x)", |g, a| each(g, a, |g, x| { let (s, c) = (g.unary(Unary::Sin, x), g.unary(Unary::Cos, x)); g.over(s, c) });
    asin(x: Any) "The angle in radians with the sine x.", "asin(z.x)", |g, a| each(g, a, |g, x| { let c = cosine_of_sine(g, x); g.binary(Binary::Atan2, x, c) });
    acos(x: Any) "The angle in radians with the cosine x.", "acos(z.x)", |g, a| each(g, a, |g, x| { let s = cosine_of_sine(g, x); g.binary(Binary::Atan2, s, x) });
    atan(x: Any) "The angle in radians with the tangent x.", "atan(z.x)", |g, a| each(g, a, |g, x| { let one = g.constant(1.0); g.binary(Binary::Atan2, x, one) });
    atan2(y: Any, x: Any) "The angle of the point (x, y) in radians, −π to π.", "atan2(z.y, z.x)", |g, a| each2(g, &a[0], &a[1], |g, y, x| g.binary(Binary::Atan2, y, x));
    sinh(x: Any) "The hyperbolic sine.", "sinh(z.x)", |g, a| each(g, a, |g, x| hyperbolic(g, x, Binary::Subtract));
    cosh(x: Any) "The hyperbolic cosine.", "cosh(z.x)", |g, a| each(g, a, |g, x| hyperbolic(g, x, Binary::Add));
    dot(x: Vector, y: Vector) "The sum of the products of components.", "dot(z, z)", |g, a| vec![g.dot(&a[0], &a[1])];
    length(x: Vector) "The length of a vector.", "length(z.xy)", |g, a| vec![g.length(&a[0])];
    distance(x: Vector, y: Vector) "The distance of two points.", "distance(z, c)", |g, a| { let way = each2(g, &a[0], &a[1], Graph::minus); vec![g.length(&way)] };
    normalize(x: Vector) "The vector of length 1 in the same direction.", "normalize(vec3(1, 1, 0))", |g, a| normalized(g, &a[0]);
    cross(x: Vec3, y: Vec3) "The vector product.", "cross(z, vec3(0, 0, 1))", |g, a| cross(g, &a[0], &a[1]);
    largest(x: Vector) "The largest component.", "largest(abs(z))", |g, a| vec![joined(g, &a[0], Binary::Max)];
    smallest(x: Vector) "The smallest component.", "smallest(abs(z))", |g, a| vec![joined(g, &a[0], Binary::Min)];
    rotate_x(v: Vec3, angle: Float) "v, turned about the x axis by radians.", "rotate_x(z, radians(30))", |g, a| turned(g, &a[0], a[1][0], [1, 2]);
    rotate_y(v: Vec3, angle: Float) "v, turned about the y axis by radians.", "rotate_y(z, radians(30))", |g, a| turned(g, &a[0], a[1][0], [2, 0]);
    rotate_z(v: Vec3, angle: Float) "v, turned about the z axis by radians.", "rotate_z(z, radians(30))", |g, a| turned(g, &a[0], a[1][0], [0, 1]);
    rotate(v: Vec3, axis: Vec3, angle: Float) "v, turned about an axis by radians.", "rotate(z, vec3(1, 1, 1), 0.5)", |g, a| rotated(g, &a[0], &a[1], a[2][0]);
    rotate_degrees(v: Vec3, angles: Vec3) "v, turned by degrees about x, then y, then z.", "rotate_degrees(z, vec3(0, 30, 45))", |g, a| turned_thrice(g, &a[0], &a[1]);
    complex_product(x: Vec2, y: Vec2) "The product of two complex numbers.", "complex_product(z.xy, c.xy)", |g, a| complex_product(g, &a[0], &a[1]);
    complex_quotient(x: Vec2, y: Vec2) "The quotient of two complex numbers.", "complex_quotient(z.xy, c.xy)", |g, a| complex_quotient(g, &a[0], &a[1]);
    complex_power(x: Vec2, n: Float) "A complex number to a real power.", "complex_power(z.xy, 3)", |g, a| complex_power(g, &a[0], a[1][0]);
    quaternion_product(x: Vec4, y: Vec4) "The product of two quaternions, real parts first.", "quaternion_product(vec4(z, 0.0), vec4(c, 0.0))", |g, a| quaternion_product(g, &a[0], &a[1]);
    triplex_power(z: Vec3, n: Float) "The Mandelbulb's power: multiplies longitude and latitude by n, and takes the radius to the power n.", "triplex_power(z, 8)", |g, a| triplex_power(g, &a[0], a[1][0]);
    box_fold(x: Any, limit: Any) "Mirrors components beyond ±limit at the limit.", "box_fold(z, 1.0)", |g, a| each2(g, &a[0], &a[1], box_fold);
    fold_count(v: Vector, limit: Any) "The number of components beyond ±limit, which a box fold mirrors.", "fold_count(z, 1.0)", |g, a| fold_count(g, &a[0], &a[1]);
    sphere_fold_scale(v: Vector, inner: Float, outer: Float) "The factor of a sphere fold: (outer / inner)² inside of the inner radius, (outer / length)² up to the outer radius, 1 beyond.",
        "z * sphere_fold_scale(z, 0.5, 1.0)", |g, a| vec![sphere_fold_scale(g, &a[0], a[1][0], a[2][0])];
    mirror(v: Vector, normal: Vector) "Mirrors v at the plane through the origin if v is behind it.", "mirror(z, normalize(vec3(1, 1, 0)))", |g, a| mirrored(g, &a[0], &a[1]);
    mirror_count(v: Vector, normal: Vector) "1 if v is behind the plane through the origin, so that `mirror` mirrors it, else 0.", "mirror_count(z, vec3(1, 1, 0))", |g, a| mirror_count(g, &a[0], &a[1]);
    polar_repeat(v: Vec2, count: Float) "Turns v by a multiple of a full turn over `count`, to the sector about the first axis.", "polar_repeat(z.xy, 6)", |g, a| polar_repeat(g, &a[0], a[1][0]);
}

/// One number for each component, or the components themselves.
fn spread(parts: &[Vec<NodeId>], size: usize) -> Vec<NodeId> {
    let all = parts.concat();
    if let [one] = all[..] { vec![one; size] } else { all }
}

fn each(
    g: &mut Graph,
    a: &[Vec<NodeId>],
    apply: impl Fn(&mut Graph, NodeId) -> NodeId,
) -> Vec<NodeId> {
    a[0].iter().map(|&x| apply(g, x)).collect()
}

fn each2(
    g: &mut Graph,
    a: &[NodeId],
    b: &[NodeId],
    apply: impl Fn(&mut Graph, NodeId, NodeId) -> NodeId,
) -> Vec<NodeId> {
    let size = a.len().max(b.len());
    let at = |v: &[NodeId], i: usize| v[i.min(v.len() - 1)];
    (0..size).map(|i| apply(g, at(a, i), at(b, i))).collect()
}

fn joined(g: &mut Graph, v: &[NodeId], operation: Binary) -> NodeId {
    v[1..].iter().fold(v[0], |all, &x| g.binary(operation, all, x))
}

fn scaled(g: &mut Graph, v: &[NodeId], by: NodeId) -> Vec<NodeId> {
    v.iter().map(|&x| g.times(x, by)).collect()
}

fn rounded(g: &mut Graph, x: NodeId) -> NodeId {
    let half = g.constant(0.5);
    let above = g.plus(x, half);
    g.unary(Unary::Floor, above)
}

fn modulo(g: &mut Graph, x: NodeId, y: NodeId) -> NodeId {
    let ratio = g.over(x, y);
    let whole = g.unary(Unary::Floor, ratio);
    let below = g.times(whole, y);
    g.minus(x, below)
}

/// √(1 − x²).
fn cosine_of_sine(g: &mut Graph, x: NodeId) -> NodeId {
    let (one, squared) = (g.constant(1.0), g.times(x, x));
    let left = g.minus(one, squared);
    g.unary(Unary::Sqrt, left)
}

/// Half of eˣ joined with e⁻ˣ.
fn hyperbolic(g: &mut Graph, x: NodeId, join: Binary) -> NodeId {
    let (half, opposite) = (g.constant(0.5), g.unary(Unary::Negate, x));
    let (up, down) = (g.unary(Unary::Exp, x), g.unary(Unary::Exp, opposite));
    let both = g.binary(join, up, down);
    g.times(half, both)
}

fn normalized(g: &mut Graph, v: &[NodeId]) -> Vec<NodeId> {
    let (least, length) = (g.constant(1e-18), g.length(v));
    let length = g.binary(Binary::Max, length, least);
    v.iter().map(|&x| g.over(x, length)).collect()
}

fn cross(g: &mut Graph, a: &[NodeId], b: &[NodeId]) -> Vec<NodeId> {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| {
            let (left, right) = (g.times(a[i], b[j]), g.times(a[j], b[i]));
            g.minus(left, right)
        })
        .into()
}

fn sine_and_cosine(g: &mut Graph, angle: NodeId) -> [NodeId; 2] {
    [g.unary(Unary::Sin, angle), g.unary(Unary::Cos, angle)]
}

/// `v` with the components of `plane` turned from the first toward the second.
fn turned(g: &mut Graph, v: &[NodeId], angle: NodeId, plane: [usize; 2]) -> Vec<NodeId> {
    let [sine, cosine] = sine_and_cosine(g, angle);
    let flat = plane.map(|axis| v[axis]);
    let flat = complex_product(g, &flat, &[cosine, sine]);
    let mut all = v.to_vec();
    (all[plane[0]], all[plane[1]]) = (flat[0], flat[1]);
    all
}

fn turned_thrice(g: &mut Graph, v: &[NodeId], degrees: &[NodeId]) -> Vec<NodeId> {
    let unit = g.constant(std::f64::consts::PI / 180.0);
    let angles = scaled(g, degrees, unit);
    // The matrix depends on the angles only, which are mostly parameters: the host computes it then.
    let zero = g.constant(0.0);
    let one = g.constant(1.0);
    let columns: [Vec<NodeId>; 3] = std::array::from_fn(|axis| {
        let unit: Vec<_> = (0..3).map(|i| if i == axis { one } else { zero }).collect();
        let about_x = turned(g, &unit, angles[0], [1, 2]);
        let about_y = turned(g, &about_x, angles[1], [2, 0]);
        turned(g, &about_y, angles[2], [0, 1])
    });
    combined(g, v, &columns)
}

/// The sum of `columns`, each times a component of `v`.
fn combined(g: &mut Graph, v: &[NodeId], columns: &[Vec<NodeId>]) -> Vec<NodeId> {
    (0..columns[0].len())
        .map(|row| {
            let row: Vec<_> = columns.iter().map(|column| column[row]).collect();
            g.dot(&row, v)
        })
        .collect()
}

/// Rodrigues' rotation, as a matrix of axis and angle.
fn rotated(g: &mut Graph, v: &[NodeId], axis: &[NodeId], angle: NodeId) -> Vec<NodeId> {
    let axis = normalized(g, axis);
    let [sine, cosine] = sine_and_cosine(g, angle);
    let one = g.constant(1.0);
    let rest = g.minus(one, cosine);
    let zero = g.constant(0.0);
    let columns: [Vec<NodeId>; 3] = std::array::from_fn(|i| {
        let unit: Vec<_> = (0..3).map(|j| if i == j { one } else { zero }).collect();
        let sideways = cross(g, &axis, &unit);
        let along = g.times(rest, axis[i]);
        (0..3)
            .map(|j| {
                let (kept, pushed) = (g.times(cosine, unit[j]), g.times(sine, sideways[j]));
                let projected = g.times(along, axis[j]);
                let sum = g.plus(kept, pushed);
                g.plus(sum, projected)
            })
            .collect()
    });
    combined(g, v, &columns)
}

fn complex_product(g: &mut Graph, a: &[NodeId], b: &[NodeId]) -> Vec<NodeId> {
    let (xx, yy) = (g.times(a[0], b[0]), g.times(a[1], b[1]));
    let (xy, yx) = (g.times(a[0], b[1]), g.times(a[1], b[0]));
    vec![g.minus(xx, yy), g.plus(xy, yx)]
}

fn complex_quotient(g: &mut Graph, a: &[NodeId], b: &[NodeId]) -> Vec<NodeId> {
    let conjugate = [b[0], g.unary(Unary::Negate, b[1])];
    let top = complex_product(g, a, &conjugate);
    let squared = g.dot(b, b);
    top.into_iter().map(|x| g.over(x, squared)).collect()
}

/// The exponent as a whole number from 1 to 16, if it is written as such.
fn whole(g: &Graph, n: NodeId) -> Option<u32> {
    g.value(n).filter(|n| n.fract() == 0.0 && (1.0..=16.0).contains(n)).map(|n| n as u32)
}

fn complex_whole_power(g: &mut Graph, z: &[NodeId], n: u32) -> Vec<NodeId> {
    if n == 1 {
        return z.to_vec();
    }
    let half = complex_whole_power(g, z, n / 2);
    let square = complex_product(g, &half, &half);
    if n.is_multiple_of(2) { square } else { complex_product(g, &square, z) }
}

fn complex_power(g: &mut Graph, z: &[NodeId], n: NodeId) -> Vec<NodeId> {
    if let Some(n) = whole(g, n) {
        return complex_whole_power(g, z, n);
    }
    let (length, angle) = (g.length(z), g.binary(Binary::Atan2, z[1], z[0]));
    let angle = g.times(n, angle);
    let [sine, cosine] = sine_and_cosine(g, angle);
    let length = g.binary(Binary::Power, length, n);
    vec![g.times(length, cosine), g.times(length, sine)]
}

fn quaternion_product(g: &mut Graph, a: &[NodeId], b: &[NodeId]) -> Vec<NodeId> {
    let (va, vb) = (&a[1..], &b[1..]);
    let (real, inner) = (g.times(a[0], b[0]), g.dot(va, vb));
    let (left, right, cross) = (scaled(g, vb, a[0]), scaled(g, va, b[0]), cross(g, va, vb));
    let sum = each2(g, &left, &right, Graph::plus);
    let imaginary = each2(g, &sum, &cross, Graph::plus);
    [vec![g.minus(real, inner)], imaginary].concat()
}

/// Thesis Algorithm 1, with atan2(z, ρ) for asin(z / r), and complex powers for whole exponents.
fn triplex_power(g: &mut Graph, z: &[NodeId], n: NodeId) -> Vec<NodeId> {
    let rho = g.length(&z[..2]);
    let meridian = [rho, z[2]];
    let Some(whole) = whole(g, n) else {
        let (longitude, latitude) =
            (g.binary(Binary::Atan2, z[1], z[0]), g.binary(Binary::Atan2, z[2], rho));
        let (longitude, latitude) = (g.times(n, longitude), g.times(n, latitude));
        let ([sl, cl], [sp, cp]) = (sine_and_cosine(g, longitude), sine_and_cosine(g, latitude));
        let length = g.length(z);
        let raised = g.binary(Binary::Power, length, n);
        let flat = g.times(raised, cp);
        return vec![g.times(flat, cl), g.times(flat, sl), g.times(raised, sp)];
    };
    // Beside the axis the rotor is that of +x.
    let (one, least) = (g.constant(1.0), g.constant(1e-18));
    let is_on_axis = g.binary(Binary::Less, rho, least);
    let safe = g.binary(Binary::Max, rho, least);
    let cosine = g.over(z[0], safe);
    let rotor = [g.select(is_on_axis, one, cosine), g.over(z[1], safe)];
    let (un, wn) =
        (complex_whole_power(g, &rotor, whole), complex_whole_power(g, &meridian, whole));
    vec![g.times(wn[0], un[0]), g.times(wn[0], un[1]), wn[1]]
}

fn box_fold(g: &mut Graph, x: NodeId, limit: NodeId) -> NodeId {
    let (two, least) = (g.constant(2.0), g.unary(Unary::Negate, limit));
    let above = g.binary(Binary::Max, x, least);
    let inside = g.binary(Binary::Min, above, limit);
    let twice = g.times(two, inside);
    g.minus(twice, x)
}

fn fold_count(g: &mut Graph, x: &[NodeId], limit: &[NodeId]) -> Vec<NodeId> {
    let (one, zero) = (g.constant(1.0), g.constant(0.0));
    let folded = each2(g, x, limit, |g, x, limit| {
        let size = g.unary(Unary::Abs, x);
        let is_beyond = g.binary(Binary::Less, limit, size);
        g.select(is_beyond, one, zero)
    });
    vec![joined(g, &folded, Binary::Add)]
}

fn mirror_count(g: &mut Graph, v: &[NodeId], normal: &[NodeId]) -> Vec<NodeId> {
    let (one, zero) = (g.constant(1.0), g.constant(0.0));
    let height = g.dot(v, normal);
    let is_behind = g.binary(Binary::Less, height, zero);
    vec![g.select(is_behind, one, zero)]
}

fn sphere_fold_scale(g: &mut Graph, v: &[NodeId], inner: NodeId, outer: NodeId) -> NodeId {
    let (inner, outer, squared) = (g.times(inner, inner), g.times(outer, outer), g.dot(v, v));
    let above = g.binary(Binary::Max, squared, inner);
    let within = g.binary(Binary::Min, above, outer);
    g.over(outer, within)
}

fn mirrored(g: &mut Graph, v: &[NodeId], normal: &[NodeId]) -> Vec<NodeId> {
    let (zero, two, height) = (g.constant(0.0), g.constant(2.0), g.dot(v, normal));
    let behind = g.binary(Binary::Min, height, zero);
    let twice = g.times(two, behind);
    let away = scaled(g, normal, twice);
    each2(g, v, &away, Graph::minus)
}

fn polar_repeat(g: &mut Graph, v: &[NodeId], count: NodeId) -> Vec<NodeId> {
    let (full, angle) = (g.constant(std::f64::consts::TAU), g.binary(Binary::Atan2, v[1], v[0]));
    let sector = g.over(full, count);
    let sectors = g.over(angle, sector);
    let nearest = rounded(g, sectors);
    let back = g.times(nearest, sector);
    let [sine, cosine] = sine_and_cosine(g, back);
    let opposite = g.unary(Unary::Negate, sine);
    complex_product(g, v, &[cosine, opposite])
}
