//! Asynchronous pipeline compilation by `createComputePipelineAsync`.
//!
//! In: a device and a closure by which wgpu creates one pipeline. Out: that pipeline, compiled while
//! the page goes on; a synchronous compilation blocks the page and the browser's other drawing.
//! wgpu has no call for it and accepts no foreign pipeline. So the device's `createComputePipeline`
//! is overridden during two wgpu calls: `begin` keeps the descriptor, `take` returns the result.

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

const CREATE: &str = "createComputePipeline";
const CREATE_ASYNC: &str = "createComputePipelineAsync";

/// A compiled pipeline that was not taken yet.
struct Compiled {
    device: JsValue,
    label: JsValue,
    pipeline: JsValue,
}

thread_local! {
    static COMPILED: RefCell<Vec<Compiled>> = const { RefCell::new(Vec::new()) };
}

/// The browser's asynchronous compilation; `None` where it has none.
pub fn async_compile(device: &wgpu::Device) -> Option<AsyncCompile> {
    let device = device.as_webgpu()?;
    let method = Reflect::get(device.as_ref(), &CREATE_ASYNC.into()).ok()?;
    let at_once = (processor_cores() / 2).max(1) as usize;
    method.is_function().then_some(AsyncCompile { begin, take, at_once })
}

/// Number of the processor's cores that the browser tells, at least 1.
pub fn processor_cores() -> u32 {
    web_sys::window().map_or(1.0, |window| window.navigator().hardware_concurrency()).max(1.0)
        as u32
}

/// Starts to compile the pipeline that `create` creates. The flag turns true at the end.
fn begin(device: &wgpu::Device, create: &mut dyn FnMut()) -> Arc<AtomicBool> {
    let is_done = Arc::new(AtomicBool::new(false));
    let compilation = device.as_webgpu().and_then(|device| {
        let device: &JsValue = device.as_ref();
        let mut descriptor = JsValue::UNDEFINED;
        with_override(device, create, |requested| {
            descriptor = requested;
            // A placeholder: the caller drops the pipeline that wgpu makes of it.
            Ok(Object::new().into())
        });
        let method: Function = Reflect::get(device, &CREATE_ASYNC.into()).ok()?.dyn_into().ok()?;
        let promise: Promise = method.call1(device, &descriptor).ok()?.dyn_into().ok()?;
        Some((device.clone(), label_of(&descriptor), promise))
    });
    let flag = is_done.clone();
    spawn_local(async move {
        if let Some((device, label, promise)) = compilation {
            // After a failure `take` compiles synchronously, which reports the error.
            if let Ok(pipeline) = JsFuture::from(promise).await {
                COMPILED.with_borrow_mut(|all| all.push(Compiled { device, label, pipeline }));
            }
        }
        flag.store(true, Ordering::Release);
    });
    is_done
}

/// Runs `create` with the compiled pipeline of its label; compiles synchronously without one.
fn take(device: &wgpu::Device, create: &mut dyn FnMut()) {
    let Some(device) = device.as_webgpu() else { return create() };
    let device: &JsValue = device.as_ref();
    with_override(device, create, |descriptor| {
        let label = label_of(&descriptor);
        let compiled = COMPILED.with_borrow_mut(|all| {
            let matches = |one: &Compiled| one.label == label && one.device == *device;
            all.iter().position(matches).map(|at| all.swap_remove(at).pipeline)
        });
        match compiled {
            Some(pipeline) => Ok(pipeline),
            None => {
                let class = Object::get_prototype_of(device);
                let method: Function = Reflect::get(&class, &CREATE.into())?.dyn_into()?;
                method.call1(device, &descriptor)
            }
        }
    });
}

/// Runs `create` while `method` overrides the device's `createComputePipeline`.
fn with_override(
    device: &JsValue,
    create: &mut dyn FnMut(),
    mut method: impl FnMut(JsValue) -> Result<JsValue, JsValue>,
) {
    // JavaScript must not call the closure after this function; by then the override is deleted.
    let method =
        ScopedClosure::<dyn FnMut(JsValue) -> Result<JsValue, JsValue>>::borrow_mut_aborting(
            &mut method,
        );
    // An object's own property hides that of its class. Neither call fails on a device.
    let _ = Reflect::set(device, &CREATE.into(), method.as_js_value());
    create();
    let _ = Reflect::delete_property(device.unchecked_ref::<Object>(), &CREATE.into());
}

fn label_of(descriptor: &JsValue) -> JsValue {
    Reflect::get(descriptor, &"label".into()).unwrap_or_default()
}
