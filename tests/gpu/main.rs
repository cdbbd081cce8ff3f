//! The kernels on whatever adapter there is (lavapipe will do): what they draw, how much they
//! run, and whether they agree with pictures and mathematics made elsewhere.

mod benchmark;
mod colors;
mod compiling;
mod deep;
mod depth;
mod dives;
mod edits;
mod environment_map;
mod exr;
mod golden;
mod indirect;
mod integrator;
mod language;
mod lens;
mod looks;
mod memory;
mod mitsuba;
mod motion_blur;
mod moving;
mod oracle;
mod paths;
mod paths_oracle;
mod picture;
mod places;
mod post;
mod random_views;
mod samples;
mod shine;
mod soft_shadows;
mod staleness;
mod stereo;
mod still;
mod still_values;
mod surprise;
mod thumbnails;
