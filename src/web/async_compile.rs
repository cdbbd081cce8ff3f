//! Asynchronous pipeline compilation by `createComputePipelineAsync`.
//!
//! wgpu has no call for it, and takes no pipeline that others made. So the device's own
//! `createComputePipeline` is stood in for while wgpu asks once: first by something that only
//! keeps the descriptor, later by something that hands out what the browser made of it. Between
//! these the page, its other pictures and everything else that the browser draws go on; a pipeline
//! that is asked for in the plain way holds all of them up.

use std::{
    cell::RefCell,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use js_sys::{Function, Object, Promise, Reflect};
use wasm_bindgen::{JsCast, prelude::*};
use wasm_bindgen_futures::{JsFuture, spawn_local};

use crate::gpu::AsyncCompile;

const PLAIN: &str = "createComputePipeline";
const ASIDE: &str = "createComputePipelineAsync";

/// A pipeline that waits to be taken.
struct Made {
    device: JsValue,
    label: JsValue,
    pipeline: JsValue,
}

thread_local! {
    static MADE: RefCell<Vec<Made>> = const { RefCell::new(Vec::new()) };
}

/// The browser's asynchronous compilation; none where it has none.
pub fn async_compile(device: &wgpu::Device) -> Option<AsyncCompile> {
    let device = device.as_webgpu()?;
    let call = Reflect::get(device.as_ref(), &ASIDE.into()).ok()?;
    call.is_function().then_some(AsyncCompile { begin, take })
}

fn begin(device: &wgpu::Device, ask: &mut dyn FnMut()) -> Arc<AtomicBool> {
    let is_over = Arc::new(AtomicBool::new(false));
    let asked = device.as_webgpu().and_then(|device| {
        let device: &JsValue = device.as_ref();
        let mut descriptor = JsValue::UNDEFINED;
        stand_in(device, ask, |asked| {
            descriptor = asked;
            // Nobody uses it.
            Ok(Object::new().into())
        });
        let call: Function = Reflect::get(device, &ASIDE.into()).ok()?.dyn_into().ok()?;
        let promise: Promise = call.call1(device, &descriptor).ok()?.dyn_into().ok()?;
        Some((device.clone(), label_of(&descriptor), promise))
    });
    let tell = is_over.clone();
    spawn_local(async move {
        if let Some((device, label, promise)) = asked {
            // What failed is asked for again in the plain way, which tells of the error.
            if let Ok(pipeline) = JsFuture::from(promise).await {
                MADE.with_borrow_mut(|made| made.push(Made { device, label, pipeline }));
            }
        }
        tell.store(true, Ordering::Release);
    });
    is_over
}

fn take(device: &wgpu::Device, ask: &mut dyn FnMut()) {
    let Some(device) = device.as_webgpu() else { return ask() };
    let device: &JsValue = device.as_ref();
    stand_in(device, ask, |descriptor| {
        let label = label_of(&descriptor);
        let found = MADE.with_borrow_mut(|made| {
            let is_it = |made: &Made| made.label == label && made.device == *device;
            made.iter().position(is_it).map(|at| made.swap_remove(at).pipeline)
        });
        match found {
            Some(pipeline) => Ok(pipeline),
            None => {
                let class = Object::get_prototype_of(device);
                let plain: Function = Reflect::get(&class, &PLAIN.into())?.dyn_into()?;
                plain.call1(device, &descriptor)
            }
        }
    });
}

/// Has `answer` stand in for the device's own method while `ask` runs.
fn stand_in(
    device: &JsValue,
    ask: &mut dyn FnMut(),
    mut answer: impl FnMut(JsValue) -> Result<JsValue, JsValue>,
) {
    // The closure does not outlive this function: it is invalid to JavaScript once dropped, and
    // the property that held it is gone by then.
    let answer =
        ScopedClosure::<dyn FnMut(JsValue) -> Result<JsValue, JsValue>>::borrow_mut_aborting(
            &mut answer,
        );
    // A property of the object's own comes before its class's; setting and deleting one does not fail.
    let _ = Reflect::set(device, &PLAIN.into(), answer.as_js_value());
    ask();
    let _ = Reflect::delete_property(device.unchecked_ref::<Object>(), &PLAIN.into());
}

fn label_of(descriptor: &JsValue) -> JsValue {
    Reflect::get(descriptor, &"label".into()).unwrap_or_default()
}
