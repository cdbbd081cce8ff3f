//! The page: start-up, device loss, downloads, dropped files, the address bar, storage.
//!
//! In: a canvas and the browser's events. Out: the interface on that canvas, the renderer's work in
//! small pieces, and the interface's [`Action`](crate::ui::Action)s performed.
//!
//! The files from top to bottom; each imports only files below it:
//!
//! | file | what it does |
//! |---|---|
//! | [`start`] | opens the GPU, starts the app, restarts it after a GPU loss |
//! | `app` | one frame of the interface |
//! | `engine` | the GPU work between frames |
//! | `exporter` | the export in progress |
//! | `view_picture` | the picture on the screen as a file, for clipboard, share sheet, download |
//! | `video_support` | which videos the browser can encode |
//! | `test_hook` | the object by which browser tests drive the page |
//! | `session` | the state that outlives the GPU: interface, scene, notice |
//! | `sequence_export` | frames of a path into a zip or a video |
//! | `sequence_file` | that zip or video, where the visitor wants it |
//! | `still_export` | a picture into a download |
//! | `stored` | settings and kept views in the storage |
//! | `autosave` | writes the scene to storage and address |
//! | `error_log` | panics and errors of the visit |
//! | `scene_watch` | the scene on its way to a picture, in the storage |
//! | `device_loss` | the losses of the GPU in the storage |
//! | `video` | a video, encoded by the browser |
//! | `file_access` | a file on the disk, written while its content is made |
//! | `decoder` | the file that is being decoded, in a worker |
//! | `decode_worker` | the decoding, within that worker |
//! | `files` | downloads, file dialogue, dropped files, clipboard |
//! | `address` | the scene in the address bar |
//! | `storage` | texts in the browser's storage |
//! | `live_view` | the picture in the window and its texture in egui |
//! | `small_pictures` | small pictures of the interface, drawn when the view rests |
//! | `async_compile` | pipelines compiled while the page goes on |
//! | `image_decoder` | pictures in the interface, decoded by the browser |
//! | `gallery` | the gallery of the page's address |
//! | `mailbox` | messages from callbacks to the next frame |
//! | `file_content` | what a file holds, and its way from the worker |
//! | `opening` | the opening picture, until the view's first is as good |
//! | `accessibility` | the interface for screen readers |
//! | `page` | the window: clocks, timers, listeners |

mod accessibility;
mod address;
mod app;
mod async_compile;
mod autosave;
mod decode_worker;
mod decoder;
mod device_loss;
mod engine;
mod error_log;
mod exporter;
mod file_access;
mod file_content;
mod files;
mod gallery;
mod image_decoder;
mod live_view;
mod mailbox;
mod opening;
mod page;
mod scene_watch;
mod sequence_export;
mod sequence_file;
mod session;
mod small_pictures;
pub mod start;
mod still_export;
mod storage;
mod stored;
mod test_hook;
mod video;
mod video_support;
mod view_picture;
