//! The job of one picture: rendered tile by tile, encoded band by band.
//!
//! While one tile renders, the previous tile's readback is in flight, and the rows of the previous
//! band are being encoded. So a job's memory is one tile's view, one tile's pixels in flight and
//! two bands of rows, for pictures of any height. A picture that reuses a view's samples is one tile.

use std::{io::Write, sync::Arc};

use super::{
    ExportError, StillOptions,
    format::{Encoder, FileEncoding, TileReadback},
    motion::{SubFrameView, SubFrames},
    overview::Overview,
    sheet::Sheet,
    tiles::{Tile, Tiling},
};
use crate::{
    render::{MAX_REGION_PX, Pipelines, Region, View, pass::denoise, report::ClampedLight},
    scene::{Path, Scene},
};

/// Maximum size of a band of rows, in bytes; reduces the tile's height if pixels are large.
const MAX_BAND_BYTES: usize = 32 << 20;

/// Maximum width of a tile whose display has two texels a pixel.
const MAX_DEEP_TILE_PX: u32 = 2048;

/// Maximum encoder bytes of a picture that reuses a view's samples. Such a picture is one tile.
const MAX_REUSED_BYTES: u64 = 128 << 20;

/// Maximum pixels of a picture that reuses a view's samples; a picture of 3840×2160 fits. A second view of that size is
/// allocated.
const MAX_REUSED_PX: u64 = 1 << 23;

/// Maximum number of row bytes that one step encodes: a few hundredths of a second of work,
/// because a page must stay fluid.
const BYTES_PER_STEP: usize = 1 << 19;

/// Fraction of the picture, and seconds, that must pass before a remaining time is estimated.
const MIN_PART_FOR_ESTIMATE: f64 = 0.02;
const MIN_SECS_FOR_ESTIMATE: f64 = 1.0;

impl StillOptions {
    /// Width and height of the file, with both eyes' pictures, in pixels.
    ///
    /// # Errors
    /// [`ExportError::Size`], [`ExportError::Sheet`], [`ExportError::WebPSize`], [`ExportError::RedCyanExr`],
    /// [`ExportError::Deep`], [`ExportError::Transparent`] and [`ExportError::TransparentRedCyan`].
    pub fn sheet_px(&self, scene: &Scene) -> Result<[u32; 2], ExportError> {
        Ok(Sheet::new(scene, self)?.size_px())
    }
}

/// Progress of a still.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StillStatus {
    /// The still is incomplete: call [`StillJob::step`] again.
    Working {
        /// Completed fraction of the work, 0 to 1; never decreases.
        done: f64,
        /// Estimated remaining time, seconds; none until an estimate is possible.
        remaining_secs: Option<f64>,
    },
    /// All rows are written: call [`StillJob::finish`].
    Done {
        /// Part of the light that the firefly limit removed, 0 to 1; none without a limit.
        clamped_fraction: Option<f64>,
    },
}

/// A still in progress. Dropping the job cancels it and leaves an incomplete file.
pub struct StillJob<W: Write> {
    pipelines: Arc<Pipelines>,
    subject: Subject,
    overview: Option<Overview>,
    view: SubFrameView,
    tiling: Tiling,
    /// The tiling of the picture where it is rendered.
    render_tiling: Tiling,
    /// Index of the tile being rendered; equals the number of tiles after the last one.
    tile_index: u32,
    /// The tile whose readback is in flight.
    in_flight: Option<TileInFlight>,
    /// What the firefly limit removed from the tiles that were read back; none without a limit.
    clamped_light: Option<ClampedLight>,
    /// The band that collects tiles.
    filling: Band,
    /// The band that is being encoded.
    encoding: Band,
    /// Bytes per pixel of the encoder's input.
    pixel_bytes: usize,
    /// Number of samples, summed over all pixels.
    samples: f64,
    encoder: Encoder<W>,
    rows_left: u32,
    started_secs: Option<f64>,
    /// The largest reported progress.
    max_done: f64,
    faults_before: u64,
}

/// A complete tile whose pixels are on their way.
struct TileInFlight {
    tile: Tile,
    readback: TileReadback,
    /// What the firefly limit removed up to this tile; none without a limit.
    clamped_light: Option<ClampedLight>,
}

/// What a still shows, whatever device draws it.
struct Subject {
    /// The scene that the file stores.
    scene: Scene,
    sub_frames: SubFrames,
    options: StillOptions,
    file: FileEncoding,
}

impl Subject {
    fn overview(&self, pipelines: &Arc<Pipelines>, sheet: &Sheet) -> Option<Overview> {
        let map = self.options.environment_map.as_ref();
        Overview::new(pipelines, &self.scene, &self.sub_frames, map, sheet, self.file.format)
    }

