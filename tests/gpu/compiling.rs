//! When pipelines are compiled: some at the start, and then none that was not announced.

use std::{
    collections::BTreeSet,
    time::{Duration, Instant},
};

use mandelight::{
    formula::FormulaRef,
    render::{
        Activity, Pace, Pipelines, Region, View, pipeline_set::INDIRECT, pipelines::PipelineVariant,
    },
    scene::{IndirectKind, IntegratorKind, MediumKind, Scene, SurfaceModel},
};
use mandelight_test_support::{
    device::{fresh_pipelines, pipelines},
    patience::HANG,
    view::sampled,
};

const SIZE: [u32; 2] = [48, 32];
/// Pipelines that are compiled at once while pictures are drawn without them.
const AT_ONCE: usize = 3;

/// A platform whose asynchronous compilation takes as long as a test wants.
mod async_compile {
    use std::{
        cell::RefCell,
        sync::{
            Arc,
            atomic::{AtomicBool, Ordering},
        },
    };

    use mandelight::{gpu::AsyncCompile, render::Pipelines};
    use mandelight_test_support::device::fresh_gpu;

    use super::AT_ONCE;

    thread_local! {
        /// What is under way; a test has a thread of its own.
        static UNDER_WAY: RefCell<Vec<Arc<AtomicBool>>> = const { RefCell::new(Vec::new()) };
    }

    /// Pipelines of a device of the platform.
    pub fn pipelines() -> Arc<Pipelines> {
        let mut gpu = fresh_gpu();
        gpu.async_compile = Some(AsyncCompile { begin, take, at_once: AT_ONCE });
        Pipelines::new(&gpu)
    }

    fn begin(_: &wgpu::Device, ask: &mut dyn FnMut()) -> Arc<AtomicBool> {
        ask();
        let is_over = Arc::new(AtomicBool::new(false));
        UNDER_WAY.with_borrow_mut(|all| all.push(is_over.clone()));
        is_over
    }

    fn take(_: &wgpu::Device, ask: &mut dyn FnMut()) {
        ask();
    }

    /// How much is under way.
    pub fn under_way() -> usize {
        UNDER_WAY.with_borrow(Vec::len)
    }

    /// All that is under way is ready. How much it was.
    pub fn finish() -> usize {
        let flags = UNDER_WAY.take();
        flags.iter().for_each(|flag| flag.store(true, Ordering::Release));
        flags.len()
    }
}

/// A live view whose every pump is watched.
struct Watched {
    pipelines: std::sync::Arc<Pipelines>,
    view: View,
    start: Instant,
    /// What was announced, one after the other.
    announced: Vec<String>,
}

impl Watched {
    fn new() -> Self {
        Self::with(fresh_pipelines())
    }

    fn with(pipelines: std::sync::Arc<Pipelines>) -> Self {
        let view = View::new(&pipelines, Region::whole(SIZE), Pace::Interactive);
        Self { pipelines, view, start: Instant::now(), announced: Vec::new() }
    }

    /// Pumps once. No pipeline is made but where the report of the pump before says so, and, where
    /// that holds others up, one at most, while the picture stays.
    fn pump(&mut self) -> bool {
        let activity = self.view.report().activity;
        let is_async = self.pipelines.gpu.async_compile.is_some();
        let dispatches = self.view.dispatches().clone();
        let made = self.pipelines.made();
        let is_busy = self.view.pump(self.start.elapsed().as_secs_f64());
        let new = self.pipelines.made().split_off(made.len());
        match &activity {
            Activity::Compiling(_) => assert!(new.len() <= 1 || is_async, "{new:?} at once"),
            other => assert!(new.is_empty(), "{new:?} compiled while {other:?}"),
        }
        if let Activity::Compiling(what) = self.view.report().activity {
            if self.announced.last() != Some(&what) {
                self.announced.push(what);
            }
            if !new.is_empty() {
                assert_eq!(self.view.dispatches(), &dispatches);
            }
        }
        std::thread::sleep(Duration::from_millis(1));
        is_busy
    }

    /// Pumps until the view rests, and for a while longer.
    fn settle(&mut self) {
        let mut rest = Instant::now();
        while rest.elapsed() < Duration::from_millis(400) {
            if self.pump() {
                rest = Instant::now();
            }
            assert!(self.start.elapsed() < HANG, "{:?}", self.view.report());
        }
    }

    /// Pumps until `parts` pipelines are under way, and `what` was announced last.
    fn pump_until(&mut self, what: &str, parts: usize) {
        let start = Instant::now();
        while async_compile::under_way() < parts {
            self.pump();
            assert!(start.elapsed() < HANG, "{what}: {:?}", self.view.report());
        }
        assert_eq!(self.announced.last().map(String::as_str), Some(what));
    }

    fn show(&mut self, scene: &Scene) {
        self.view.set_scene(scene, false);
        self.settle();
        assert_eq!(self.pipelines.gpu.faults(), 0);
    }
}

