//! The schedule against simulated devices, from fast to 200 times slower, with spikes.

use super::{types::MAX_IN_FLIGHT, *};
use crate::render::integrator::{DIRECT, PATH};

mod arithmetic;
mod cores;
mod hand;
mod jumps;
mod light;
mod paths;
mod sizes;
mod stalls;

const SIZE: [u32; 2] = [1280, 720];
const FRAME_SECS: f64 = 1.0 / 60.0;

/// A simulated GPU that runs submits one after another.
///
/// A submit takes `overhead_ms` and `pixel_ns` for each pixel, every 97th one `spike_ms` more.
struct Device {
    overhead_ms: f64,
    /// Seed of the noise in the overhead, log-normal with a deviation of 1.5; none where steady.
    noise: Option<u32>,
    pixel_ns: f64,
    /// Cost of a pixel of a sparse lattice, in pixels of a dense one.
    sparser: f64,
    /// Cost of a light path, in pixels.
    path: f64,
    /// Cost of shading alone, in shadings of a cheap scene.
    shade: f64,
    /// The lights that have shadow rays.
    casting: u64,
    spike_ms: f64,
    busy_until: f64,
    submits: u32,
    queue: Vec<(Work, f64, f64)>,
    longest_ms: f64,
}

/// Time of a pixel as a part of one that starts at the camera, with three lights: mostly shadow rays.
fn share_of_frame(from: Stage, lights: f64) -> f64 {
    let before = match from {
        Stage::Path | Stage::March => 0.33,
        Stage::Normal => 0.1,
        Stage::Shadow | Stage::Shade => 0.0,
        Stage::Indirect => return 0.3,
    };
    before + 0.22 * lights + 0.01
}

/// The bits of three lights.
const LIGHTS: u64 = 0b111;

fn schedule_of_lights(pace: Pace, size_px: [u32; 2]) -> Schedule {
    let mut schedule = Schedule::new(DIRECT.plan, pace, size_px);
    schedule.set_lights(LIGHTS, LIGHTS);
    schedule
}

impl Device {
    fn new(slowness: f64, spike_ms: f64) -> Self {
        Self::with_overhead(slowness, spike_ms, 0.05)
    }

    fn with_overhead(slowness: f64, spike_ms: f64, overhead_ms: f64) -> Self {
        Self {
            overhead_ms,
            noise: None,
            // 20 ns a pixel: 18 ms for a full 1280x720 frame at slowness 1.
            pixel_ns: 20.0 * slowness,
            sparser: 1.0,
            path: 1.0,
            shade: 1.0,
            casting: u64::MAX,
            spike_ms,
            busy_until: 0.0,
            submits: 0,
            queue: Vec::new(),
            longest_ms: 0.0,
        }
    }

    fn overhead(&mut self) -> f64 {
        let Some(noise) = &mut self.noise else { return self.overhead_ms };
        let mut uniform = || {
            *noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(*noise) / f64::from(u32::MAX)
        };
        // Twelve uniform numbers make one that is nearly normal, of deviation 1.
        let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        self.overhead_ms * (1.5 * normal).exp()
    }

    fn submit(&mut self, work: Work, now: f64) {
        self.submits += 1;
        let pixels = match work {
            Work::Trace(trace) => {
                let whole = f64::from(trace.samples());
                let lights = f64::from((trace.lights & self.casting).count_ones());
                let is_sparse = matches!(trace.points, Points::Level(1..) | Points::Added(_));
                let each = if is_sparse { self.sparser } else { 1.0 };
                let each = match trace.from {
                    Stage::Path => self.path,
                    Stage::Shade => self.shade * each,
                    _ => each,
                };
                whole * each * share_of_frame(trace.from, lights)
            }
            Work::Display(_) => f64::from(SIZE[0] * SIZE[1]) * 0.02,
        };
        let spike = if self.submits.is_multiple_of(97) { self.spike_ms } else { 0.0 };
        let ms = self.overhead() + pixels * self.pixel_ns * 1e-6 + spike;
        if spike == 0.0 {
            self.longest_ms = self.longest_ms.max(ms);
        }
        self.busy_until = self.busy_until.max(now) + ms * 1e-3;
        self.queue.push((work, self.busy_until, ms));
    }

