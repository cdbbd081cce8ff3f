//! One picture, rendered tile by tile and written band by band.
//!
//! While one tile is drawn, the last one is on its way back from the GPU, and the rows of the
//! band before are being packed. So the whole cost in memory is one view of a tile, one tile's
//! pixels in flight and two bands of rows, whatever the picture's height.

use std::{io::Write, ops::ControlFlow, sync::Arc};

use web_time::Instant;

use super::{
    ExportError, Eye, PictureFormat,
    format::{Arriving, Encoder},
    overview::Overview,
    sheet::Sheet,
    tiles::{Tile, Tiling},
};
use crate::{
    render::{Pace, Pipelines, View},
    scene::{Camera, EnvironmentMap, Scene, StereoLayout},
};

/// Largest tile unless told otherwise, in pixels: wide, so that bands stay thin.
const TILE_PX: [u32; 2] = [2048, 256];

/// A band of rows takes at most so much, where its pixels are large.
const MOST_BAND_BYTES: usize = 32 << 20;

/// How many bytes of rows one step packs at most: a few hundredths of a second's work, for a
/// page has to stay fluid meanwhile.
const BYTES_PER_STEP: usize = 1 << 19;

/// How much of the picture, and how many seconds, before the rest is foretold.
const FORETELL_FROM: (f64, f64) = (0.02, 1.0);

/// What still to make.
#[derive(Clone, Debug)]
pub struct StillOptions {
    /// Width and height of the picture, or of either eye's, in pixels: each 1 to
    /// [`super::MAX_PICTURE_PX`], which both eyes' together in one file keep to as well.
    pub size_px: [u32; 2],
    /// The eye whose picture is wanted alone, for one of a pair of files; none for what the
    /// scene's layout shows.
    pub eye: Option<Eye>,
    /// Samples a pixel, in [`crate::scene::param::SAMPLES`]; none for the scene's own.
    pub samples: Option<u32>,
    /// Largest width and height of a tile. Smaller needs less memory, larger wastes less time
    /// between tiles; the picture is the same.
    pub tile_px: [u32; 2],
    /// The environment map that is at hand.
    pub environment_map: Option<Arc<EnvironmentMap>>,
    /// The kind of file.
    pub format: PictureFormat,
}

impl StillOptions {
    /// A picture of `size_px` with the scene's own samples.
    pub fn new(size_px: [u32; 2]) -> Self {
        Self {
            size_px,
            eye: None,
            samples: None,
            tile_px: TILE_PX,
            environment_map: None,
            format: PictureFormat::default(),
        }
    }

    /// What a still with these options shows when it is asked to show `scene`: this is the scene
    /// that its file carries. Either file of a pair carries that of both beside each other.
    pub fn shown(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        if let Some(samples) = self.samples {
            scene.quality.samples = samples;
        }
        if self.eye.is_some() {
            scene.camera.stereo.layout = StereoLayout::SideBySide;
        }
        scene
    }

    /// Width and height of the file's picture, all of it, in pixels.
    ///
    /// # Errors
    /// [`ExportError::Size`], [`ExportError::Sheet`] and [`ExportError::RedCyanExr`]: what no
    /// still can be.
    pub fn sheet_px(&self, scene: &Scene) -> Result<[u32; 2], ExportError> {
        Ok(Sheet::new(scene, self)?.size_px())
    }
}

/// How far a still is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StillStatus {
    /// There is more to do: call [`StillJob::step`] again.
    Working {
        /// Part of the work done, 0 to 1; never decreases.
        done: f64,
        /// Seconds to go, once there is something to judge by.
        remaining_secs: Option<f64>,
    },
    /// All bytes have been written: call [`StillJob::finish`].
    Done,
}

/// A still in progress. Dropping it cancels it; what it wrote so far is no complete file.
pub struct StillJob<W: Write> {
    pipelines: Arc<Pipelines>,
    overview: Option<Overview>,
    view: View,
    tiling: Tiling,
    /// The tile being drawn; the count of tiles once all are.
    drawing: u32,
    /// The tile on its way back.
    arriving: Option<(Tile, Arriving)>,
    /// The band that tiles are put into.
    filling: Band,
    /// The band that is being packed.
    packing: Band,
    format: PictureFormat,
    camera: Camera,
    /// Samples of all pixels.
    samples: f64,
    encoder: Encoder<W>,
    rows_left: u32,
    started_secs: Option<f64>,
    furthest: f64,
    faults_before: u64,
}

