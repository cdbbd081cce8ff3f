//! How a picture is made. Start at [`frame`]: the passes in the order in which they run.
//!
//! | file | what lives there |
//! |---|---|
//! | [`view`] | one picture in progress, and what an edit restarts |
//! | [`schedule`] | what to compute next: a pure state machine |
//! | [`lattice`] | sparse lattices of pixels, and where samples lie in a pixel |
//! | [`frame`] | the passes of one submit |
//! | [`indirect`] | the source of indirect light |
//! | [`pass`] | one pass a file, with its shader's stem |
//! | [`environment_texture`] | the environment map on the GPU |
//! | [`pipelines`] | pipelines and bind group layouts |
//! | [`pipeline_key`] | what pipelines are specialised for |
//! | `filling` | how a sparse lattice becomes a whole picture |
//! | `preparation` | pipelines on their way: announced, compiled, tried |
//! | [`post`] | film statistics, exposure, bloom |
//! | `post_pipelines` | pipelines of the post passes |
//! | `anchors` | the anchors of a view that moves |
//! | [`space`] | render space: origin and unit of coordinates |
//! | [`work_queues`] | which threads a pass has work for |
//! | [`targets`] | buffers and the display texture |
//! | [`uniforms`] | structs shared with the shaders |
//! | [`samples`] | a finished view's pixels on their way back |
//! | [`memory`] | what a view holds of the GPU's memory |
//! | `histogram_readback` | readback of the film's histogram |
//! | [`report`] | what a view says of itself |

mod anchors;
pub mod environment_texture;
mod filling;
pub mod frame;
pub mod gbuffer;
mod histogram_readback;
pub mod indirect;
pub mod lattice;
mod layouts;
pub mod memory;
pub mod pass;
pub mod pipeline_key;
pub mod pipelines;
pub mod post;
mod post_pipelines;
mod preparation;
mod region;
pub mod report;
pub mod samples;
pub mod schedule;
pub mod space;
pub mod targets;
pub mod uniforms;
pub mod view;
pub mod work_queues;

pub use pipelines::Pipelines;
pub use region::{Eyes, MAX_REGION_PIXELS, MAX_REGION_PX, Region};
pub use report::{Activity, Report};
pub use schedule::Pace;
pub use view::View;