    fn collect(&mut self, schedule: &mut Schedule, now: f64) -> usize {
        let mut displays = 0;
        while self.queue.first().is_some_and(|(_, end, _)| *end <= now) {
            let (work, _, ms) = self.queue.remove(0);
            schedule.collect(&[(Some(work), ms)]);
            displays += usize::from(matches!(work, Work::Display(_)));
        }
        displays
    }
}

/// Runs displayed frames until `stop` says so; returns how many there were.
fn run(
    schedule: &mut Schedule,
    device: &mut Device,
    now: &mut f64,
    most_frames: usize,
    mut each: impl FnMut(&mut Schedule, f64, usize) -> bool,
) -> usize {
    for frame in 0..most_frames {
        let displays = device.collect(schedule, *now);
        if each(schedule, *now, displays) {
            return frame;
        }
        while let Some(work) = schedule.next(*now) {
            device.submit(work, *now);
            assert!(device.queue.len() <= MAX_IN_FLIGHT);
        }
        *now += FRAME_SECS;
    }
    most_frames
}

fn settle(schedule: &mut Schedule, device: &mut Device, now: &mut f64) -> usize {
    run(schedule, device, now, 400_000, |s, now, _| s.status(now).idle)
}

#[test]
fn every_device_finishes_and_then_rests() {
    for slowness in [0.05, 1.0, 20.0, 200.0] {
        for spike_ms in [0.0, 80.0] {
            let mut device = Device::new(slowness, spike_ms);
            let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
            schedule.aim(16.0, 4);
            let mut now = 0.0;
            let frames = settle(&mut schedule, &mut device, &mut now);
            assert!(frames < 400_000, "slowness {slowness} never rests");
            assert_eq!(schedule.status(now).samples_done, 4);
            assert_eq!(schedule.status(now).shown_level, 0);
            let submits = device.submits;
            run(&mut schedule, &mut device, &mut now, 100, |_, _, _| false);
            assert_eq!(device.submits, submits, "work was returned at rest");
        }
    }
}

#[test]
fn reported_progress_only_grows() {
    for has_indirect in [false, true] {
        let mut device = Device::new(200.0, 0.0);
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.set_indirect(has_indirect);
        schedule.aim(16.0, 3);
        let (mut now, mut reported, mut steps_of_first) = (0.0, 0.0, 0);
        run(&mut schedule, &mut device, &mut now, 400_000, |s, now, _| {
            let status = s.status(now);
            let so_far = status.samples_so_far;
            assert!(so_far >= reported, "{reported} became {so_far}");
            let done = status.samples_done as f32;
            assert!(so_far >= done && so_far <= 3.0, "{so_far} with {done} done");
            steps_of_first += u32::from(so_far > reported && so_far < 1.0);
            reported = so_far;
            status.idle
        });
        assert_eq!(reported, 3.0);
        assert!(steps_of_first >= 10, "{steps_of_first} steps of the first sample");
    }
}

#[test]
fn pieces_stay_short() {
    let of_16_ms = [0.05, 1.0, 20.0, 200.0].map(|slowness| (slowness, 16.0));
    for (slowness, budget_ms) in
        of_16_ms.into_iter().chain([(1.0, 4.0), (1.0, 100.0), (20.0, 100.0)])
    {
        let mut device = Device::new(slowness, 0.0);
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.aim(budget_ms, 4);
        settle(&mut schedule, &mut device, &mut 0.0);
        // The display of a whole picture cannot be cut; it is small on anything but the slowest.
        let display_ms = f64::from(SIZE[0] * SIZE[1]) * 0.02 * device.pixel_ns * 1e-6;
        let bound = (1.5 * PIECE_MS).min(budget_ms).max(display_ms + 1.0);
        assert!(device.longest_ms <= bound, "slowness {slowness}: {} ms", device.longest_ms);
    }
}

/// Number of pictures shown while the camera moves in each of 600 displayed frames.
fn pictures_of_a_movement(slowness: f64, spike_ms: f64) -> usize {
    let mut device = Device::new(slowness, spike_ms);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 1);
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    let mut pictures = 0;
    run(&mut schedule, &mut device, &mut now, 600, |s, now, displays| {
        pictures += displays;
        if s.accepts_changes() {
            s.change(Stale::Geometry, true, now);
        }
        false
    });
    pictures
}

