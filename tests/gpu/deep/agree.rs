//! The renderer's views against the march.

use mandelight::{
    formula::mandelbulb::deep,
    gpu::device::in_parallel,
    render::{Region, gbuffer::Samples, space::RenderSpace},
    scene::Scene,
};
use mandelight_test_support::{
    deep::{
        rays::{SetView, Size, centre, pixels},
        views::{self, ANCHORS, Anchor, size},
    },
    view::single_samples,
};

/// One of so many pixels is compared; of pictures 24 high, still 173. Where these do not agree well
/// enough, of which one may be more than its share, all pixels decide.
const EVERY: usize = 5;

/// The scales of sets that are only looked at here and there.
const OTHERS: [f64; 2] = [1e-6, 1e-13];

/// Less than a decade below the last plain views.
const SHALLOW: f64 = 3e-5;

/// How much shorter the march's steps are where it and a picture are apart.
const FINER: f64 = 0.25;

/// What a picture and the march say of the same pixels.
#[derive(Default)]
struct Comparison {
    /// Parts of all pixels: hit by the march, and hit by one of the two only.
    hit: f64,
    differ: f64,
    /// Part of those hit by both whose depths are two footprints apart or more.
    apart: f64,
    /// Mean angle between normals at the picture's own depths, degrees.
    normal_deg: f64,
}

fn compare(scene: &Scene, size: Size, samples: &Samples, every: usize) -> Comparison {
    let looking = SetView::exact(scene, size, views::plenty(scene));
    let pixels: Vec<_> = pixels(size).step_by(every).collect();
    let both = in_parallel(&pixels, |&(pixel, index): &([u32; 2], usize)| {
        let found = looking.hit_at(samples.depth[index]);
        let mut expected = looking.depth(pixel);
        // Where the two are apart, sheets thinner than its own steps are what the march may have passed.
        let is_apart = |(a, b): (f64, f64)| (a - b).abs() > 2.0 * looking.footprint(b);
        if found.is_some() != expected.is_some() || found.zip(expected).is_some_and(is_apart) {
            expected = looking.march(looking.direction(centre(pixel)), |e| FINER * e.step);
        }
        let angle = found.zip(expected).map(|(found, _)| {
            let normal = looking.normal(pixel, found);
            let cosine = normal.dot(samples.normal[index].as_dvec3());
            cosine.clamp(-1.0, 1.0).acos().to_degrees()
        });
        (found, expected, angle)
    });
    let part = |count: usize| count as f64 / pixels.len() as f64;
    let by_both: Vec<_> = both
        .iter()
        .filter_map(|&(found, expected, angle)| Some((found?, expected?, angle?)))
        .collect();
    let far_apart = |&&(found, expected, _): &&(f64, f64, f64)| {
        (found - expected).abs() > 2.0 * looking.footprint(expected)
    };
    let count = by_both.len().max(1) as f64;
    Comparison {
        hit: part(both.iter().filter(|(_, expected, _)| expected.is_some()).count()),
        differ: part(both.iter().filter(|(a, b, _)| a.is_some() != b.is_some()).count()),
        apart: by_both.iter().filter(far_apart).count() as f64 / count,
        normal_deg: by_both.iter().map(|(_, _, angle)| angle).sum::<f64>() / count,
    }
}

/// Holds a view to the march; on a rough surface depths alone.
fn view_agrees(scene: &Scene, size: Size, is_rough: bool, view: &str) {
    let samples = single_samples(scene, size);
    let mut comparison = compare(scene, size, &samples, EVERY);
    if comparison.differ > 0.005 || comparison.apart > 0.01 {
        comparison = compare(scene, size, &samples, 1);
    }
    let Comparison { hit, differ, apart, normal_deg } = comparison;
    println!("{view}: {hit:.3} hit, {differ:.4} differ, {apart:.4} apart, {normal_deg:.4} degrees");
    assert!(hit >= 0.3, "{view}: {hit} of the pixels are hit");
    assert!(differ <= 0.005, "{view}: {differ} of the pixels are hit by one alone");
    assert!(apart <= 0.01, "{view}: {apart} of the depths are two footprints apart");
    // Normals at grazing angles that face away for one of the two only are those of the footprint there.
    let are_right = is_rough || normal_deg < 0.75;
    assert!(are_right, "{view}: normals differ by {normal_deg} degrees");
}

