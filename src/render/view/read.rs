//! A view's results: its picture, and what is read back from the GPU.

use super::View;
use crate::{
    gpu::readback::{Readback, ReadbackError},
    render::{
        gbuffer::Samples,
        samples::{self, Light, SamplesReadback},
        space::RenderSpace,
        targets::Targets,
        uniforms::Inputs,
    },
};

impl View {
    /// The newest picture: `Rgba8Unorm`, sRGB-encoded, opaque; none before the first picture.
    ///
    /// With 16 bits per channel it has [two texels](super::super::display_values::DisplayValues::is_deep) a pixel.
    /// Usages TEXTURE_BINDING and COPY_SRC. The picture is always complete, never a half-filled lattice.
    /// On a CPU adapter a finer picture of a view takes the place of a coarser one row by row.
    /// After a change of size it is the old picture, in its own size, until there is a new one.
    pub fn texture(&self) -> Option<&wgpu::Texture> {
        self.shown.texture()
    }

    /// A counter that changes whenever [`Self::texture`] becomes another texture.
    pub fn texture_generation(&self) -> u64 {
        self.shown.generation()
    }

    /// True while a scene waits to be applied.
    pub fn has_pending_scene(&self) -> bool {
        self.pending.is_some()
    }

    /// Scene units per unit of the view's render space.
    fn scale(&self) -> f64 {
        self.space.as_ref().map_or(1.0, RenderSpace::scale)
    }

    /// Reads back each pixel's mean radiance, and waits for it; native only.
    ///
    /// Linear Rec. 709, rows from the top.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn film(&self) -> Result<Vec<[f32; 3]>, ReadbackError> {
        let gpu = &self.pipelines.gpu;
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu);
        let (rg, bw) = (read(&self.targets.film_rg)?, read(&self.targets.film_bw)?);
        Ok(samples::means(&rg, &bw).collect())
    }

    /// Reads back each pixel's denoised radiance, and waits for it; native only. None if it is not denoised.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn denoised(&self) -> Result<Option<Vec<[f32; 3]>>, ReadbackError> {
        if !self.denoises() {
            return Ok(None);
        }
        let gpu = &self.pipelines.gpu;
        let light = Readback::buffer(gpu, self.targets.denoiser.output()).wait(gpu)?;
        Ok(Some(samples::denoised(&light).collect()))
    }

    /// Starts to read back every pixel's radiance, denoised if the display is, depth and normal.
    ///
    /// The view may draw again at once.
    pub fn read_samples(&self) -> SamplesReadback {
        let Targets { film_rg, film_bw, center, denoiser, .. } = &self.targets;
        let light = match self.denoises() {
            true => Light::Denoised(denoiser.output()),
            false => Light::Film([film_rg, film_bw]),
        };
        let has_guides = self.inputs.as_ref().is_some_and(Inputs::traces_paths);
        let guides = has_guides.then_some(&center.visibility);
        let samples =
            self.inputs.as_ref().map(|inputs| inputs.frame.background.transparent_samples);
        let weights = samples.filter(|&samples| samples > 0.0).map(|samples| (film_bw, samples));
        let gpu = &self.pipelines.gpu;
        SamplesReadback::new(gpu, light, &center.surface, guides, weights, self.scale())
    }

    /// Reads back the centre samples' G-buffer, and waits for it; native only, for tests and tools.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn gbuffer(&self) -> Result<Samples, ReadbackError> {
        let gpu = &self.pipelines.gpu;
        let center = &self.targets.center;
        let read = |buffer| Readback::buffer(gpu, buffer).wait(gpu);
        let (surface, visibility) = (read(&center.surface)?, read(&center.visibility)?);
        Ok(Samples::decode(&surface, &visibility, self.scale()))
    }
}