#[test]
fn a_movement_is_followed_within_the_budget() {
    for (slowness, spike_ms) in [(0.05, 0.0), (1.0, 40.0), (20.0, 0.0), (20.0, 40.0)] {
        let pictures = pictures_of_a_movement(slowness, spike_ms);
        // A new picture for at least three of four displayed frames.
        assert!(pictures >= 440, "slowness {slowness}: {pictures} pictures in 600 frames");
    }
}

#[test]
fn the_slowest_device_still_shows_movement() {
    let pictures = pictures_of_a_movement(200.0, 0.0);
    assert!(pictures >= 60, "{pictures} pictures in ten seconds");
}

/// Completion-callback latency must not make pieces shrink until most of the time is latency.
#[test]
fn completion_latency_does_not_stall_refinement() {
    for slowness in [1.0, 20.0] {
        let overhead_ms = 60.0;
        let mut device = Device::with_overhead(slowness, 0.0, overhead_ms);
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.aim(16.0, 4);
        let mut now = 0.0;
        settle(&mut schedule, &mut device, &mut now);
        let pixels = f64::from(SIZE[0] * SIZE[1]) * 4.0;
        let ideal_secs = pixels * device.pixel_ns * 1e-9;
        // At most half of the time is latency, apart from the start's small pieces and displays.
        assert!(now < 3.0 * ideal_secs + 8.0, "slowness {slowness}: {now} s for {ideal_secs} s");
    }
}

/// On a busy machine latency is long and varies. Pieces that have shrunk to the smallest size have to
/// grow again.
#[test]
fn varying_latency_does_not_stall_refinement() {
    for seed in 0..200 {
        let mut device = Device::with_overhead(1.0, 0.0, 55.0);
        device.noise = Some(seed);
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.aim(16.0, 1);
        let mut now = 0.0;
        settle(&mut schedule, &mut device, &mut now);
        assert!(now < 100.0, "seed {seed}: {now} s with {} pieces", device.submits);
    }
}

/// The first complete lattice is displayed at once, however long a display takes.
#[test]
fn the_complete_lattice_is_shown_before_more_samples_come() {
    let mut device = Device::with_overhead(20.0, 0.0, 60.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 4);
    let mut now = 0.0;
    run(&mut schedule, &mut device, &mut now, 400_000, |s, now, _| {
        let status = s.status(now);
        assert!(status.samples_done < 2 || status.shown_level == 0);
        status.idle
    });
}

/// Runs to rest and returns all pieces of work.
fn works_until_rest(schedule: &mut Schedule, device: &mut Device, now: &mut f64) -> Vec<Work> {
    let mut works = Vec::new();
    while !schedule.status(*now).idle {
        while let Some(work) = schedule.next(*now) {
            works.push(work);
            device.submit(work, *now);
        }
        *now += FRAME_SECS;
        device.collect(schedule, *now);
    }
    works
}

#[test]
fn tone_edits_only_show() {
    let mut device = Device::new(1.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 3);
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    schedule.change(Stale::Tone, true, now);
    assert_eq!(
        schedule.next(now),
        Some(Work::Display(Display {
            level: 0,
            fill: false,
            from_film: false,
            adapt: 1.0,
            kept: KeptPixels::default(),
            refines: false,
        }))
    );
    assert_eq!(schedule.next(now), None);
}

/// Time of each display until rest, and the part of the way to its goal that exposure moves in it.
fn adaptations(schedule: &mut Schedule, now: &mut f64) -> Vec<(f64, f32)> {
    let mut device = Device::new(1.0, 0.0);
    let mut displays = Vec::new();
    while !schedule.status(*now).idle {
        while let Some(work) = schedule.next(*now) {
            if let Work::Display(Display { adapt, .. }) = work {
                displays.push((*now, adapt));
            }
            device.submit(work, *now);
        }
        *now += FRAME_SECS;
        device.collect(schedule, *now);
    }
    displays
}

