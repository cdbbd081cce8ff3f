//! Reading of what comes from outside, within limits.
//!
//! In: values, lists and texts that may come from anyone. Out: values no larger than their limits, or
//! errors. A limit holds while a list is read: what exceeds it is never in memory.
//!
//! | file | contents |
//! |---|---|
//! | [`list`] | lists with a largest length |
//! | [`objects`] | structs from objects with named fields only |
//! | [`source`] | parts of a file, within its length |
//! | [`openexr`] | the headers of an OpenEXR file |
//! | `visible` | texts without control characters, for messages |

pub mod list;
pub mod objects;
pub mod openexr;
pub mod source;
pub mod visible;

pub use list::at_most;
pub use objects::Objects;
pub use visible::{is_hidden, visible, visible_lines};