/// Whatever is switched on or changed, in the order in which the panels have it.
#[test]
fn nothing_is_compiled_unannounced() {
    let mut watched = Watched::new();
    let mut scene = sampled(Scene::default(), 1);
    let first = watched.pipelines.made();
    let general = [
        "camera_rays",
        "camera_cone",
        "march",
        "compact_hits",
        "normal",
        "shadow_cone",
        "shadow",
        "shade",
        "color_histogram",
        "tonemap_sparse",
        "upsample",
        "fill",
        "tone",
    ];
    assert_eq!(first, general);
    watched.show(&scene);
    assert_eq!(watched.announced, ["power 8", "light", "tone mapping"]);
    type Edit = fn(&mut Scene);
    let edits: [(Edit, &[&str]); 15] = [
        (|scene| _ = scene.fractal.set("power", 4.5), &[]),
        (|scene| _ = scene.fractal.set("power", 3.0), &["power 3"]),
        (|scene| scene.lights.environment[0].muted = true, &[]),
        (|scene| scene.indirect.kind = IndirectKind::Horizon, &["indirect light"]),
        (|scene| scene.indirect.kind = IndirectKind::Uniform, &[]),
        (|scene| scene.bloom.strength = 0.4, &["exposure and bloom", "tone mapping"]),
        (|scene| scene.tone.auto_exposure = true, &[]),
        (|scene| _ = scene.fractal.set("power", 8.0), &[]),
        (|scene| scene.surface.model = SurfaceModel::Physical, &["light"]),
        (|scene| scene.integrator.kind = IntegratorKind::Path, &["path tracing", "light paths"]),
        (|scene| scene.integrator.bounces = 2, &[]),
        (|scene| scene.fog.density = 0.5, &["light paths", "light"]),
        (|scene| scene.integrator.denoise = true, &["denoising"]),
        (
            |scene| scene.medium.kind = MediumKind::Set,
            &["powers", "power 8", "light paths", "light"],
        ),
        (|scene| scene.medium.kind = MediumKind::Iterations, &[]),
    ];
    for (edit, expected) in edits {
        watched.announced.clear();
        edit(&mut scene);
        watched.show(&scene);
        assert_eq!(watched.announced, expected);
    }
    watched.announced.clear();
    watched.view.watch_histogram(true);
    watched.settle();
    assert_eq!(watched.announced, [""; 0]);

    let made = watched.pipelines.made();
    let mut all: BTreeSet<String> = first.into_iter().collect();
    for power in [8, 3] {
        for pass in ["camera_cone", "march", "shadow_cone", "shadow"] {
            all.insert(format!("{pass}, POWER {power}, CHECKS_HITS {}", u32::from(power < 4)));
        }
        let checks = u32::from(power < 4);
        all.insert(format!("normal, POWER {power}, CHECKS_HITS {checks}, NORMALS 5"));
    }
    for (fog, model) in [(0, 0), (0, 1), (1, 1), (1, 0)] {
        let light = format!("HAS_FOG {fog}, SURFACE_MODEL {model}");
        let shade = format!("shade, {light}, HAS_ENVIRONMENT_MAP 0, TRANSPARENT 0");
        all.extend([0, 1].map(|single| format!("{shade}, SINGLE {single}")));
        if model == 1 {
            all.insert(format!("scatter, {light}, HAS_MEDIUM 0"));
        } else if fog == 1 {
            all.insert(format!("scatter, {light}, HAS_MEDIUM 1"));
        }
    }
    for (bloom, sparse) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        all.insert(format!("tone, CURVE 1, BLOOM {bloom}, ANAGLYPH 0, SPARSE {sparse}"));
    }
    all.extend(
        ["indirect", "mean", "reduce", "expose", "histogram", "bloom", "blur"].map(str::to_owned),
    );
    all.extend(["scatter", "film_paths", "assess_noise"].map(str::to_owned));
    all.extend(["denoise_input", "denoise"].map(str::to_owned));
    all.extend(["track", "track, POWER 8, CHECKS_HITS 0"].map(str::to_owned));
    assert_eq!(made.len(), all.len(), "each once: {made:?}");
    assert_eq!(BTreeSet::from_iter(made), all);
}

/// The histogram alone needs pipelines too.
#[test]
fn a_first_look_at_the_histogram_is_announced() {
    let mut watched = Watched::new();
    watched.show(&sampled(Scene::default(), 1));
    watched.announced.clear();
    watched.view.watch_histogram(true);
    watched.settle();
    assert_eq!(watched.announced, ["exposure and bloom"]);
    assert!(watched.view.report().histogram.is_some());
}

/// A drag of the power passes through many, and stops none of them.
#[test]
fn a_drag_of_the_power_compiles_nothing() {
    let mut watched = Watched::new();
    let mut scene = sampled(Scene::default(), 1);
    watched.show(&scene);
    let made = watched.pipelines.made();
    for power in [7.0, 6.0, 5.0, 4.0, 3.0, 2.0] {
        scene.fractal.set("power", power);
        watched.view.set_scene(&scene, true);
        for _ in 0..10 {
            watched.pump();
        }
    }
    assert_eq!(watched.pipelines.made(), made);
    watched.show(&scene);
    assert_eq!(watched.pipelines.made().len(), made.len() + 5);
}