#[test]
fn exposure_settles_and_the_view_rests() {
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 3);
    schedule.set_adapting(true);
    let mut now = 0.0;
    let first = adaptations(&mut schedule, &mut now)[0];
    assert_eq!(first.1, 1.0, "the first picture has its own exposure");

    schedule.change(Stale::Light, false, now);
    let changed_at = now;
    let displays = adaptations(&mut schedule, &mut now);
    let (last, before) = displays.split_last().expect("displays");
    assert_eq!(last.1, 1.0, "it ends at its goal");
    assert!(before[0].1 < 1.0, "it does not jump there");
    let half_way = |displays: &[(f64, f32)]| {
        let mut left = 1.0;
        displays
            .iter()
            .find(|(_, adapt)| {
                left *= 1.0 - adapt;
                left < 0.5
            })
            .map(|(at, _)| at - changed_at)
    };
    let secs = half_way(&displays).expect("half of the way");
    assert!((0.05..0.4).contains(&secs), "half of the way after {secs} s");
    // The last step is invisible even after a change by four stops.
    let left: f32 = before.iter().map(|(_, adapt)| 1.0 - adapt).product();
    assert!(4.0 * left < 0.02, "{left} of the way is left to the last step");
    assert!(before.len() > 10, "only {} steps", before.len());
    assert_eq!(schedule.next(now), None);
}

#[test]
fn tone_edits_and_stills_have_their_exposure_at_once() {
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 2);
    schedule.set_adapting(true);
    let mut now = 0.0;
    adaptations(&mut schedule, &mut now);
    schedule.change(Stale::Tone, false, now);
    let displays = adaptations(&mut schedule, &mut now);
    assert_eq!(displays.iter().map(|(_, adapt)| *adapt).collect::<Vec<_>>(), [1.0]);

    let mut still = schedule_of_lights(Pace::Still, SIZE);
    still.aim(16.0, 2);
    still.set_adapting(true);
    let displays = adaptations(&mut still, &mut now);
    assert_eq!(displays.iter().map(|(_, adapt)| *adapt).collect::<Vec<_>>(), [1.0]);
}

#[test]
fn more_samples_go_on_and_fewer_start_again() {
    let mut device = Device::new(1.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 2);
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    schedule.aim(16.0, 4);
    assert!(matches!(
        schedule.next(now),
        Some(Work::Trace(Trace { points: Points::Samples { first: 2, .. }, .. }))
    ));
    settle(&mut schedule, &mut device, &mut now);
    schedule.aim(16.0, 1);
    assert_eq!(schedule.status(now).samples_done, 0);
}

#[test]
fn a_still_goes_straight_to_every_pixel_and_shows_once() {
    let mut device = Device::new(1.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Still, SIZE);
    schedule.aim(16.0, 3);
    let mut now = 0.0;
    let mut displays = 0;
    while !schedule.status(now).idle {
        while let Some(work) = schedule.next(now) {
            match work {
                Work::Display(Display { level, fill, .. }) => {
                    assert_eq!((level, fill), (0, false));
                    displays += 1;
                }
                Work::Trace(trace) => {
                    assert!(matches!(trace.points, Points::Level(0) | Points::Samples { .. }));
                }
            }
            device.submit(work, now);
        }
        now += FRAME_SECS;
        device.collect(&mut schedule, now);
    }
    assert_eq!(displays, 1);
}

#[test]
fn a_region_of_one_pixel_works() {
    let mut device = Device::new(1.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, [1, 1]);
    schedule.aim(16.0, 2);
    let mut now = 0.0;
    assert!(settle(&mut schedule, &mut device, &mut now) < 1000);
}

/// The first picture of a change is of another view than what is shown; all later ones are of the same.
#[test]
fn displays_after_the_first_refine_what_is_shown() {
    let (mut device, mut now) = (Device::new(20.0, 0.0), 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 4);
    for _ in 0..2 {
        schedule.change(Stale::Geometry, false, now);
        let works = works_until_rest(&mut schedule, &mut device, &mut now);
        let refine = works.iter().filter_map(|work| match work {
            Work::Display(display) => Some(display.refines),
            Work::Trace(_) => None,
        });
        let refine: Vec<_> = refine.collect();
        assert!(refine.len() > 2 && !refine[0], "{refine:?}");
        assert!(refine[1..].iter().all(|refines| *refines), "{refine:?}");
    }
}
