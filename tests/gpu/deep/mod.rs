//! The kernels' deepest views against a march with numbers of 192 bits.
//!
//! | file | what it tests |
//! |---|---|
//! | `agree` | the renderer's pictures against the march |
//! | `along` | the kernels' estimates along rays against the march's |

mod agree;
mod along;