/// Whole rows of pixels.
#[derive(Default)]
struct Band {
    bytes: Vec<u8>,
    /// All its tiles are in.
    is_full: bool,
    /// Bytes that have been packed.
    packed: usize,
}

impl Band {
    fn is_packed(&self) -> bool {
        self.packed == self.bytes.len()
    }

    /// Puts a tile's pixels in their place in rows of `sheet_px`, each of so many bytes.
    fn place(&mut self, tile: Tile, sheet_px: u32, pixels: &[u8], pixel_bytes: usize) {
        let [width, height] = tile.region.size_px.map(|px| px as usize);
        let stride = sheet_px as usize * pixel_bytes;
        let width = width * pixel_bytes;
        self.bytes.resize(stride * height, 0);
        let left = tile.left_px as usize * pixel_bytes;
        for (row, pixels) in self.bytes.chunks_exact_mut(stride).zip(pixels.chunks_exact(width)) {
            row[left..left + width].copy_from_slice(pixels);
        }
    }
}

impl<W: Write> StillJob<W> {
    /// Starts a still of `scene` that goes to `sink` as a file of its format. The header, with the scene
    /// document, is written at once.
    ///
    /// # Errors
    /// [`ExportError::Scene`] where the samples or the scene are out of range, those of
    /// [`StillOptions::sheet_px`], [`ExportError::Write`] where `sink` refuses.
    pub fn new(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        options: StillOptions,
        sink: W,
    ) -> Result<Self, ExportError> {
        let scene = options.shown(scene);
        let sheet = Sheet::new(&scene, &options)?;
        scene.validate()?;

        let sheet_px = sheet.size_px();
        let row_bytes = sheet_px[0] as usize * options.format.pixel_bytes();
        let [tile_width, tile_height] = options.tile_px;
        let most_rows = (MOST_BAND_BYTES / row_bytes).max(1) as u32;
        let tiling = Tiling::new(sheet, [tile_width, tile_height.min(most_rows)]);
        let environment_map = options.environment_map.as_ref();
        let mut view = View::new(pipelines, tiling.tile(0).region, Pace::Still);
        view.set_environment_map(environment_map);
        view.set_scene(&scene, false);
        let pixels: f64 = sheet_px.map(f64::from).iter().product();
        Ok(Self {
            pipelines: pipelines.clone(),
            overview: Overview::new(pipelines, &scene, environment_map, &sheet, options.format),
            view,
            tiling,
            drawing: 0,
            arriving: None,
            filling: Band::default(),
            packing: Band::default(),
            format: options.format,
            encoder: Encoder::new(options.format, sink, sheet_px, &scene)?,
            samples: pixels * f64::from(scene.quality.samples),
            camera: scene.camera,
            rows_left: sheet_px[1],
            started_secs: None,
            furthest: 0.0,
            faults_before: pipelines.gpu.faults(),
        })
    }

    /// Does what can be done without waiting: submits GPU work, takes a tile that has come
    /// back, packs some rows. Call it until it says [`StillStatus::Done`]: once per displayed
    /// frame in a page, natively with a poll of the device in between. `now_secs` is any
    /// steady clock.
    ///
    /// # Errors
    /// [`ExportError::Gpu`] where the device fails, [`ExportError::Write`] where the sink
    /// does. After an error the job is of no more use.
    pub fn step(&mut self, now_secs: f64) -> Result<StillStatus, ExportError> {
        let started_secs = *self.started_secs.get_or_insert(now_secs);
        self.draw(now_secs);
        self.collect()?;
        self.pack()?;
        if self.pipelines.gpu.faults() > self.faults_before {
            return Err(ExportError::Gpu("the device reported an error".to_owned()));
        }
        if self.rows_left == 0 {
            return Ok(StillStatus::Done);
        }
        self.furthest = self.furthest.max(self.part_done());
        let elapsed_secs = now_secs - started_secs;
        let can_tell = self.furthest > FORETELL_FROM.0 && elapsed_secs > FORETELL_FROM.1;
        let remaining_secs = can_tell.then(|| elapsed_secs * (1.0 - self.furthest) / self.furthest);
        Ok(StillStatus::Working { done: self.furthest, remaining_secs })
    }

