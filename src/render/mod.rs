//! Draws pictures. Start at [`pass`]: its tables list the passes in the order of a frame.
//!
//! | file | contents |
//! |---|---|
//! | [`view`] | one picture in progress, and what an edit restarts |
//! | [`schedule`] | what to compute next: a pure state machine |
//! | [`shaders`] | the WGSL files, and the module of each pass |
//! | [`lattice`] | sparse lattices of pixels, and the positions of samples in a pixel |
//! | [`frame`] | records the passes of a batch or a display |
//! | [`recorder`] | records the passes: bindings and dispatches |
//! | [`display_parts`] | divides displays that take long |
//! | [`integrator`] | how the light is computed that samples see |
//! | [`indirect`] | the source of indirect light |
//! | [`pass`] | one file per pass, named like its shader |
//! | [`environment_texture`] | the environment map on the GPU |
//! | [`sky`] | the sky that light paths see |
//! | [`albedo_table`] | directional albedo of glossy reflection |
//! | [`pipelines`] | the compute pipelines of a device |
//! | [`pipeline_set`] | pipelines that are compiled together, and their variants |
//! | `reconstruction` | how a sparse lattice becomes a whole picture |
//! | `preparation` | announces, compiles and rehearses pipelines |
//! | [`post`] | film statistics, exposure, bloom |
//! | `anchors` | the anchors of a moving view |
//! | [`space`] | render space: origin and unit of coordinates |
//! | [`work_queues`] | work queues: the blocks of threads that a pass has work for |
//! | [`occupancy`] | how few blocks occupy all cores of a CPU adapter |
//! | `buffers` | constructors of buffers and bind groups |
//! | `gbuffer` | readback of the G-buffer |
//! | `layouts` | bind group layouts |
//! | `region` | the part of a picture that a view draws |
//! | [`display_values`] | what a display picture holds |
//! | [`targets`] | buffers and the display texture |
//! | `path_targets` | buffers and textures of light paths |
//! | [`uniforms`] | structs shared with the shaders |
//! | [`sub_frame`] | sub-frames of motion blur |
//! | `shutter` | the sums of their films |
//! | [`samples`] | readback of a finished view's pixels |
//! | [`memory`] | a view's GPU memory |
//! | `noise_control` | ends a picture of light paths at the noise asked for |
//! | `histogram_readback` | readback of the film's histogram |
//! | [`report`] | the status of a view |
//! | `reuse` | moves samples to the buffers of another size |

pub mod albedo_table;
mod anchors;
mod buffers;
pub mod color_curve;
pub mod denoiser;
pub mod display_parts;
pub mod display_values;
pub mod environment_texture;
pub mod frame;
pub mod gbuffer;
mod histogram_readback;
pub mod indirect;
pub mod integrator;
pub mod lattice;
mod layouts;
pub mod memory;
mod noise_control;
pub mod occupancy;
pub mod pass;
mod path_targets;
pub mod pipeline_set;
pub mod pipelines;
pub mod post;
mod preparation;
mod reconstruction;
pub mod recorder;
mod region;
pub mod report;
mod reuse;
pub mod samples;
pub mod schedule;
pub mod shaders;
mod shared_exponent;
mod shutter;
pub mod sky;
pub mod space;
pub mod sub_frame;
pub mod targets;
pub mod uniforms;
pub mod view;
pub mod work_queues;

pub use pipelines::Pipelines;
pub use region::{Eyes, MAX_REGION_PIXELS, MAX_REGION_PX, Region};
pub use report::{Activity, Report};
pub use schedule::Pace;
pub use view::View;
