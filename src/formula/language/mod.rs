//! The formula language: a text with parameters and one step becomes a formula.
//!
//! In: a text, as `docs/formulas.md` describes it. Out: a [`TextFormula`], which has its parameters' table, its
//! distance field in f64 and its kernels in WGSL. No part of a text reaches a shader: WGSL is made
//! from checked operations.
//!
//! | file | contents |
//! |---|---|
//! | [`tree`] | the syntax tree, and errors with their places |
//! | [`syntax`], `grammar.pest` | from text to syntax tree |
//! | [`graph`] | scalar operations, simplified |
//! | [`functions`] | the functions that a text can call |
//! | [`derive`](mod@derive) | derivatives of operations |
//! | [`evaluate`] | operations in f64 |
//! | `scope` | names, types and values of expressions |
//! | `distance` | the estimated distance at an orbit's end |
//! | [`check`] | from syntax tree to checked operations |
//! | [`wgsl`] | operations as WGSL |
//! | [`kernel`] | what a formula's kernels compute |
//! | [`operations`] | the WGSL functions of one or several formulas |
//! | [`sequence`] | the order of an orbit's steps |
//! | [`steps`] | the kernel and programs of formulas whose steps take turns |
//! | `orbit.wgsl` | follows orbits: colours, and what both kinds of estimates share |
//! | `by_derivative.wgsl`, `by_jacobian.wgsl` | estimates with the text's dr, and without |
//! | [`uniforms`], `types.wgsl` | the kernels' uniforms |
//! | [`field`] | the distance field in f64 |
//! | [`text_formula`] | the formula |

pub mod check;
pub mod derive;
mod distance;
pub mod evaluate;
pub mod field;
pub mod functions;
pub mod graph;
pub mod kernel;
pub mod operations;
mod scope;
pub mod sequence;
pub mod steps;
pub mod syntax;
pub mod text_formula;
pub mod tokens;
pub mod tree;
pub mod uniforms;
pub mod wgsl;

pub use text_formula::TextFormula;
pub use tree::TextError;
