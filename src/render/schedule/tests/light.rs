//! Which rays edits of lights, normals and geometry march, and how fine their lattices are.

use super::*;

/// The jobs of all traces after an edit at rest that sets the shining and the moved lights.
fn jobs_of(stale: Stale, shining: u64, moved: u64) -> Vec<Job> {
    let mut device = Device::new(1.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 1);
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    schedule.set_lights(shining, moved);
    schedule.change(stale, false, now);
    works_until_rest(&mut schedule, &mut device, &mut now)
        .into_iter()
        .filter_map(|work| match work {
            Work::Trace(trace) => Some(trace.job()),
            Work::Display(_) => None,
        })
        .collect()
}

#[test]
fn an_edit_restarts_from_its_own_stage() {
    for (stale, shining, moved, from, lights) in [
        (Stale::Light, LIGHTS, 0, Stage::Shade, 0),
        (Stale::Light, LIGHTS, 0b010, Stage::Shadow, 0b010),
        (Stale::Light, 0b101, 0b010, Stage::Shade, 0),
        (Stale::Light, 0b1111, 0b1000, Stage::Shadow, 0b1000),
        (Stale::Light, 0b1011, 0b1001, Stage::Shadow, 0b1001),
        (Stale::Normals, LIGHTS, 0, Stage::Normal, LIGHTS),
        (Stale::Geometry, 0b011, 0, Stage::March, 0b011),
    ] {
        let jobs = jobs_of(stale, shining, moved);
        let is_right = |job: &Job| *job == Job { from, lights };
        assert!(!jobs.is_empty() && jobs.iter().all(is_right), "{stale:?} {moved}: {jobs:?}");
    }
}

/// An edit that interrupts another keeps everything stale that the first one made stale.
#[test]
fn an_interrupted_edit_stays_stale() {
    let mut device = Device::new(20.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 1);
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    schedule.set_lights(LIGHTS, 0b001);
    schedule.change(Stale::Light, false, now);
    assert!(matches!(schedule.next(now), Some(Work::Trace(Trace { lights: 0b001, .. }))));
    schedule.set_lights(LIGHTS, 0b100);
    schedule.change(Stale::Light, false, now);
    // The second opening may be coarse enough to have the first light's bits.
    assert!(matches!(schedule.next(now), Some(Work::Trace(Trace { from: Stage::Shadow, .. }))));
    let job = Job { from: Stage::Shadow, lights: 0b101 };
    assert_eq!(schedule.progress.job(Points::Level(0)), job);
    schedule.change(Stale::Normals, false, now);
    let half_way = schedule.clone();
    schedule.set_lights(LIGHTS, 0);
    schedule.change(Stale::Light, false, now);
    let job = Job { from: Stage::Normal, lights: LIGHTS };
    assert_eq!(schedule.progress.job(Points::Level(0)), job);
    assert_eq!(half_way.progress.job(Points::Level(0)), job);
}

/// The low cost of lights without shadows is not taken for that of shadow rays.
#[test]
fn lights_without_shadows_are_not_priced_as_rays() {
    let mut device = Device::new(20.0, 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 1);
    schedule.set_casting(0b011);
    device.casting = 0b011;
    let mut now = 0.0;
    settle(&mut schedule, &mut device, &mut now);
    let mut level_of = |moved: u64| {
        schedule.set_lights(LIGHTS, moved);
        schedule.change(Stale::Light, false, now);
        let works = works_until_rest(&mut schedule, &mut device, &mut now);
        works.into_iter().find_map(|work| match work {
            Work::Trace(Trace { points: Points::Level(level), .. }) => Some(level),
            _ => None,
        })
    };
    let before = (0..10).map(|_| level_of(0b001)).last().flatten();
    let others: Vec<_> = (0..10).map(|_| level_of(0b100)).collect();
    // Pictures get finer step by step.
    assert_eq!(others[3..], [Some(0); 7], "{others:?}");
    assert_eq!(level_of(0b010), before);
}

/// Pictures of a moved light are finer than those of a moved camera, and those of a colour finest:
/// every pixel, where shading all of them fits the budget.
#[test]
fn cheaper_edits_have_finer_lattices() {
    let shown_while = |stale: Stale, moved: u64| {
        let mut device = Device::new(20.0, 0.0);
        let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
        schedule.aim(16.0, 1);
        let mut now = 0.0;
        settle(&mut schedule, &mut device, &mut now);
        let mut levels = Vec::new();
        run(&mut schedule, &mut device, &mut now, 120, |s, now, _| {
            if s.accepts_changes() {
                levels.push(s.status(now).shown_level);
                s.set_lights(LIGHTS, moved);
                s.change(stale, true, now);
            }
            false
        });
        levels[levels.len() / 2..].to_vec()
    };
    let camera = shown_while(Stale::Geometry, 0);
    let light = shown_while(Stale::Light, 0b010);
    let color = shown_while(Stale::Light, 0);
    let most = |levels: &[u32]| levels.iter().copied().max().unwrap_or(0);
    let least = |levels: &[u32]| levels.iter().copied().min().unwrap_or(0);
    assert!(most(&light) < least(&camera), "{light:?} {camera:?}");
    assert!(most(&color) < least(&light), "{color:?} {light:?}");
    assert_eq!(most(&color), 0);
}