    /// The view that draws tiles, beginning with `region`.
    fn view(&self, pipelines: &Arc<Pipelines>, region: Region) -> SubFrameView {
        let Self { options, file, .. } = self;
        let map = options.environment_map.as_ref();
        SubFrameView::new(pipelines, region, map, self.drawn_sub_frames(), file.values)
    }

    /// The sub-frames as the tiles' view draws them.
    fn drawn_sub_frames(&self) -> SubFrames {
        let Self { scene, options, .. } = self;
        let mut drawn = self.sub_frames.clone();
        drawn.change(|drawn| {
            drawn.integrator.denoise = options.denoises(scene);
            // Opacity is a share of all samples, so every pixel gets all.
            if options.is_transparent {
                drawn.integrator.noise = 0.0;
            }
        });
        drawn
    }

    /// A view with the samples of `other`, if they are those of `region`.
    fn view_of_samples(&self, other: &View, region: Region) -> Option<SubFrameView> {
        let drawn = self.drawn_sub_frames();
        let [scene] = drawn.scenes() else { return None };
        // Samples before a transparent background are others.
        if other.region() != region || self.options.is_transparent {
            return None;
        }
        let map = self.options.environment_map.as_ref();
        let view = other.still_of_samples(scene, map, self.file.values)?;
        Some(SubFrameView::of_samples(view, drawn))
    }
}

/// One row of tiles, as whole rows of pixels.
#[derive(Default)]
struct Band {
    bytes: Vec<u8>,
    /// True if the band has all its tiles.
    is_full: bool,
    /// Number of encoded bytes.
    encoded: usize,
}

impl Band {
    fn is_encoded(&self) -> bool {
        self.encoded == self.bytes.len()
    }

    /// Copies a tile's part of its rendered pixels into the band's rows, which are `sheet_width_px` wide.
    fn copy_tile(&mut self, tile: Tile, sheet_width_px: u32, pixels: &[u8], pixel_bytes: usize) {
        let [width, height] = tile.region.size_px.map(|px| px as usize);
        let [skipped, above] = std::array::from_fn(|i| {
            (tile.region.origin_px[i] - tile.rendered.origin_px[i]) as usize
        });
        let stride = sheet_width_px as usize * pixel_bytes;
        let rendered = tile.rendered.size_px[0] as usize * pixel_bytes;
        let [width, skipped] = [width, skipped].map(|px| px * pixel_bytes);
        self.bytes.resize(stride * height, 0);
        let left = tile.left_px as usize * pixel_bytes;
        let rows = pixels.chunks_exact(rendered).skip(above);
        for (row, pixels) in self.bytes.chunks_exact_mut(stride).zip(rows) {
            row[left..left + width].copy_from_slice(&pixels[skipped..skipped + width]);
        }
    }
}

impl<W: Write> StillJob<W> {
    /// Starts a still of `scene` and writes the file's header, with the scene, to `sink`.
    ///
    /// # Errors
    /// [`ExportError::Scene`] if the samples or the scene are out of range, the errors of
    /// [`StillOptions::sheet_px`], [`ExportError::Write`] if writing to `sink` fails.
    pub fn new(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        options: StillOptions,
        sink: W,
    ) -> Result<Self, ExportError> {
        let scene = options.shown(scene);
        scene.validate()?;
        Self::begin(pipelines, &scene, SubFrames::single(scene.clone()), options, sink)
    }

    /// Starts the still of frame `frame` of `path`, with its motion blur.
    ///
    /// # Errors
    /// As [`Self::new`]; [`ExportError::NoFrames`] for a path without keys.
    pub fn of_frame(
        pipelines: &Arc<Pipelines>,
        path: &Path,
        frame: u32,
        options: StillOptions,
        sink: W,
    ) -> Result<Self, ExportError> {
        let scene = options.shown(&path.frame(frame).ok_or(ExportError::NoFrames)?);
        scene.validate()?;
        let sub_frames = SubFrames::of_frame(path, frame, &scene, &options);
        for scene in sub_frames.scenes() {
            scene.validate()?;
        }
        Self::begin(pipelines, &scene, sub_frames, options, sink)
    }

