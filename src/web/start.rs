//! Start-up, and starting again when the GPU was lost.
//!
//! In: the page's canvas. Out: a running app. Neither eframe nor egui-wgpu handles a lost device,
//! so the device is opened here and watched here, and all that must outlive it is kept in a
//! [`Session`] outside the app.

use std::{
    cell::{Cell, RefCell},
    rc::Rc,
};

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup, WgpuSetupExisting};
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::spawn_local;
use web_sys::HtmlCanvasElement;

use super::{
    app::App, async_compile, device_loss, faults, page, session::Session, test_hook::TestHook,
};
use crate::{gpu::Gpu, render::MAX_REGION_PX};

thread_local! {
    /// The one stage of the page. GPU callbacks must be `Send`, so they cannot carry it.
    static STAGE: RefCell<Option<Rc<Stage>>> = const { RefCell::new(None) };
}

/// What a page has one of, for as long as it lives.
struct Stage {
    canvas: HtmlCanvasElement,
    runner: eframe::WebRunner,
    session: Rc<RefCell<Session>>,
    /// Counts devices, so that a late word about an old one is known as such.
    generation: Cell<u32>,
}

/// Starts the program on `canvas`.
///
/// # Errors
/// A text for people, where there is no usable GPU or the interface cannot be drawn.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement) -> Result<(), JsValue> {
    if STAGE.with(|slot| slot.borrow().is_some()) {
        return Err(JsValue::from_str("Mandelight was started twice on one page."));
    }
    faults::watch();
    let stage = Rc::new(Stage {
        canvas,
        runner: eframe::WebRunner::new(),
        session: Rc::new(RefCell::new(Session::open())),
        generation: Cell::new(0),
    });
    STAGE.with(|slot| slot.replace(Some(stage.clone())));
    limit_canvas(&stage.canvas);
    Session::watch_page(&stage.session);
    raise(&stage).await.map_err(|text| JsValue::from_str(&text))?;
    // So that keys work before the first click; a page that may not take the focus does without.
    let _ = stage.canvas.focus();
    if page::is_test() {
        TestHook::install(&stage.session);
    }
    Ok(())
}

/// Opens a device and runs an app on it.
async fn raise(stage: &Rc<Stage>) -> Result<(), String> {
    let mut gpu = Gpu::open(None).await.map_err(|error| error.to_string())?;
    gpu.async_compile = async_compile::async_compile(&gpu.device);
    let generation = stage.generation.get() + 1;
    stage.generation.set(generation);
    watch_device(&gpu.device, generation);

    let session = stage.session.clone();
    let options = options_on(&gpu);
    stage.session.borrow_mut().gpu = Some(gpu.clone());
    let create = move |context: &eframe::CreationContext<'_>| {
        let app = App::new(context, gpu, session).ok_or("egui runs without wgpu")?;
        Ok(Box::new(app) as Box<dyn eframe::App>)
    };
    stage
        .runner
        .start(stage.canvas.clone(), options, Box::new(create))
        .await
        .map_err(|error| page::describe(&error))
}

fn options_on(gpu: &Gpu) -> eframe::WebOptions {
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

/// Starts again once the device is gone.
fn watch_device(device: &wgpu::Device, generation: u32) {
    device.set_device_lost_callback(move |reason, message| {
        let stage = STAGE.with(|slot| slot.borrow().clone());
        if let Some(stage) = stage.filter(|stage| stage.generation.get() == generation) {
            log::warn!("the GPU was lost ({reason:?}): {message}");
            // In a task of its own: the callback may come from within a frame.
            spawn_local(async move { recover(&stage, &message).await });
        }
    });
}

/// Puts a new device under the session, as often as is wise.
async fn recover(stage: &Rc<Stage>, message: &str) {
    stage.runner.destroy();
    let (was_exporting, caution) = {
        let mut session = stage.session.borrow_mut();
        (session.lose_gpu(), device_loss::note_loss(session.fragment()))
    };
    let Some(caution) = caution else {
        give_up(message);
        return;
    };
    stage.session.borrow_mut().be_cautious(caution);
    if was_exporting {
        stage.session.borrow_mut().complain(
            "The graphics card was lost, and the picture that was being saved with it. A smaller one may go well.",
        );
    }
    if let Err(error) = raise(stage).await {
        give_up(&error);
    }
}

fn give_up(detail: &str) {
    let help = "Your scene is kept. Close other pages that use the graphics card, wait two minutes, then try again.";
    page::notice("The graphics card was lost too often", &format!("{help}\n{detail}"));
}

/// Keeps the canvas within the largest texture: eframe makes its surface as large as the canvas.
fn limit_canvas(canvas: &HtmlCanvasElement) {
    let apply = {
        let style = canvas.style();
        move || {
            let ratio = page::window().map_or(1.0, |window| window.device_pixel_ratio()).max(0.1);
            let limit = format!("{}px", (f64::from(MAX_REGION_PX) / ratio).floor());
            for side in ["max-width", "max-height"] {
                if let Err(error) = style.set_property(side, &limit) {
                    log::warn!("the canvas has no {side}: {}", page::describe(&error));
                }
            }
        }
    };
    apply();
    if let Some(window) = page::window() {
        page::listen(&window, "resize", apply);
    }
}
