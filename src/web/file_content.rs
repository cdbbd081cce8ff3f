//! What a file holds, and how a worker hands it to the page.
//!
//! In: a decoded file, in the worker's memory. Out: the same in the page's memory. Pixels move as one
//! array, without a copy; texts of scenes are read again by the page, which the worker has proved to end.

use glam::Vec3;
use js_sys::{Array, Float32Array, Object, Reflect};
use wasm_bindgen::{JsCast as _, JsValue};

use crate::scene::{EnvironmentMap, GradientStop, Project, document, gradient::NamedGradient};

/// Channels of a pixel.
const CHANNELS: u32 = 3;

/// What a file holds.
pub enum FileContent {
    /// A scene, perhaps with a camera path.
    Project(Box<Project>),
    /// An environment map.
    EnvironmentMap(EnvironmentMap),
    /// Gradients, at least one.
    Gradients(Vec<NamedGradient>),
}

/// A file's content on its way from the worker: one of three kinds.
pub enum WorkerResult {
    /// A document that can be read.
    Document(String),
    /// An environment map.
    EnvironmentMap(EnvironmentMap),
    /// Gradients, at least one.
    Gradients(Vec<NamedGradient>),
}

impl WorkerResult {
    /// The parcel as an object of JavaScript, with buffers to transfer in its list `buffers`.
    ///
    /// # Errors
    /// A message for the visitor.
    pub fn pack(self) -> Result<Object, String> {
        let object = Object::new();
        let buffers = Array::new();
        match self {
            Self::Document(text) => set(&object, "document", text),
            Self::Gradients(gradients) => {
                let named: Vec<_> = gradients.into_iter().map(|it| (it.name, it.stops)).collect();
                let text = serde_json::to_string(&named).map_err(|error| error.to_string())?;
                set(&object, "gradients", text);
            }
            Self::EnvironmentMap(map) => {
                let [width, height] = map.size_px();
                let pixels = Float32Array::new_with_length(CHANNELS * width * height);
                let rows = map.pixels().chunks_exact(width as usize);
                for (y, row) in (0..).zip(rows) {
                    let row: Vec<f32> = row.iter().flat_map(|pixel| pixel.to_array()).collect();
                    pixels.set(&Float32Array::from(row.as_slice()), y * CHANNELS * width);
                }
                buffers.push(&pixels.buffer());
                set(&object, "name", map.name());
                set(&object, "width", width);
                set(&object, "height", height);
                set(&object, "pixels", pixels);
            }
        }
        set(&object, "buffers", buffers);
        Ok(object)
    }
}

impl FileContent {
    /// The content of a parcel from the worker.
    ///
    /// # Errors
    /// A message for the visitor.
    pub fn unpack(parcel: &JsValue) -> Result<Self, String> {
        let part = |name: &str| {
            let value = Reflect::get(parcel, &JsValue::from_str(name)).ok();
            value.filter(|value| !value.is_undefined())
        };
        let text = |name: &str| part(name)?.as_string();
        if let Some(text) = text("document") {
            let project = document::project_from_json(&text).map_err(|error| error.to_string())?;
            return Ok(Self::Project(Box::new(project)));
        }
        if let Some(text) = text("gradients") {
            let named: Vec<(String, Vec<GradientStop>)> =
                serde_json::from_str(&text).map_err(|error| error.to_string())?;
            let gradients = named.into_iter().map(|(name, stops)| NamedGradient { name, stops });
            return Ok(Self::Gradients(gradients.collect()));
        }
        let side = |name: &str| part(name)?.as_f64().map(|side| side as u32);
        let pixels = part("pixels").and_then(|pixels| pixels.dyn_into::<Float32Array>().ok());
        let map = text("name").zip(side("width").zip(side("height"))).zip(pixels);
        let map = map.and_then(|((name, (width, height)), pixels)| {
            environment_map_of(&name, [width, height], &pixels)
        });
        map.map(Self::EnvironmentMap).ok_or_else(|| "reading it gave no result".to_owned())
    }
}

/// The map of these pixels, copied row by row: memory that the page's module takes once, it keeps.
fn environment_map_of(
    name: &str,
    size_px: [u32; 2],
    pixels: &Float32Array,
) -> Option<EnvironmentMap> {
    let [width, height] = size_px;
    if !EnvironmentMap::has_size(size_px) || pixels.length() != CHANNELS * width * height {
        return None;
    }
    let stride = CHANNELS * width;
    let mut row = vec![0.0; stride as usize];
    let mut read = Vec::with_capacity((width * height) as usize);
    for y in 0..height {
        pixels.subarray(y * stride, (y + 1) * stride).copy_to(&mut row);
        read.extend(row.chunks_exact(CHANNELS as usize).map(Vec3::from_slice));
    }
    EnvironmentMap::from_pixels(name, size_px, read)
}

fn set(object: &Object, name: &str, value: impl Into<JsValue>) {
    // Setting a property of a plain object does not fail.
    let _ = Reflect::set(object, &JsValue::from_str(name), &value.into());
}
