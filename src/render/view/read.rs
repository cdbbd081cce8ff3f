//! What a view has drawn, back from the GPU.

use super::View;
use crate::{
    gpu::readback::{Readback, ReadbackError},
    render::{
        gbuffer::Samples,
        samples::{self, SamplesReadback},
        targets::Targets,
    },
};

impl View {
    /// Reads the film back, waiting for it: each pixel's mean radiance, linear Rec. 709, rows from
    /// the upper edge. Natively.
    pub fn film(&self) -> Result<Vec<[f32; 3]>, ReadbackError> {
        let gpu = &self.pipelines.gpu;
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu);
        let (rg, bw) = (read(&self.targets.film_rg)?, read(&self.targets.film_bw)?);
        Ok(samples::means(&rg, &bw).collect())
    }

    /// Starts to read back every pixel's radiance, depth and normal. The view may be drawn over
    /// at once.
    pub fn read_samples(&self) -> SamplesReadback {
        let Targets { film_rg, film_bw, center, .. } = &self.targets;
        let film = [film_rg, film_bw];
        SamplesReadback::new(&self.pipelines.gpu, film, &center.surface, self.space.scale())
    }

    /// Reads the centre samples' G-buffer back, waiting for it: for tests and tools, natively.
    pub fn gbuffer(&self) -> Result<Samples, ReadbackError> {
        let gpu = &self.pipelines.gpu;
        let center = &self.targets.center;
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu);
        let (surface, visibility) = (read(&center.surface)?, read(&center.visibility)?);
        Ok(Samples::decode(&surface, &visibility, self.space.scale()))
    }
}