    /// Starts a still that stores `scene` and is drawn by `sub_frames`.
    fn begin(
        pipelines: &Arc<Pipelines>,
        scene: &Scene,
        sub_frames: SubFrames,
        options: StillOptions,
        sink: W,
    ) -> Result<Self, ExportError> {
        let sheet = Sheet::new(scene, &options)?;
        let sheet_px = sheet.size_px();
        let file = options.file();
        let pixel_bytes = file.pixel_bytes(scene.traces_paths());
        let row_bytes = sheet_px[0] as usize * pixel_bytes;
        let [tile_width, tile_height] = options.tile_px;
        let tile_width =
            if options.is_deep { tile_width.min(MAX_DEEP_TILE_PX) } else { tile_width };
        let max_rows = (MAX_BAND_BYTES / row_bytes).max(1) as u32;
        let denoises = options.denoises(scene);
        // Tall tiles render fewer pixels twice.
        let (apron_px, factor) = if denoises { (denoise::REACH_PX, 2) } else { (0, 1) };
        let max_tile_px = [tile_width, (factor * tile_height).min(max_rows)];
        let tiling = Tiling::new(sheet, max_tile_px, apron_px);
        let samples = f64::from(scene.quality.samples);
        let subject = Subject { scene: scene.clone(), sub_frames, options, file };
        let pixels: f64 = sheet_px.map(f64::from).iter().product();
        Ok(Self {
            pipelines: pipelines.clone(),
            overview: subject.overview(pipelines, &sheet),
            view: subject.view(pipelines, tiling.tile(0).rendered),
            tiling,
            render_tiling: tiling,
            tile_index: 0,
            in_flight: None,
            clamped_light: None,
            filling: Band::default(),
            encoding: Band::default(),
            subject,
            pixel_bytes,
            encoder: Encoder::new(file, sink, sheet_px, scene)?,
            samples: pixels * samples,
            rows_left: sheet_px[1],
            started_secs: None,
            max_done: 0.0,
            faults_before: pipelines.gpu.faults(),
        })
    }

    /// Reuses the finished samples of `view` if they are those of this still, which is then only displayed and encoded.
    ///
    /// Otherwise, or if the picture is too large, the still is rendered. Call it before the first step. `view` must be on
    /// the job's device, and may change afterwards.
    #[must_use]
    pub fn with_samples_of(mut self, view: &View) -> Self {
        let sheet = self.tiling.sheet();
        let [width, height] = sheet.size_px();
        let pixels = u64::from(width) * u64::from(height);
        let tiling = Tiling::whole(sheet);
        let fits = pixels <= MAX_REUSED_PX
            && pixels * self.pixel_bytes as u64 <= MAX_REUSED_BYTES
            && width * self.subject.file.values.texels_per_pixel() <= MAX_REGION_PX;
        if fits && let Some(view) = self.subject.view_of_samples(view, tiling.tile(0).rendered) {
            self.view = view;
            self.render_tiling = std::mem::replace(&mut self.tiling, tiling);
            self.overview = None;
        }
        self
    }

    /// Does the work that needs no waiting: submits, takes a readback, encodes some rows.
    ///
    /// Call it until it returns [`StillStatus::Done`]: in a page once per displayed frame,
    /// natively with a device poll between calls. `now_secs` is a monotonic clock.
    ///
    /// # Errors
    /// [`ExportError::Gpu`] if the device fails: then [`Self::resume_on`] continues. [`ExportError::Write`] if
    /// the sink fails: then the job cannot continue.
    pub fn step(&mut self, now_secs: f64) -> Result<StillStatus, ExportError> {
        let started_secs = *self.started_secs.get_or_insert(now_secs);
        self.render(now_secs);
        // Before a tile counts as finished: after an error its pixels may be anything.
        self.check_device()?;
        self.collect()?;
        self.encode()?;
        self.check_device()?;
        if self.rows_left == 0 {
            let clamped_fraction = self.clamped_light.map(ClampedLight::fraction);
            return Ok(StillStatus::Done { clamped_fraction });
        }
        self.max_done = self.max_done.max(self.part_done());
        let elapsed_secs = now_secs - started_secs;
        let can_estimate =
            self.max_done > MIN_PART_FOR_ESTIMATE && elapsed_secs > MIN_SECS_FOR_ESTIMATE;
        let remaining_secs =
            can_estimate.then(|| elapsed_secs * (1.0 - self.max_done) / self.max_done);
        Ok(StillStatus::Working { done: self.max_done, remaining_secs })
    }

    fn check_device(&self) -> Result<(), ExportError> {
        if self.pipelines.gpu.faults() > self.faults_before {
            return Err(ExportError::Gpu("the device reported an error".to_owned()));
        }
        Ok(())
    }

    /// Continues on another device, after the last tile whose pixels were read from the old one.
    ///
    /// The overview, whose statistics were in the old device's memory, is drawn again; it comes out the same.
    pub fn resume_on(&mut self, pipelines: &Arc<Pipelines>) {
        self.tile_index = self.finished_tiles();
        self.in_flight = None;
        // Reused samples were in the old device's memory.
        if self.tile_index == 0 {
            self.tiling = self.render_tiling;
        }
        self.pipelines = pipelines.clone();
        self.faults_before = pipelines.gpu.faults();
        let last = self.tiling.count() - 1;
        let region = self.tiling.tile(self.tile_index.min(last)).rendered;
        self.view = self.subject.view(pipelines, region);
        self.view.set_clamped_light(self.clamped_light);
        let is_drawing = self.tile_index <= last;
        let sheet = self.tiling.sheet();
        self.overview = is_drawing.then(|| self.subject.overview(pipelines, &sheet)).flatten();
    }

