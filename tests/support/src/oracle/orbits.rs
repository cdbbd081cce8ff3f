//! Orbits of formulas and hybrids in f64: their ends, estimates and heights.
//!
//! Derivatives that a text leaves to the program are differences of orbits here.

use glam::{DVec3, DVec4, Vec4Swizzles as _};
use mandelight::formula::Fractal;

use super::{
    folds::julia_constant,
    formulas::{self, Distance, Equations},
    transforms,
};

/// The orbits of a fractal. Its steps are found once, since finding a hybrid's takes far longer than an orbit.
pub struct Orbits {
    /// Equations and parameters of each step: one for a formula that draws alone.
    of: Vec<(Equations, Fractal)>,
    /// The place in `of` of each of an orbit's steps.
    order: Vec<usize>,
    /// The place of the step that computes sizes and distances.
    leading: usize,
    julia_constant: Option<DVec4>,
    bailout: f64,
    iterations: u32,
}

impl Orbits {
    /// Of a fractal whose formulas the oracle knows.
    pub fn of(fractal: &Fractal) -> Self {
        let known = |fractal: Fractal| {
            let id = fractal.formula().id();
            let found = formulas::equations(id).or_else(|| transforms::equations(id));
            (found.unwrap_or_else(|| panic!("no oracle of {id}")), fractal)
        };
        let count = fractal.iterations as usize;
        let (of, order, leading) = match fractal.hybrid() {
            None => (vec![known(fractal.clone())], vec![0; count], 0),
            Some(hybrid) => {
                let step = |step: &mandelight::formula::HybridStep| {
                    let mut alone = Fractal::new(step.formula());
                    for (field, value) in step.fields() {
                        assert!(alone.set(field.name, value.clone()));
                    }
                    known(alone)
                };
                let of: Vec<_> = hybrid.steps.iter().map(step).collect();
                let unrolled =
                    |from: usize| {
                        hybrid.steps.iter().enumerate().skip(from).flat_map(|(place, step)| {
                            std::iter::repeat_n(place, step.repeats as usize)
                        })
                    };
                let mut order: Vec<_> = unrolled(0).collect();
                while order.len() < count {
                    order.extend(unrolled(hybrid.loop_start));
                }
                order.truncate(count);
                let in_loop = hybrid.loop_start..of.len();
                let is_transform =
                    |&place: &usize| transforms::equations(of[place].1.formula().id()).is_some();
                let is_power = |place: &usize| {
                    !is_transform(place) && matches!(of[*place].0.distance, Distance::Log)
                };
                let leading = in_loop
                    .clone()
                    .find(is_power)
                    .or_else(|| in_loop.clone().find(|place| !is_transform(place)));
                (of, order, leading.unwrap_or(hybrid.loop_start))
            }
        };
        Self {
            of,
            order,
            leading,
            julia_constant: julia_constant(fractal),
            bailout: fractal.bailout,
            iterations: fractal.iterations,
        }
    }

    fn start(&self, point: DVec3) -> DVec4 {
        let (equations, fractal) = &self.of[0];
        (equations.start)(fractal, point)
    }

    fn step(&self, n: usize, z: DVec4, c: DVec4, dr: f64, dc: f64) -> (DVec4, f64) {
        let (equations, fractal) = &self.of[self.order[n]];
        let is_narrow = equations.components == 3;
        let [z3, c3] = [z, c].map(|v| if is_narrow { v.xyz().extend(0.0) } else { v });
        let (mut next, dr) = (equations.step)(fractal, z3, c3, dr, dc);
        if is_narrow {
            next.w = z.w;
        }
        (next, dr)
    }

    fn leading(&self) -> &(Equations, Fractal) {
        &self.of[self.leading]
    }

    /// The state as the leading formula knows it.
    fn seen(&self, z: DVec4) -> DVec4 {
        if self.leading().0.components == 3 { z.xyz().extend(0.0) } else { z }
    }

    fn size(&self, z: DVec4) -> f64 {
        (self.leading().0.size)(self.seen(z))
    }

    /// The state after a number of steps, wherever the orbit goes.
    fn after(&self, point: DVec3, count: u32) -> DVec4 {
        let start = self.start(point);
        let c = self.julia_constant.unwrap_or(start);
        (0..count as usize).fold(start, |z, n| self.step(n, z, c, 1.0, 1.0).0)
    }