fn views_agree(power: f64, julia: bool) {
    for anchor in ANCHORS.iter().filter(|anchor| (anchor.power, anchor.julia) == (power, julia)) {
        for scale in anchor.scales() {
            let view = format!("power {power} {} at {scale:e}", anchor.name);
            let scene = anchor.scene(scale);
            view_agrees(&scene, size(scale), anchor.is_rough(), &view);
        }
    }
}

/// Where an f32 falls short by a digit or two. Frames that turn about the axis are for deeper views.
#[test]
fn views_just_below_plain_ones_agree_with_the_march() {
    for anchor in ANCHORS.iter().filter(|anchor| anchor.deepest < SHALLOW) {
        let scene = anchor.scene(SHALLOW);
        let space = RenderSpace::of(&scene, Region::whole(size(SHALLOW)));
        if space
            .reference()
            .and_then(deep::reference_of)
            .is_some_and(|reference| !reference.rotates())
        {
            let view = format!("power {} {} at {SHALLOW:e}", anchor.power, anchor.name);
            view_agrees(&scene, size(SHALLOW), false, &view);
        }
    }
}

#[test]
fn views_of_power_2_agree_with_the_march() {
    views_agree(2.0, false);
}

#[test]
fn views_of_power_3_agree_with_the_march() {
    views_agree(3.0, false);
}

#[test]
fn views_of_power_8_agree_with_the_march() {
    views_agree(8.0, false);
}

#[test]
fn views_of_power_16_agree_with_the_march() {
    views_agree(16.0, false);
}

#[test]
fn views_of_julia_sets_agree_with_the_march() {
    views_agree(8.0, true);
}

/// Where orbits come by the axis again and again, safe steps are hundreds of times shorter than
/// estimates: rays that go by these alone have none left before they arrive.
#[test]
fn views_of_creeping_rays_agree_with_the_march() {
    let anchor = Anchor {
        power: 3.0,
        julia: false,
        name: "beside the axis",
        position: [
            "7.648421872844884776e-3",
            "6.442176872376910272e-3",
            "1.131353706377499888890596",
        ],
        toward: [0.1, -0.2, -0.97],
        deepest: 1e-3,
    };
    let view = format!("power 3 {}", anchor.name);
    view_agrees(&anchor.scene(anchor.deepest), size(anchor.deepest), false, &view);
}

/// The set with the other sign of the sine.
#[test]
fn views_of_the_negative_sine_agree_with_the_march() {
    for scale in OTHERS {
        let scene = views::MIRRORED.scene(scale);
        view_agrees(&scene, size(scale), false, &format!("other variant at {scale:e}"));
    }
}

/// The least bailout and the largest, about which the surface is the same.
#[test]
fn views_with_any_bailout_agree_with_the_march() {
    let views = [
        (2.0, "at the equator", &[2.0, 256.0][..]),
        (3.0, "from below", &[2.0, 256.0]),
        (8.0, "from below", &[2.0, 255.0]),
        (16.0, "from below", &[2.0, 15.9]),
    ];
    for (power, name, bailouts) in views {
        let is_it = |anchor: &&views::Anchor| (anchor.power, anchor.name) == (power, name);
        let anchor = ANCHORS.iter().find(is_it).expect("the anchor");
        for (scale, &bailout) in OTHERS.iter().flat_map(|s| bailouts.iter().map(move |b| (*s, b))) {
            let mut scene = anchor.scene(scale);
            scene.fractal.bailout = bailout;
            assert_eq!(scene.validate(), Ok(()));
            let view = format!("power {power}, bailout {bailout} at {scale:e}");
            view_agrees(&scene, size(scale), false, &view);
        }
    }
}
