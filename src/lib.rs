//! Mandelight draws 3D fractals: as a page in the browser and without a window on any wgpu
//! adapter, from the same WGSL kernels.
//!
//! # How a frame is made
//!
//! ```text
//! Scene ──▶ Schedule ──▶ camera rays ──▶ march ──▶ normal ──▶ shadow ──▶ shade ──▶ film ──▶ fill ──▶ tone ──▶ display
//! pure      chooses a    one per         to the    gradient   one bit    lights,   sums of  between  curve,   texture,
//! data      piece of     sample          surface   of the     a light    colours   samples  lattice  sRGB     PNG
//!           work                                   distance                                 pixels
//! ```
//!
//! 1. The interface or the command line edits a [`scene::Scene`]. Its fractal is a formula with values
//!    ([`formula::Fractal`]), prepared once an edit ([`fractal::FractalModel`]) and shared by the
//!    interface, navigation and the renderer.
//! 2. [`render::View`] compares what the kernels would read of the scene with what they read last
//!    ([`render::uniforms::Inputs`]). The difference is one of five levels of staleness:
//!    geometry, normals, light, indirect light, tone. A light that moved has its own rays marched
//!    again; an edit of colours or materials marches none.
//!    Views deeper than an f32 can tell are measured from an anchor on the surface in view
//!    ([`render::space::RenderSpace`]), which a search finds beside the frames.
//!    If the scene needs pipelines that are not compiled yet, the report says so, and the picture
//!    stays until they are.
//! 3. [`render::schedule::Schedule`] chooses what to compute next, a piece at a time: a lattice of
//!    pixels as sparse as the motion budget demands, then the lattice's next levels, then whole
//!    jittered samples, then nothing.
//! 4. [`render::frame::record`] records each piece, in batches that fit the buffers of rays: the passes of
//!    an integrator ([`render::integrator::DIRECT`]) over samples, or those of a display. `camera_rays`
//!    writes one ray per sample. `camera_cone` marches one cone per block of threads and queues the blocks
//!    that may hit ([`render::work_queues`]); the passes after it are as large as their queues. `march`
//!    moves each ray to its surface point. [`gpu::timing::Stopwatch`] measures the piece, and the schedule
//!    learns from that.
//! 5. Post passes read the whole film if the scene needs it: the film's mean sets the exposure, and
//!    bright pixels bloom ([`render::post`]). Otherwise the samples of a sparse lattice are tone
//!    mapped and upsampled to the display without filling the film. A display that takes long is
//!    submitted in parts ([`render::display_parts`]).
//! 6. The page's interface shows the display texture, or [`export::StillJob`] reads it back tile by
//!    tile for a PNG.
//!
//! # Layers
//!
//! ```text
//! precise, reading ◀── formula ◀── scene ◀── fractal ◀── render ──▶ gpu      export ──▶ render
//! ui ──▶ formula, scene, fractal, render::report      web, the binary ──▶ all
//! ```
//!
//! Arrows only point this way, between folders (`tests/source/layers.rs`) and between files
//! (`tests/source/direction.rs`).
//!
//! ```
//! // A scene is data: it can be made, changed, written and read without any GPU.
//! use mandelight::scene::{Scene, document};
//! let mut scene = Scene::default();
//! scene.fractal.set("power", 5.0);
//! let text = document::to_json(&scene);
//! assert_eq!(document::from_json(&text).unwrap(), scene);
//! ```

pub mod export;
pub mod formula;
pub mod fractal;
pub mod gpu;
pub mod precise;
pub mod reading;
pub mod render;
pub mod scene;
pub mod ui;
#[cfg(target_arch = "wasm32")]
mod web;