    /// The Frobenius norm of the state's derivative after `count` steps, by differences, and how far those of two
    /// spacings disagree, as a part of it.
    fn difference(&self, point: DVec3, count: u32) -> [f64; 2] {
        let at = |spacing: f64| {
            let along = |axis: DVec3| {
                let [ahead, behind] =
                    [1.0, -1.0].map(|s| self.after(point + s * spacing * axis, count));
                ((ahead - behind) / (2.0 * spacing)).length_squared()
            };
            (along(DVec3::X) + along(DVec3::Y) + along(DVec3::Z)).sqrt()
        };
        // Spacings far below the distance to the set.
        let rough = at(1e-9).max(1e-3);
        let [fine, coarse] = [1e-6, 4e-6].map(|part| at((part / rough).min(part)));
        [fine, (coarse / fine - 1.0).abs()]
    }

    /// Whether the derivative of the fractal is left to the program.
    pub fn is_derived(&self) -> bool {
        !self.of.iter().all(|(equations, _)| equations.gives_derivative)
    }

    /// The orbit of `point` with its derivative.
    pub fn orbit(&self, point: DVec3) -> End {
        let start = self.start(point);
        let c = self.julia_constant.unwrap_or(start);
        let dc = if self.julia_constant.is_some() { 0.0 } else { 1.0 };
        let (mut z, mut before, mut dr, mut steps) = (start, start, 1.0, 0);
        let mut points = Vec::new();
        while steps < self.iterations && self.size(z) <= self.bailout {
            before = z;
            (z, dr) = self.step(steps as usize, z, c, dr, dc);
            points.push(z);
            steps += 1;
        }
        let size = self.size(z);
        let escaped = size.is_nan() || size > self.bailout;
        let mut uncertain = 0.0;
        if self.is_derived() {
            [dr, uncertain] = self.difference(point, steps);
        }
        let mut smooth_iterations = f64::from(steps);
        if escaped && steps > 0 {
            let [old, new] = [before, z].map(|z| self.size(z).ln());
            let limit = self.bailout.ln();
            let part = match self.leading().0.distance {
                Distance::Log => (new / limit).ln() / (new / old.max(1e-4)).ln(),
                _ => (new - limit) / (new - old),
            };
            smooth_iterations -= part.clamp(0.0, 1.0);
        }
        End { z, dr, uncertain, steps, escaped, points, smooth_iterations }
    }

    /// The estimated distance of `point`.
    pub fn distance(&self, point: DVec3) -> f64 {
        let End { z, dr, .. } = self.orbit(point);
        let (equations, of) = self.leading();
        let (r, seen) = (self.size(z), self.seen(z));
        let found = match equations.distance {
            Distance::Log => 0.5 * r * r.ln() / (dr * slope(equations.size, seen)),
            Distance::Linear(offset) => (r - offset) / (dr * slope(equations.size, seen)),
            Distance::Own(own) => own(of, seen, dr, point),
        };
        if found > 0.0 { found } else { 0.0 }
    }

    /// The height whose gradient is the normal of a formula without dr: what the estimate divides.
    pub fn height(&self, point: DVec3, steps: u32) -> f64 {
        self.size(self.after(point, steps))
    }
}

/// The end of an orbit.
#[derive(Clone, Debug)]
pub struct End {
    /// The state.
    pub z: DVec4,
    /// The running derivative.
    pub dr: f64,
    /// How far differences of two spacings disagree on dr, as a part of it; 0 where the equations give dr.
    pub uncertain: f64,
    /// Steps taken.
    pub steps: u32,
    /// Whether the orbit passed the bailout.
    pub escaped: bool,
    /// The orbit after its start.
    pub points: Vec<DVec4>,
    /// The thesis's eq. 3.1, with the growth of the last step.
    pub smooth_iterations: f64,
}

/// How fast `size` changes with the state.
fn slope(size: fn(DVec4) -> f64, z: DVec4) -> f64 {
    let spacing = 1e-6 * z.length().max(1e-3);
    let along =
        |axis: DVec4| (size(z + spacing * axis) - size(z - spacing * axis)) / (2.0 * spacing);
    DVec4::new(along(DVec4::X), along(DVec4::Y), along(DVec4::Z), along(DVec4::W)).length()
}