    /// Ends the file and gives the sink back.
    ///
    /// # Errors
    /// [`ExportError::Encode`] before [`StillStatus::Done`], [`ExportError::Write`] from the
    /// sink.
    pub fn finish(self) -> Result<W, ExportError> {
        self.encoder.finish()
    }

    /// Draws more of the overview or of the current tile, or sends that on its way and turns to
    /// the next.
    fn draw(&mut self, now_secs: f64) {
        if !self.know_the_whole(now_secs)
            || self.drawing == self.tiling.count()
            || self.view.pump(now_secs)
            || self.arriving.is_some()
        {
            return;
        }
        let Some(arriving) = self.format.read(&self.pipelines.gpu, &self.view) else { return };
        self.arriving = Some((self.tiling.tile(self.drawing), arriving));
        self.drawing += 1;
        if self.drawing < self.tiling.count() {
            // The copy is submitted, so the view may be drawn over.
            self.view.set_region(self.tiling.tile(self.drawing).region);
        }
    }

    /// Sees to it that the tiles are shown as parts of the whole. False while it is not known.
    fn know_the_whole(&mut self, now_secs: f64) -> bool {
        let Some(overview) = &mut self.overview else { return true };
        if !overview.is_finished() {
            if !overview.pump(now_secs) {
                return false;
            }
            overview.lend_to(&mut self.view);
        }
        true
    }

    /// Puts an arrived tile into its band, and a full band where it is packed.
    fn collect(&mut self) -> Result<(), ExportError> {
        if !self.filling.is_full
            && let Some((tile, arriving)) = &mut self.arriving
        {
            let arrived = arriving
                .take(&self.pipelines.gpu, &self.camera, tile.region)
                .map_err(|error| ExportError::Gpu(error.to_string()))?;
            if let Some(pixels) = arrived {
                let [sheet_width, _] = self.tiling.sheet_px();
                self.filling.place(*tile, sheet_width, &pixels, self.format.pixel_bytes());
                self.filling.is_full = tile.ends_band;
                self.arriving = None;
            }
        }
        if self.filling.is_full && self.packing.is_packed() {
            // The packed band's memory is filled again.
            let Band { mut bytes, .. } = std::mem::take(&mut self.packing);
            bytes.clear();
            self.packing = std::mem::replace(&mut self.filling, Band { bytes, ..Band::default() });
        }
        Ok(())
    }

    /// Packs some rows.
    fn pack(&mut self) -> Result<(), ExportError> {
        if self.packing.is_packed() {
            return Ok(());
        }
        let row_bytes = self.tiling.sheet_px()[0] as usize * self.format.pixel_bytes();
        let rows = (BYTES_PER_STEP / row_bytes).max(1);
        let waiting = &self.packing.bytes[self.packing.packed..];
        let now = &waiting[..waiting.len().min(rows * row_bytes)];
        self.encoder.write_rows(now)?;
        self.packing.packed += now.len();
        // A band has at most the picture's rows, so this fits.
        self.rows_left -= (now.len() / row_bytes) as u32;
        Ok(())
    }

    /// Part of the samples that have been drawn, the overview's among them, 0 to 1.
    fn part_done(&self) -> f64 {
        let report = self.view.report();
        let of_tile = f64::from(report.samples_done) / f64::from(report.samples_wanted.max(1));
        let tiles = f64::from(self.drawing)
            + if self.drawing < self.tiling.count() { of_tile } else { 0.0 };
        let of_tiles = (tiles / f64::from(self.tiling.count())).min(1.0);
        let Some(overview) = &self.overview else { return of_tiles };
        let done = self.samples * of_tiles + overview.samples() * overview.part_done();
        done / (self.samples + overview.samples())
    }
}

impl<W: Write> StillJob<W> {
    /// Runs the job to its end, waiting for the GPU: for native programs only. `watch` sees
    /// every status, and ends the job by breaking.
    ///
    /// # Errors
    /// As [`Self::step`] and [`Self::finish`]; [`ExportError::Cancelled`] where `watch` broke.
    pub fn run(
        mut self,
        mut watch: impl FnMut(StillStatus) -> ControlFlow<()>,
    ) -> Result<W, ExportError> {
        let clock = Instant::now();
        loop {
            let status = self.step(clock.elapsed().as_secs_f64())?;
            if watch(status).is_break() {
                return Err(ExportError::Cancelled);
            }
            if status == StillStatus::Done {
                return self.finish();
            }
            self.view.wait();
        }
    }
}
