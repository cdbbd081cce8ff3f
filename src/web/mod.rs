//! The page: start-up, device loss, downloads, drops, the address bar, storage.
//!
//! In: a canvas and the browser's events. Out: the interface on that canvas, the renderer's work in
//! small pieces, and everything that the interface asks for but does not do itself.
//!
//! The files from top to bottom; each names only files below it.
//!
//! | file | what lives there |
//! |---|---|
//! | [`start`] | opening the GPU, and again when it is lost |
//! | `app` | one frame of the interface |
//! | `engine` | the GPU's work between frames |
//! | `test_hook` | the handle that browser tests have |
//! | `session` | what outlives the GPU: the interface, its scene, where they are kept |
//! | `picture` | the view in the window and its texture in egui |
//! | `sequence`, `still` | the frames of a path, or a picture, on their way to a download |
//! | `autosave` | writes the scene to storage and address at rest |
//! | `device_loss` | how often, and how carefully, to start again |
//! | `file_access` | a file that is written while it is made, where the browser can |
//! | `files`, `address`, `storage` | what the browser takes and gives |
//! | `async_compile` | pipelines that are compiled while everything else goes on |
//! | `faults` | what went wrong |
//! | `mailbox` | what callbacks leave for the next frame |
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
