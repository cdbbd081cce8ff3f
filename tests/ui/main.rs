//! The interface, driven as people drive it: by pointer, keys and the accessibility tree.

mod controls;
mod depth;
mod environment_map;
mod fit;
mod gestures;
mod hostile;
mod stage;
mod timeline;
