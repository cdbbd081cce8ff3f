//! The deep views: anchors that lie on the surface, and orbits that are long enough.

use mandelight::{formula::mandelbulb::Mandelbulb, gpu::device::in_parallel};
use mandelight_test_support::deep::{
    arithmetic::Real,
    orbit::Set,
    rays::{SetView, centre},
    views::{ANCHORS, SMALL, plenty},
};

/// Orbits of points that rays visit leave before they are cut, so that longer ones change nothing.
#[test]
fn plenty_of_steps_is_enough() {
    let views: Vec<_> = ANCHORS.iter().map(|anchor| anchor.scene(anchor.deepest)).collect();
    in_parallel(&views, |scene| {
        let looking = SetView::new(scene, SMALL, plenty(scene));
        for pixel in [[2, 2], [6, 4], [9, 5]] {
            let depth = looking.depth(pixel).expect("a hit");
            let point = looking.at(looking.direction(centre(pixel)), depth);
            let steps = looking.set.estimate(&point, depth).steps;
            assert!(
                steps < plenty(scene),
                "{steps} steps for power {}",
                Mandelbulb::of(&scene.fractal).power
            );
        }
    });
}

#[test]
fn anchors_are_on_the_surface() {
    for anchor in ANCHORS {
        let scene = anchor.scene(anchor.deepest);
        let set = Set::new(&Mandelbulb::of(&scene.fractal), plenty(&scene));
        let distance = set.estimate(&anchor.position.map(Real::parse), anchor.deepest).distance;
        assert!(
            distance < 1e-4 * anchor.deepest,
            "power {} {}: {distance}",
            anchor.power,
            anchor.name
        );
    }
}
