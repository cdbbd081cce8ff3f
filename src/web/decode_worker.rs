//! Decoding of a file from outside, in a worker with an instance and a memory of its own.
//!
//! In: a file's name and the file, read by ranges. Out: what it holds. Whatever happens here, a panic, a
//! lack of memory or a loop without end, happens to this worker only: `www/decoder.js` ends it.

use std::{
    alloc::System,
    hint::black_box,
    io::{self, Read, Seek, SeekFrom},
};

use cap::Cap;
use js_sys::Uint8Array;
use wasm_bindgen::prelude::*;
use web_sys::{Blob, FileReaderSync};

use super::{file_content::WorkerResult, page::describe};
use crate::{
    export,
    scene::{document, environment_map, gradient},
};

/// Most memory that the decoding of a file may take, in bytes.
///
/// No file is known to take as much: a reader takes at most 64 MiB, and the buffer of the largest document 32 MiB.
pub const MAX_MEMORY_BYTES: usize = 128 << 20;

/// Bytes of a file in memory at a time.
const CHUNK_BYTES: u64 = 1 << 20;

/// The page's allocator, without a limit there; the worker sets one.
#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Decodes `file`, in a worker. `fault` is for tests: the worker then fails as this word says.
///
/// # Errors
/// A text about the file. An error of the program is thrown as an `Error`, or traps.
#[wasm_bindgen(js_name = decodeFile)]
pub fn decode_file(name: &str, file: &Blob, fault: Option<String>) -> Result<JsValue, JsValue> {
    // A panic can't be caught here, but its message can be thrown on its way.
    std::panic::set_hook(Box::new(|info| wasm_bindgen::throw_str(&info.to_string())));
    // The limit is above what a new instance has allocated.
    let _ = ALLOCATOR.set_limit(MAX_MEMORY_BYTES);
    match fault.as_deref() {
        Some("panic") => panic!("a panic of the test"),
        Some("loop") => loop {
            std::hint::spin_loop();
        },
        Some("memory") => {
            let mut blocks = Vec::new();
            loop {
                blocks.push(black_box(vec![1_u8; CHUNK_BYTES as usize]));
            }
        }
        _ => {}
    }
    let parcel = BlobReader::new(file)
        .map_err(|error| error.to_string())
        .and_then(|mut file| decode(name, &mut file))
        .and_then(WorkerResult::pack);
    parcel.map(JsValue::from).map_err(|reason| JsValue::from_str(&reason))
}

/// What `file` holds: a scene, a picture that contains one, an environment map, or gradients.
fn decode(name: &str, file: &mut (impl Read + Seek)) -> Result<WorkerResult, String> {
    let mut start = Vec::new();
    let unreadable = |error: io::Error| error.to_string();
    file.by_ref().take(16).read_to_end(&mut start).map_err(unreadable)?;
    file.rewind().map_err(unreadable)?;
    // An OpenEXR picture saved by Mandelight is also a valid environment map: its scene wins.
    if export::is_exr(&start)
        && let Ok(Some(text)) = export::exr_scene_text(&mut *file)
    {
        return read_document(text);
    }
    if environment_map::is_environment_map(&start) {
        let map = environment_map::decode::decode_file(name, file);
        return map.map(WorkerResult::EnvironmentMap).map_err(|error| error.to_string());
    }
    if let Some((stem, ending)) = name.rsplit_once('.')
        && gradient::ENDINGS.contains(&ending.to_ascii_lowercase().as_str())
    {
        let bytes = read_start(file, gradient::MAX_FILE_BYTES).map_err(unreadable)?;
        let found = gradient::read(&bytes, stem);
        return found.map(WorkerResult::Gradients).map_err(|error| error.to_string());
    }
    // A picture's scene precedes its pixels.
    let bytes = read_start(file, document::MAX_BYTES).map_err(unreadable)?;
    let text = match export::picture_scene_text(&bytes) {
        Some(text) => {
            text?.ok_or("the picture contains no scene; only pictures saved by Mandelight do")?
        }
        None => String::from_utf8(bytes).map_err(|_| {
            "the file is neither a scene nor a picture that Mandelight can read".to_owned()
        })?,
    };
    read_document(text)
}

/// The first bytes of `file`: one over `most`, so that a reader refuses a longer file.
fn read_start(file: &mut impl Read, most: usize) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A document, once it has been read.
fn read_document(text: String) -> Result<WorkerResult, String> {
    match document::project_from_json(&text) {
        Ok(_) => Ok(WorkerResult::Document(text)),
        Err(error) => Err(error.to_string()),
    }
}

/// A file of the browser, read by ranges, which a worker may wait for.
struct BlobReader {
    blob: Blob,
    reader: FileReaderSync,
    length: u64,
    position: u64,
    /// Bytes of the file from `chunk_start` on.
    chunk: Vec<u8>,
    chunk_start: u64,
}

impl BlobReader {
    fn new(blob: &Blob) -> io::Result<Self> {
        Ok(Self {
            blob: blob.clone(),
            reader: FileReaderSync::new().map_err(io_error)?,
            length: blob.size() as u64,
            position: 0,
            chunk: Vec::new(),
            chunk_start: 0,
        })
    }

    /// The bytes in memory from the position on.
    fn loaded(&self) -> &[u8] {
        let from = self.position.checked_sub(self.chunk_start).map(|from| from as usize);
        from.and_then(|from| self.chunk.get(from..)).unwrap_or_default()
    }
}

impl Read for BlobReader {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.loaded().is_empty() && self.position < self.length {
            let end = self.length.min(self.position + CHUNK_BYTES);
            let part = self.blob.slice_with_f64_and_f64(self.position as f64, end as f64);
            let bytes = part.and_then(|part| self.reader.read_as_array_buffer(&part));
            self.chunk = Uint8Array::new(&bytes.map_err(io_error)?.into()).to_vec();
            self.chunk_start = self.position;
        }
        let read = self.loaded().read(buffer)?;
        self.position += read as u64;
        Ok(read)
    }
}

impl Seek for BlobReader {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let position = match to {
            SeekFrom::Start(position) => Some(position),
            SeekFrom::End(offset) => self.length.checked_add_signed(offset),
            SeekFrom::Current(offset) => self.position.checked_add_signed(offset),
        };
        self.position = position.ok_or(io::ErrorKind::InvalidInput)?;
        Ok(self.position)
    }
}

fn io_error(error: JsValue) -> io::Error {
    io::Error::other(describe(&error))
}
