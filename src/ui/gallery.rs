//! The gallery that the page's address names, as far as it has been read.

use crate::scene::gallery::Gallery;

/// A gallery on a web host.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GalleryState {
    /// Its list is being read.
    Loading,
    /// The reason why it cannot be shown, for the visitor.
    Failed(String),
    /// Its list has been read.
    Ready {
        /// The address of the list's folder, with `/` at its end.
        address: String,
        /// The list.
        gallery: Gallery,
    },
}
