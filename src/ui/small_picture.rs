//! Small pictures that the shell draws when idle, such as those of places.

use crate::scene::Scene;

/// Width and height of a small picture, in pixels.
pub const SMALL_PICTURE_PX: [u32; 2] = [168, 112];

/// Identifies the content of a small picture: another scene has another identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SmallPictureId {
    /// The part of the interface that shows the picture.
    pub owner: &'static str,
    /// The owner's number of the picture.
    pub number: u64,
}

/// A small picture that the interface wants.
#[derive(Clone, Debug, PartialEq)]
pub struct SmallPicture {
    /// Its identity.
    pub id: SmallPictureId,
    /// What it shows, with the quality to draw it in.
    pub scene: Scene,
}