    /// Number of tiles whose pixels have been read from the device.
    pub fn finished_tiles(&self) -> u32 {
        self.tile_index - u32::from(self.in_flight.is_some())
    }

    /// Waits for the device.
    pub(super) fn wait(&self) {
        self.view.view().wait();
    }

    /// Ends the file and returns the sink.
    ///
    /// # Errors
    /// [`ExportError::Encode`] before [`StillStatus::Done`], [`ExportError::Write`] from the
    /// sink.
    pub fn finish(self) -> Result<W, ExportError> {
        self.encoder.finish()
    }

    /// Renders the overview, then the current tile; starts the readback of a complete tile.
    fn render(&mut self, now_secs: f64) {
        if !self.finish_overview(now_secs)
            || self.tile_index == self.tiling.count()
            || self.view.pump(now_secs)
            || self.in_flight.is_some()
        {
            return;
        }
        let Some(readback) = self.subject.file.read(&self.pipelines.gpu, self.view.view()) else {
            return;
        };
        let tile = self.tiling.tile(self.tile_index);
        let clamped_light = self.view.clamped_light();
        self.in_flight = Some(TileInFlight { tile, readback, clamped_light });
        self.tile_index += 1;
        if self.tile_index < self.tiling.count() {
            // The copy is submitted, so the next tile may overwrite the view.
            self.view.set_region(self.tiling.tile(self.tile_index).rendered);
        }
    }

    /// Renders the overview and lends it to the tiles' view. False while it is incomplete.
    fn finish_overview(&mut self, now_secs: f64) -> bool {
        let Some(overview) = &mut self.overview else { return true };
        if !overview.is_finished() {
            if !overview.pump(now_secs) {
                return false;
            }
            overview.lend_to(self.view.view_mut());
        }
        true
    }

    /// Moves a complete readback into its band, and a full band to the encoder.
    fn collect(&mut self) -> Result<(), ExportError> {
        if !self.filling.is_full
            && let Some(TileInFlight { tile, readback, clamped_light }) = &mut self.in_flight
        {
            let Subject { scene, file, .. } = &self.subject;
            let pixels = readback
                .take(&self.pipelines.gpu, &scene.camera, tile.rendered, *file)
                .map_err(|error| ExportError::Gpu(error.to_string()))?;
            if let Some(pixels) = pixels {
                let [sheet_width, _] = self.tiling.sheet_px();
                self.filling.copy_tile(*tile, sheet_width, &pixels, self.pixel_bytes);
                self.filling.is_full = tile.ends_band;
                self.clamped_light = *clamped_light;
                self.in_flight = None;
            }
        }
        if self.filling.is_full && self.encoding.is_encoded() {
            // The encoded band's memory is reused for the next band.
            let Band { mut bytes, .. } = std::mem::take(&mut self.encoding);
            bytes.clear();
            self.encoding = std::mem::replace(&mut self.filling, Band { bytes, ..Band::default() });
        }
        Ok(())
    }

    /// Encodes at most [`BYTES_PER_STEP`] of the band, but at least one row.
    fn encode(&mut self) -> Result<(), ExportError> {
        if self.encoding.is_encoded() {
            return Ok(());
        }
        let row_bytes = self.tiling.sheet_px()[0] as usize * self.pixel_bytes;
        let rows = (BYTES_PER_STEP / row_bytes).max(1);
        let waiting = &self.encoding.bytes[self.encoding.encoded..];
        let now = &waiting[..waiting.len().min(rows * row_bytes)];
        self.encoder.write_rows(now)?;
        self.encoding.encoded += now.len();
        // A band has at most the picture's rows, so the count fits a u32.
        self.rows_left -= (now.len() / row_bytes) as u32;
        Ok(())
    }

    /// Fraction of all samples that are rendered, including the overview's, 0 to 1.
    fn part_done(&self) -> f64 {
        let is_drawing = self.tile_index < self.tiling.count();
        let of_tile = if is_drawing { self.view.part_done() } else { 0.0 };
        let tiles = f64::from(self.tile_index) + of_tile;
        let of_tiles = (tiles / f64::from(self.tiling.count())).min(1.0);
        let Some(overview) = &self.overview else { return of_tiles };
        let done = self.samples * of_tiles + overview.samples() * overview.part_done();
        done / (self.samples + overview.samples())
    }
}
