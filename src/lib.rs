//! Mandelight draws 3D fractals: as a page in the browser and without a window on any wgpu
//! adapter, from the same WGSL kernels.
//!
//! # How a frame is made
//!
//! ```text
//! Scene ──▶ Schedule ──▶ slice ──▶ march ──▶ normal ──▶ shadow ──▶ shade ──▶ film ──▶ fill ──▶ tone ──▶ display
//! pure      what is      one       rays to   gradient   one bit    lights,   sums of  between  curve,   texture,
//! data      stale and    submit    surface   of the     a light    colours   samples  lattice  sRGB     PNG
//!           what fits              points    distance                                 pixels
//! ```
//!
//! 1. The interface or the command line edits a [`scene::Scene`].
//! 2. [`render::View`] compares what the kernels would read of it with what they read last
//!    ([`render::uniforms::Inputs`]). The difference is one of five levels of staleness:
//!    geometry, normals, light, indirect light, tone. Of what lights the picture, only what moved
//!    has its rays marched again: a light by itself, a colour or a material not at all.
//!    A view deeper than an f32 can tell counts from an anchor on the surface in view
//!    ([`render::space::RenderSpace`]), which is looked for beside the frames.
//!    Where the scene needs pipelines that nobody made yet, the report says so, the picture stays,
//!    and they are compiled before anything asks for them.
//! 3. [`render::schedule::Schedule`] says what to compute next, a piece at a time: a lattice of
//!    pixels as sparse as the motion budget demands, then the lattice's next levels, then whole
//!    jittered samples, then nothing.
//! 4. [`render::frame::record`] records each piece, pass by pass, in the order in which they run.
//!    Cones of rays go first and queue the blocks of threads that have rays left to march
//!    ([`render::work_queues`]): the passes after them are as large as their queues.
//!    [`gpu::timing::Stopwatch`] measures it, and the schedule learns from that.
//! 5. Post passes read the whole film where the scene asks for it: its mean sets the exposure, and
//!    bright pixels bloom ([`render::post`]). Without them the samples of a sparse lattice never fill the
//!    film: they are tone mapped and upsampled to the display.
//! 6. What the film holds is shown: by the page's interface, or tile by tile as a PNG
//!    ([`export::StillJob`]).
//!
//! # Layers
//!
//! ```text
//! formula ◀── scene ◀── fractal ◀── render ──▶ gpu      export ──▶ render
//! ui ──▶ scene, fractal, render::report     web, the binary ──▶ all
//! ```
//!
//! Arrows only point this way; `tests/source/layers.rs` holds them.
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
pub mod render;
pub mod scene;
pub mod ui;
#[cfg(target_arch = "wasm32")]
mod web;
