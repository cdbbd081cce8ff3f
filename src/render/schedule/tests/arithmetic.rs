//! The arithmetic of powers changes from one picture to the next.

use super::*;

/// A dragged power changes from specialized pipelines to those of real powers between two pictures, and
/// a dive to deep ones: the first picture by the new arithmetic is not late.
#[test]
fn the_first_picture_by_a_slower_arithmetic_is_in_time() {
    let (mut device, mut now) = (Device::new(20.0, 0.0), 0.0);
    let mut schedule = schedule_of_lights(Pace::Interactive, SIZE);
    schedule.aim(16.0, 1);
    schedule.change(Stale::Geometry, false, now);
    settle(&mut schedule, &mut device, &mut now);
    let pictures = [
        (Arithmetic::SpecializedPipeline, 1.0),
        (Arithmetic::Real, 4.0),
        (Arithmetic::SpecializedPipeline, 1.0),
        (Arithmetic::Deep, 5.0),
        (Arithmetic::SpecializedPipeline, 1.0),
    ];
    for (arithmetic, factor) in pictures {
        schedule.set_arithmetic(arithmetic);
        schedule.change(Stale::Geometry, true, now);
        let mut ms = 0.0;
        while !schedule.status(now).shown || !schedule.in_flight.is_empty() {
            while let Some(work) = schedule.next(now) {
                let is_trace = matches!(work, Work::Trace(_));
                device.pixel_ns = 20.0 * 20.0 * if is_trace { factor } else { 1.0 };
                device.submit(work, now);
            }
            ms += device.queue.iter().map(|(_, _, ms)| ms).sum::<f64>();
            now = device.busy_until;
            device.collect(&mut schedule, now);
        }
        assert!(ms <= 1.25 * 16.0, "{arithmetic:?}: {ms} ms");
        // The picture is no sparser than it has to be.
        assert!(ms >= 0.3 * 16.0, "{arithmetic:?}: {ms} ms");
    }
}
