//! The user interface: panels, input in the view, the status line.
//!
//! In: the renderer's report and the picture's texture. Out: an edited
//! [`Scene`](crate::scene::Scene), the picture's size, whether the view is in motion, and
//! [`Action`]s for the shell. This layer draws with egui only; it accesses no GPU, file or browser.
//!
//! | file | contents |
//! |---|---|
//! | `interface` | one frame: layout, dispatch, undo |
//! | `display_inputs`, `action` | the shell's data to display, and requests to the shell |
//! | `settings`, `export_size`, `sheet_height` | settings stored between visits, such as the size of saved pictures |
//! | `finder`, `control_index` | the search over commands, scenes, sections and controls; the names of controls |
//! | `favourites` | the views that a person keeps |
//! | `merge` | lists that two tabs edit at once |
//! | `gallery` | the gallery that the page's address names |
//! | [`file_progress`] | the file that is being fetched and decoded |
//! | `selection` | the selected light, colour layer and gradient stops |
//! | `loaded` | the environment map and gradients that people opened |
//! | `panel/` | the panels, one per file |
//! | `widgets/` | sliders for the parameter table, the direction ball, the gradient editor |
//! | `view`, `frame`, `pilot`, `handles` | the picture, where it is, the camera's input, handles of lights and section planes |
//! | `compare` | two states of the project, of which one is in view |
//! | `light_click`, `light_handles` | a click that lights a place; when directional lights have handles in the view |
//! | `field` | the distance field for the camera's movements |
//! | `places/` | the search for places of the view, and its pins |
//! | `slice` | slices of a frame for searches |
//! | `mutate`, `surprises` | variations of the scene, of which one is chosen; random scenes |
//! | `share` | the share window: link, QR code, picture |
//! | `look_preview`, `sphere` | a look in the view while it is pointed at; what its swatch shows |
//! | `small_picture` | small pictures that the shell draws when idle |
//! | `floating`, `hints`, `notice` | buttons and captions over the picture, first hints, the shell's message |
//! | [`thumbnail`], [`opening`] | pictures on the buttons of scenes and dives; the picture that the page shows first |
//! | `home`, `dive` | the target of the Home button; what a dive shows and keeps |
//! | [`navigation`] | the camera's movements, independent of egui |
//! | [`shortcuts`] | the table of keys, for dispatch and for the help window |
//! | [`accessibility`] | the interface as a screen reader reads it |
//! | [`loss_policy`] | after losses of the GPU: how often to restart, in which safe mode, and what to open |
//! | [`ended_scenes`] | scenes that ended a visit, which the next one offers |
//! | [`editor`] | the edited scene and path, and their history |
//! | `timeline` | the playhead: the time of the path that is in view |
//! | `status`, [`theme`], `icon`, [`rects`] | the status line, style, icons, widget positions |

mod action;
mod compare;
mod control_index;
mod display_inputs;
mod dive;
mod export_size;
mod favourites;
mod field;
mod finder;
mod floating;
mod frame;
mod gallery;
mod handles;
mod hints;
mod home;
mod icon;
mod interface;
mod light_click;
mod light_handles;
mod loaded;
mod look_preview;
mod merge;
mod mutate;
mod notice;
mod panel;
mod pilot;
mod places;
mod selection;
mod settings;
mod share;
mod sheet_height;
mod slice;
mod small_picture;
mod sphere;
mod status;
mod surprises;
mod timeline;
mod view;
mod widgets;

pub mod accessibility;
pub mod editor;
pub mod ended_scenes;
pub mod file_progress;
pub mod loss_policy;
pub mod navigation;
pub mod opening;
pub mod rects;
pub mod shortcuts;
pub mod theme;
pub mod thumbnail;
pub mod toast;

pub use action::Action;
pub use display_inputs::{
    DisplayInputs, ExportProgress, KeptPicture, Notice, SmallTextures, ViewTexture,
};
pub use export_size::{
    DEFAULT_QUALITY, ExportSize, MAX_EXPORT_SIDE_PX, MissingEncoders, SequenceFormat, StillFile,
    StillFormat, VideoSpec,
};
pub use favourites::{Favourite, Favourites};
pub use gallery::GalleryState;
pub use hints::Hints;
pub use interface::Interface;
pub use panel::{all_sections_open, section_title_of};
pub use settings::{Sections, Settings};
pub use share::Sharing;
pub use sheet_height::SheetHeight;
pub use small_picture::{SMALL_PICTURE_PX, SmallPicture, SmallPictureId};
pub use status::zoom;