/// Where pipelines are compiled asynchronously, the view goes on meanwhile, and is ready for all that may
/// come once it has nothing else to do.
#[test]
fn asynchronous_compilation_blocks_no_frame() {
    let mut watched = Watched::with(async_compile::pipelines());
    let made = watched.pipelines.made();
    let mut scene = sampled(Scene::default(), 1);
    // Compiles the next pipelines that are announced, no more than allowed at once.
    let compile = |watched: &mut Watched, what: &str, parts: usize| {
        for begun in (0..parts).step_by(AT_ONCE) {
            watched.pump_until(what, AT_ONCE.min(parts - begun));
            for _ in 0..3 {
                watched.pump();
            }
            assert_eq!(async_compile::finish(), AT_ONCE.min(parts - begun));
        }
    };
    watched.view.set_scene(&scene, false);
    watched.pump_until("power 8", AT_ONCE);
    // An edit is drawn while the power is on its way.
    let before = watched.view.report().pictures;
    scene.lights.environment[0].intensity = 1.0;
    watched.view.set_scene(&scene, false);
    while watched.view.report().pictures == before {
        watched.pump();
    }
    assert_eq!(watched.pipelines.made(), made);
    assert_eq!(async_compile::finish(), AT_ONCE);
    // The fourth pipeline of power 8, then that of its normals.
    for (what, parts) in [("power 8", 1), ("power 8", 1), ("light", 2), ("tone mapping", 2)] {
        compile(&mut watched, what, parts);
    }
    watched.pump_until("indirect light", 1);
    assert_eq!(watched.pipelines.made().len(), made.len() + 9);
    assert_eq!(async_compile::finish(), 1);
    compile(&mut watched, "exposure and bloom", 6);
    watched.settle();
    assert_eq!(watched.pipelines.made().len(), made.len() + 16);
    watched.announced.clear();
    scene.indirect.kind = IndirectKind::Horizon;
    scene.tone.auto_exposure = true;
    watched.show(&scene);
    assert_eq!(watched.announced, [""; 0]);
}

/// Whatever is needed meanwhile, and however many views need it.
#[test]
fn a_pipeline_is_compiled_asynchronously_once() {
    let pipelines = async_compile::pipelines();
    let made = pipelines.made().len();
    let mut scene = sampled(Scene::default(), 1);
    let mut views = [0, 1].map(|_| Watched::with(pipelines.clone()));
    for watched in &mut views {
        watched.view.set_scene(&scene, false);
    }
    views[0].pump_until("power 8", AT_ONCE);
    // The other view waits for the same pipelines.
    while views[1].announced.is_empty() {
        views[1].pump();
    }
    for _ in 0..400 {
        views[1].pump();
    }
    assert_eq!(async_compile::under_way(), AT_ONCE);
    // A need that cannot wait comes between, without a limit.
    scene.indirect.kind = IndirectKind::Horizon;
    views[0].view.set_scene(&scene, false);
    views[0].pump_until("indirect light", AT_ONCE + 1);
    async_compile::finish();
    let mut begun = AT_ONCE + 1;
    for watched in &mut views {
        let start = Instant::now();
        let mut rest = start;
        while rest.elapsed() < Duration::from_millis(400) {
            if watched.pump() {
                rest = Instant::now();
            }
            begun += async_compile::finish();
            assert!(start.elapsed() < HANG, "{:?}", watched.view.report());
        }
    }
    let made = pipelines.made().split_off(made);
    assert_eq!(made.len(), begun, "{made:?}");
    assert_eq!(BTreeSet::from_iter(&made).len(), made.len(), "{made:?}");
}

/// A still has nobody to tell, and waits for nothing.
#[test]
fn a_still_compiles_at_once() {
    let pipelines = fresh_pipelines();
    let mut scene = sampled(Scene::default(), 1);
    scene.bloom.strength = 0.4;
    let mut view = View::new(&pipelines, Region::whole(SIZE), Pace::Still);
    view.set_scene(&scene, false);
    view.pump(0.0);
    assert_eq!(pipelines.made().len(), 13 + 5 + 4 + 6);
    assert_eq!(view.report().activity, Activity::Refining);
}

/// Pipelines that one view prepared are there for all others of the device.
#[test]
fn what_is_ready_is_not_announced_again() {
    pipelines().prepare(&PipelineVariant::general_of(&INDIRECT, FormulaRef::default()));
    let mut scene = sampled(Scene::default(), 1);
    scene.indirect.kind = IndirectKind::Uniform;
    let mut view = View::new(pipelines(), Region::whole(SIZE), Pace::Interactive);
    view.set_scene(&scene, false);
    view.pump(0.0);
    assert_eq!(view.report().activity, Activity::Refining);
}
