//! Films of any colours, given to the kernels as if they had been rendered.

use std::sync::Arc;

use glam::DVec3;
use mandelight::{
    gpu::{host_shared::HostShared, readback::Readback},
    render::{
        Region,
        frame::record,
        integrator::DIRECT,
        post::{Need, Post, Tasks},
        recorder::{Dispatches, Recorder},
        schedule::{Display, KeptPixels, Work},
        targets::Targets,
        uniforms::{Inputs, Statistics},
    },
    scene::Scene,
};
use mandelight_test_support::device::pipelines;

/// What the kernels made of a film.
pub struct Toned {
    /// Mean, exposure, histogram, where the bloom lies.
    pub statistics: Statistics,
    /// All mip levels, as the last pass left them.
    pub mips: Vec<DVec3>,
    /// Display values of each pixel, 0 to 255.
    pub display: Vec<DVec3>,
}

/// A film of one sample a pixel, of which everything is found out.
pub struct Film {
    region: Region,
    targets: Targets,
}

impl Film {
    /// A film of `size_px`.
    pub fn new(size_px: [u32; 2]) -> Self {
        Self::of(Region::whole(size_px))
    }

    /// The film of a region.
    pub fn of(region: Region) -> Self {
        let mut targets = Targets::new(&pipelines().layouts, region);
        let need = Need { mean: true, bloom: true };
        targets.post = Arc::new(Post::new(&pipelines().layouts, region, need));
        Self { region, targets }
    }

    /// Shows `colors` with the scene's tone and bloom.
    pub fn tone(&self, scene: &Scene, colors: &[[f32; 3]]) -> Toned {
        self.show(scene, colors, 0)
    }

    /// The same, with only the pixels of the lattice `level` known of `colors`.
    pub fn show(&self, scene: &Scene, colors: &[[f32; 3]], level: u32) -> Toned {
        let pipelines = pipelines();
        let gpu = &pipelines.gpu;
        let inputs = Inputs::new(scene, self.region);
        self.targets.upload(&gpu.queue, &inputs);
        let rg: Vec<_> = colors.iter().map(|[r, g, _]| [*r, *g]).collect();
        let bw: Vec<_> = colors.iter().map(|[_, _, b]| [*b, 1.0]).collect();
        gpu.queue.write_buffer(&self.targets.film_rg, 0, bytemuck::cast_slice(&rg));
        gpu.queue.write_buffer(&self.targets.film_bw, 0, bytemuck::cast_slice(&bw));
        let passes = pipelines.of_frame(&inputs);
        let mut dispatches = Dispatches::default();
        let mut recorder =
            Recorder::new(&pipelines.layouts, &passes, &self.targets, &inputs, &mut dispatches);
        recorder.tasks = Tasks {
            mean: true,
            histogram: true,
            adapt: Some(1.0),
            bloom: scene.bloom.strength > 0.0,
        };
        record(
            &DIRECT,
            &mut recorder,
            Work::Display(Display {
                level,
                fill: level > 0,
                from_film: false,
                adapt: 1.0,
                kept: KeptPixels::default(),
                refines: false,
            }),
        );
        gpu.queue.submit([recorder.finish()]);

        let post = &self.targets.post;
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu).expect("the buffer's bytes");
        let display = Readback::texture(gpu, &self.targets.texture, self.region.display_px());
        let bytes = display.wait(gpu).expect("the picture's bytes");
        assert_eq!(gpu.faults(), 0);
        let element = |bytes: &[u8; 16]| {
            let [r, g, b, _]: [f32; 4] = bytemuck::cast(*bytes);
            DVec3::new(r.into(), g.into(), b.into())
        };
        Toned {
            statistics: Statistics::read(&read(&post.statistics)),
            mips: read(&post.mips).as_chunks().0.iter().map(element).collect(),
            display: bytes
                .as_chunks::<4>()
                .0
                .iter()
                .map(|&[r, g, b, _]| DVec3::new(r.into(), g.into(), b.into()))
                .collect(),
        }
    }
}
