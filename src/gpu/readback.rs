//! Non-blocking copies from the GPU: begin a copy, then poll until its bytes arrive.

use std::sync::{
    Arc,
    atomic::{AtomicU8, Ordering},
};

use super::Gpu;

const PENDING: u8 = 0;
const MAPPED: u8 = 1;
const FAILED: u8 = 2;

/// Number of polls before a finished copy that stays unmapped counts as failed.
const MAX_POLLS: u32 = 1_000_000;

/// A failed readback: the device was lost, or mapping the buffer failed.
#[derive(Debug, thiserror::Error)]
#[error("a buffer could not be read back from the GPU")]
pub struct ReadbackError;

/// A pending copy from the GPU to the CPU.
pub struct Readback {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    /// Bytes of a row, without padding.
    row_bytes: usize,
    /// Bytes from the start of a row to the start of the next row.
    stride_bytes: usize,
}

impl Readback {
    /// Starts a copy of an `Rgba8Unorm` texture's upper left `size_px` pixels.
    pub fn texture(gpu: &Gpu, texture: &wgpu::Texture, size_px: [u32; 2]) -> Self {
        let row_bytes = 4 * size_px[0];
        let stride_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = staging(gpu, u64::from(stride_bytes) * u64::from(size_px[1]));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(stride_bytes),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width: size_px[0], height: size_px[1], depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        Self::begin(buffer, row_bytes as usize, stride_bytes as usize)
    }

    /// Starts a copy of a whole storage buffer.
    pub fn buffer(gpu: &Gpu, source: &wgpu::Buffer) -> Self {
        let buffer = staging(gpu, source.size());
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(source, 0, &buffer, 0, source.size());
        gpu.queue.submit([encoder.finish()]);
        let bytes = source.size() as usize;
        Self::begin(buffer, bytes, bytes)
    }

    fn begin(buffer: wgpu::Buffer, row_bytes: usize, stride_bytes: usize) -> Self {
        let state = Arc::new(AtomicU8::new(PENDING));
        let written = state.clone();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            written.store(if result.is_ok() { MAPPED } else { FAILED }, Ordering::Release);
        });
        Self { buffer, state, row_bytes, stride_bytes }
    }

    /// The bytes, without row padding; none until the copy is complete.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn take(&mut self, gpu: &Gpu) -> Result<Option<Vec<u8>>, ReadbackError> {
        gpu.poll();
        match self.state.load(Ordering::Acquire) {
            PENDING => Ok(None),
            MAPPED => {
                let view = self.buffer.get_mapped_range(..).map_err(|_| ReadbackError)?;
                let packed =
                    view.chunks(self.stride_bytes).flat_map(|row| &row[..self.row_bytes]).copied();
                Ok(Some(packed.collect()))
            }
            _ => Err(ReadbackError),
        }
    }

    /// Waits for the bytes. Native only: a browser's main thread must not block.
    ///
    /// # Errors
    ///
    /// See [`ReadbackError`].
    pub fn wait(mut self, gpu: &Gpu) -> Result<Vec<u8>, ReadbackError> {
        gpu.wait();
        // The GPU's work is done, but another thread's poll may not have run the callback yet.
        for _ in 0..MAX_POLLS {
            if let Some(bytes) = self.take(gpu)? {
                return Ok(bytes);
            }
            std::thread::yield_now();
        }
        Err(ReadbackError)
    }
}

fn staging(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
