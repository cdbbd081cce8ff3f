//! The formula language: its functions, errors, derivatives and docs.
//!
//! | file | what it tests |
//! |---|---|
//! | `hybrids` | hybrids as data |
//! | `texts` | texts that are right, texts that are wrong, and the docs |
//! | `derivatives` | derived derivatives against differences, for generated steps |

mod derivatives;
mod hybrids;
mod texts;
