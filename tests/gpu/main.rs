//! The kernels on whatever adapter there is (lavapipe will do): what they draw, how much they
//! run, and whether they agree with pictures and mathematics made elsewhere.

mod compiling;
mod edits;
mod environment_map;
mod golden;
mod harness;
mod indirect;
mod memory;
mod moving;
mod picture;
mod post;
mod samples;
mod staleness;
