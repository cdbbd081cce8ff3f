//! Random formulas of the language: every function, every type, few operations.

use mandelight::formula::language::{
    check,
    functions::{Argument, FUNCTIONS},
    syntax,
};

use crate::random::Random;

/// Writes random expressions.
pub struct Expressions {
    random: Random,
}

impl Expressions {
    /// Expressions of a seed.
    pub fn new(seed: u64) -> Self {
        Self { random: Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1) }
    }

    fn below(&mut self, count: usize) -> usize {
        (self.random.unit() * count as f64) as usize
    }

    /// A formula whose step is random, and which the checker accepts.
    ///
    /// # Panics
    ///
    /// If the checker refuses a step for another reason than a constant that is no number.
    pub fn formula(&mut self) -> String {
        loop {
            // Most are shallow: a driver compiles those faster.
            let depth = if self.below(4) == 0 { 3 } else { 2 };
            let value = self.expression(3, depth);
            let text = format!("name \"Random\";\nstep {{\n    z = {value};\n}}");
            match syntax::parse(&text).and_then(|tree| check::check(&text, &tree)) {
                Ok(_) => return text,
                Err(error) if error.message.starts_with("the value is not a number") => {}
                Err(error) => panic!("{text}\n{error}"),
            }
        }
    }

    /// An expression of `size` components, nested at most `depth` deep.
    pub fn expression(&mut self, size: usize, depth: usize) -> String {
        if depth == 0 {
            return self.leaf(size);
        }
        match self.below(4) {
            0 => {
                let operator = ["+", "-", "*", "/"][self.below(4)];
                format!(
                    "({} {operator} {})",
                    self.expression(size, depth - 1),
                    self.expression(size, depth - 1)
                )
            }
            1 if size > 1 => {
                let part = self.expression(1, depth - 1);
                format!("({part} * {})", self.expression(size, depth - 1))
            }
            _ => self.call(size, depth - 1),
        }
    }

    fn leaf(&mut self, size: usize) -> String {
        let vector = ["z", "c", "p"][self.below(3)];
        match size {
            1 => match self.below(3) {
                0 => format!("{:.3}", self.random.signed()),
                _ => format!("{vector}.{}", ["x", "y", "z"][self.below(3)]),
            },
            2 => format!("{vector}.{}", ["xy", "yz", "zx", "xx"][self.below(4)]),
            3 => vector.to_owned(),
            _ => format!("vec4({vector}, {:.3})", self.random.signed()),
        }
    }

    fn condition(&mut self, depth: usize) -> String {
        let comparison = ["<", "<=", ">", ">=", "==", "!="][self.below(6)];
        let one =
            format!("{} {comparison} {}", self.expression(1, depth), self.expression(1, depth));
        match self.below(4) {
            0 => format!("({one} && {} < {})", self.leaf(1), self.leaf(1)),
            1 => format!("({one} || {} < {})", self.leaf(1), self.leaf(1)),
            _ => format!("({one})"),
        }
    }

    /// A call of a function whose result has `size` components.
    fn call(&mut self, size: usize, depth: usize) -> String {
        loop {
            let function = &FUNCTIONS[self.below(FUNCTIONS.len())];
            // The result's size, or that of the arguments of any size.
            let result = match function.name {
                "dot" | "length" | "distance" | "largest" | "smallest" | "sphere_fold_scale"
                | "fold_count" | "mirror_count" => 1,
                name if name.starts_with("complex") || name == "polar_repeat" => 2,
                name if name.starts_with("rotate")
                    || ["cross", "rotate_degrees", "triplex_power"].contains(&name) =>
                {
                    3
                }
                "quaternion_product" => 4,
                "normalize" | "mirror" if size == 1 => continue,
                _ => size,
            };
            let is_other_size =
                matches!(function.arguments, [(_, Argument::Parts(count))] if *count != size);
            if result != size || is_other_size {
                continue;
            }
            let vector = if size == 1 { 2 + self.below(3) } else { size };
            let arguments: Vec<String> = function
                .arguments
                .iter()
                .map(|(_, kind)| match kind {
                    Argument::Condition => self.condition(depth),
                    Argument::Any => self.expression(size, depth),
                    Argument::Vector => self.expression(vector, depth),
                    Argument::Parts(_) => self.expression(1, depth),
                    kind => self.expression(kind.size().unwrap_or(1), depth),
                })
                .collect();
            return format!("{}({})", function.name, arguments.join(", "));
        }
    }
}
