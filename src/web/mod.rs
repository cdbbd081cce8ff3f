//! The page: start-up, device loss, downloads, drops, the address bar, storage.
//!
//! In: a canvas and the browser's events. Out: the interface on that canvas, the renderer's work in
//! small pieces, and everything that the interface asks for but does not do itself.
//!
//! | file | what lives there |
//! |---|---|
//! | [`start`] | opening the GPU, and again when it is lost |
//! | `session` | what outlives the GPU: the interface, its scene, where they are kept |
//! | `async_compile` | pipelines that are compiled while everything else goes on |
//! | `app` | one frame of the interface |
//! | `engine` | the GPU's work between frames |
//! | `picture` | the view in the window and its texture in egui |
//! | `still`, `sequence` | a picture, or the frames of a path, on their way to a download |
//! | `file_access` | a file that is written while it is made, where the browser can |
//! | `files`, `address`, `storage` | what the browser takes and gives |
//! | `autosave` | writes the scene to storage and address at rest |
//! | `device_loss` | how often, and how carefully, to start again |
//! | `mailbox` | what callbacks leave for the next frame |
//! | `faults`, `test_hook` | what went wrong, and the handle that browser tests have |
//! | `page` | the window: clocks, timers, listeners |

mod address;
mod app;
mod async_compile;
mod autosave;
mod device_loss;
mod engine;
mod faults;
mod file_access;
mod files;
mod mailbox;
mod page;
mod picture;
mod sequence;
mod session;
pub mod start;
mod still;
mod storage;
mod test_hook;
