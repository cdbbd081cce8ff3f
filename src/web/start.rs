//! Starts the app, and restarts it after the GPU is lost.
//!
//! In: the page's canvas. Out: a running app. Neither eframe nor egui-wgpu handles a lost device,
//! so this file opens the device and handles its loss. A [`Session`] outside the app holds all state
//! that outlives the device.

use std::{
    cell::{Cell, RefCell},
    rc::Rc,
};

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupExisting};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::HtmlCanvasElement;

use super::{
    app::App, async_compile, engine, error_log, exporter::Exporter, page, session::Session,
    test_hook::TestHook,
};
use crate::{
    gpu::{Cpu, Gpu},
    render::MAX_REGION_PX,
};

thread_local! {
    /// The page's only host. GPU callbacks must be `Send`, so they can't own the host.
    static HOST: RefCell<Option<Rc<AppHost>>> = const { RefCell::new(None) };
}

/// The canvas, egui's runner and the session: one of each a page.
struct AppHost {
    canvas: HtmlCanvasElement,
    runner: eframe::WebRunner,
    session: Rc<RefCell<Session>>,
    /// The number of devices so far, by which callbacks of an old device are ignored.
    generation: Cell<u32>,
}

/// Starts the app on `canvas`.
///
/// # Errors
/// A text for the visitor: no usable GPU, or no interface.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement) -> Result<(), JsValue> {
    if HOST.with(|slot| slot.borrow().is_some()) {
        return Err(JsValue::from_str("Mandelight was started twice on one page."));
    }
    error_log::install();
    let host = Rc::new(AppHost {
        canvas,
        runner: eframe::WebRunner::new(),
        session: Rc::new(RefCell::new(Session::open())),
        generation: Cell::new(0),
    });
    HOST.with(|slot| slot.replace(Some(host.clone())));
    limit_canvas(&host.canvas);
    Session::save_on_leave(&host.session);
    start_app(&host, None).await.map_err(|text| JsValue::from_str(&text))?;
    // Makes keys work before the first click; a refusal does no harm.
    let _ = host.canvas.focus();
    if page::is_test() {
        TestHook::install(&host.session);
    }
    Ok(())
}

/// Opens a device and runs an app on it, which continues the exports of `exporter`.
async fn start_app(host: &Rc<AppHost>, exporter: Option<Exporter>) -> Result<(), String> {
    let mut gpu = Gpu::open(None).await.map_err(|error| error.to_string())?;
    gpu.async_compile = async_compile::async_compile(&gpu.device);
    gpu.cpu = gpu.cpu.map(|cpu| Cpu { cores: async_compile::processor_cores(), ..cpu });
    let generation = host.generation.get() + 1;
    host.generation.set(generation);
    restart_on_loss(&gpu.device, generation);

    let session = host.session.clone();
    let options = web_options(&gpu);
    host.session.borrow_mut().gpu = Some(gpu.clone());
    let create = move |context: &eframe::CreationContext<'_>| {
        let app = App::new(context, gpu, session, exporter).ok_or("egui runs without wgpu")?;
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    host.runner
        .start(host.canvas.clone(), options, Box::new(create))
        .await
        .map_err(|error| page::describe(&error))
}

/// eframe's options: draw with `gpu`.
fn web_options(gpu: &Gpu) -> eframe::WebOptions {
    eframe::WebOptions {
        wgpu_options: WgpuConfiguration {
            wgpu_setup: WgpuSetup::Existing(WgpuSetupExisting {
                instance: gpu.instance.clone(),
                adapter: gpu.adapter.clone(),
                device: gpu.device.clone(),
                queue: gpu.queue.clone(),
            }),
            ..Default::default()
        },
        ..Default::default()
    }
}

/// Restarts the app once `device` is lost.
fn restart_on_loss(device: &wgpu::Device, generation: u32) {
    device.set_device_lost_callback(move |reason, message| {
        let host = HOST.with(|slot| slot.borrow().clone());
        if let Some(host) = host.filter(|host| host.generation.get() == generation) {
            log::warn!("the GPU was lost ({reason:?}): {message}");
            // The callback can run within a frame, which the restart would interrupt.
            spawn_local(async move { restart(&host, &message).await });
        }
    });
}

/// Restarts the app on a new device, unless devices were lost too often.
async fn restart(host: &Rc<AppHost>, message: &str) {
    // Exports outlive the device: their files hold the tiles that are finished.
    let exporter = engine::take_exporter();
    host.runner.destroy();
    let is_exporting = exporter.as_ref().is_some_and(Exporter::is_busy);
    let safe_mode = host.session.borrow_mut().note_loss(is_exporting);
    let Some(safe_mode) = safe_mode else {
        give_up(message);
        return;
    };
    host.session.borrow_mut().enter_safe_mode(safe_mode);
    if let Err(error) = start_app(host, exporter).await {
        give_up(&error);
    }
}

/// Shows a final notice; the visitor can only reload the page.
fn give_up(detail: &str) {
    let help = "Your scene is saved. Close other pages that use the graphics card, wait two minutes, then try again.";
    page::show_notice(
        "The graphics card stopped and could not be restarted",
        &format!("{help}\n\n{detail}"),
    );
}

/// Limits the canvas to the largest texture: eframe's surface has the canvas's size.
fn limit_canvas(canvas: &HtmlCanvasElement) {
    let apply = {
        let style = canvas.style();
        move || {
            let ratio = page::window().map_or(1.0, |window| window.device_pixel_ratio()).max(0.1);
            let limit = format!("{}px", (f64::from(MAX_REGION_PX) / ratio).floor());
            for side in ["max-width", "max-height"] {
                if let Err(error) = style.set_property(side, &limit) {
                    log::warn!("cannot set the canvas's {side}: {}", page::describe(&error));
                }
            }
        }
    };
    apply();
    if let Some(window) = page::window() {
        page::listen(&window, "resize", apply);
    }
}
