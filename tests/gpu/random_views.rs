//! Pictures of random views against brackets from a fine march with numbers of 192 bits, or f64 where it is enough.
//!
//! `cargo test --release --test gpu random_views -- --ignored --nocapture` draws 200 other views each run and prints its
//! seed; `MANDELIGHT_SEED` draws those of a run again, `MANDELIGHT_VIEWS` sets their number, and
//! `MANDELIGHT_DECADES=6` draws them from 1 to 1e-6 scene units away instead of to 1e-26. `MANDELIGHT_VIEW=FILE`
//! judges the scene of one file instead, such as a view that a run has stored.

use std::{fs, path::Path};

use mandelight::{
    gpu::device::in_parallel,
    scene::{Scene, document},
};
use mandelight_test_support::{
    deep::{
        arithmetic::Number,
        brackets::Verdict,
        random_views::{RandomView, random_view, random_view_of},
        rays::{SetView, Size, centre, pixels},
        views,
    },
    random::Random,
    variables,
    view::single_samples,
};

/// Width and height of the pictures.
const SIZE: Size = [36, 24];
/// Width and height of pictures of views that break a limit at [`SIZE`]: five wrong pixels of so few may be chance.
const FINER: Size = [72, 48];
/// The closest views.
const NEAREST: f64 = 1e-26;

/// Views whose estimates ripple below a pixel.
const RIPPLED: &str = include_str!("hard_views/rippled.json");
const RIPPLED_BELOW: &str = include_str!("hard_views/rippled_below.json");

/// Views that are hard to march, or whose estimates ripple below a pixel, and their pictures' sizes.
const HARD: [(&str, Size); 40] = [
    // Directions are stretched up to a hundred times as much as the ray's; the third is a quarter of the first.
    (include_str!("hard_views/stretched.json"), HARD_SIZE),
    (include_str!("hard_views/stretched_beside.json"), HARD_SIZE),
    (include_str!("hard_views/stretched_zoomed.json"), HARD_SIZE),
    (RIPPLED, HARD_SIZE),
    (RIPPLED_BELOW, HARD_SIZE),
    // Power 2, whose hits are checked.
    (include_str!("hard_views/power_2.json"), HARD_SIZE),
    // A power that is not whole: the set has a seam.
    (include_str!("hard_views/real_power.json"), HARD_SIZE),
    // Walls along the seam: steps and cones that don't end there pass a sixth of the first view's pixels.
    (include_str!("hard_views/seam.json"), HARD_SIZE),
    (include_str!("hard_views/seam_inside.json"), HARD_SIZE),
    // Julia sets whose orbits pass the origin in front of a surface.
    (include_str!("hard_views/origin.json"), HARD_SIZE),
    (include_str!("hard_views/origin_real.json"), HARD_SIZE),
    // Power 12 at 3e-25, where orbits separate more slowly than at 99 of 100 points.
    (include_str!("hard_views/slow_orbits.json"), HARD_SIZE),
    // Power 2 in dust, through which rays creep by their least steps. The reference takes seconds for few pixels.
    (include_str!("hard_views/dust.json"), [12, 8]),
    // Power 2 at 3e-20, and a Julia set of power 2 at 5e-20: false maxima within layers that a ray must not pass.
    (include_str!("hard_views/spiked_dust.json"), SIZE),
    (include_str!("hard_views/spiked_sheets.json"), SIZE),
    // A Julia set of power 6: dust at 3e-14, a thousandth of the estimate at the eye.
    (include_str!("hard_views/near_dust.json"), SIZE),
    // Power 2 at 3e-7, in dust that the rays of the anchor's search pass: the estimate at the eye is over a thousand times as much.
    (include_str!("hard_views/passed_dust.json"), SIZE),
    // Power 6: the steps after the near ones stretch unevenly, so that an orbit's rounding counts a hundred times.
    (include_str!("hard_views/uneven.json"), SIZE),
    // Power 6 at 1e-6: the Jacobian changes so much within a step that cones of 0.7 of it end behind the surface.
    (include_str!("hard_views/cones.json"), SIZE),
    // Power 16 at 2e-15: the first step after the series passes the origin. Orbits then stretch a direction at right angles to
    // the one that the series stretches most, thirty times as much as dr says.
    (include_str!("hard_views/origin_behind_series.json"), SIZE),
    // A Julia set of power 16, whose estimate at the eye is more than the way to the surface.
    (include_str!("hard_views/first_step.json"), SIZE),
    // Power 2 at 9e-22: a third of a step, as the stretch along a ray limits it, is in front of thin sheets.
    (include_str!("hard_views/sheets.json"), SIZE),
    // Power 8 at 2e-5 and 1e-2, and a Julia set of power 4 at 4e-4: all orbits in view pass close to the polar axis once,
    // which stretches them sideways 17 to 500 times as much as the estimate's derivative says.
    (include_str!("hard_views/near_axis.json"), SIZE),
    (include_str!("hard_views/near_axis_wide.json"), SIZE),
    (include_str!("hard_views/near_axis_julia.json"), SIZE),
    // A Julia set of power 16 from inside: rays pass points whose orbits meet the origin, where estimates are 1e7.
    (include_str!("hard_views/hollow.json"), SIZE),
    // Power 9 at 2e-6: the estimate at the eye is 8.5 times the distance, and would let plain f32 draw the view.
    (include_str!("hard_views/overestimated.json"), SIZE),
    // A Julia set of power 16 from 0.66: rays outside of the bounding sphere are within a hit distance of the set.
    (include_str!("hard_views/beside_sphere.json"), SIZE),
    // Power 9 at 2.2e-4: the safe step from the eye is 1.13 times the way to the surface.
    (include_str!("hard_views/long_first_step.json"), SIZE),
    // A Julia set of power 9.94 at 7e-3: about twice the way.
    (include_str!("hard_views/longer_first_step.json"), SIZE),
    // Power 10.07 at 3.6e-3: sheets 1.2 hit distances thick, which over-relaxed steps pass.
    (include_str!("hard_views/seam_sheets.json"), SIZE),
    // A Julia set of power 4.74 at 0.1, which also steps over-relaxed by a tenth pass.
    (include_str!("hard_views/seam_layers.json"), SIZE),
    // A Julia set of power 9.27 at 2e-4: the estimate is up to 1.2 times the way, since orbits stretch rays more than dr says.
    (include_str!("hard_views/stretched_rays.json"), SIZE),
    // A Julia set of power 11.78 at 2e-4: the stretch of directions, which a cone does not follow, makes cones of 0.7 of their
    // steps end behind the surface.
    (include_str!("hard_views/stretched_cones.json"), SIZE),
    // A Julia set of power 6 at 2e-11: rays begin behind their cones where the stretch along them is least.
    (include_str!("hard_views/behind_cones.json"), SIZE),
    // Power 2 at 2e-22: rays creep through dust until most of their steps are spent, and long late steps pass layers behind it.
    (include_str!("hard_views/late_steps.json"), SIZE),
    // A Julia set of power 4 at 5e-24, whose orbits have not escaped when the scene's own iterations end: the estimate at the eye
    // would let plain f32 draw the view.
    (include_str!("hard_views/slow_julia.json"), HARD_SIZE),
    // Power 2 at 9e-26, in dust: rays take more steps than there are turns for orbits of all iterations.
    (include_str!("hard_views/long_orbits.json"), [12, 8]),
    // Power 6 at 3e-11: the scene's own iterations end before dr is 1e3, at which a deep view's additional ones begin to count.
    (include_str!("hard_views/slow_from_the_start.json"), SIZE),
    // Power 6.18 at 1e-4: orbits of a wall take all iterations and end between 1 and the escape radius.
    (include_str!("hard_views/slow_real.json"), SIZE),
];
/// Part of their pixels that may be out of their brackets.
const MOST_WRONG_OF_HARD: f64 = 0.003;
/// Width and height of most of their pictures.
const HARD_SIZE: Size = [48, 32];

/// Pixels are judged in so many rounds, each all over the picture.
const ROUNDS: usize = 12;
/// Orbit steps of a reference after which no further round is begun: in dust each pixel may take a million.
const MOST_ORBIT_STEPS: u64 = 100_000_000;
/// Pixels from one judged to the next: shares no factor with the number of a picture's.
const STRIDE: usize = 365;

/// How many pixels of a picture are wrong.
#[derive(Clone, Copy, Debug, Default)]
struct Judged {
    /// Judged pixels.
    pixels: usize,
    /// Rays that hit, or should.
    surfaces: usize,
    hits: usize,
    too_near: usize,
    too_far: usize,
    /// Normals that face away from the eye.
    away: usize,
}

fn judge(scene: &Scene, size: Size) -> Judged {
    let iterations = views::plenty(scene);
    match SetView::in_f64(scene, size, iterations) {
        Some(looking) => judge_by(&looking, scene),
        None => judge_by(&SetView::exact(scene, size, iterations), scene),
    }
}

fn judge_by<N: Number>(looking: &SetView<'_, N>, scene: &Scene) -> Judged {
    let size = looking.size;
    let samples = single_samples(scene, size);
    let all: Vec<_> = pixels(size).collect();
    let pixels: Vec<_> = (0..all.len()).map(|i| all[i * STRIDE % all.len()]).collect();
    let mut verdicts = Vec::new();
    for round in pixels.chunks(pixels.len().div_ceil(ROUNDS)) {
        verdicts.extend(in_parallel(round, |&(pixel, index): &([u32; 2], usize)| {
            let found = looking.hit_at(samples.depth[index]);
            let direction = looking.direction(centre(pixel));
            let is_away = found.is_some() && samples.normal[index].as_dvec3().dot(direction) > 0.0;
            (looking.judge(direction, found), found.is_some(), is_away)
        }));
        if looking.orbit_steps() > MOST_ORBIT_STEPS {
            println!("{} of {} pixels are judged", verdicts.len(), pixels.len());
            break;
        }
    }
    let count =
        |is: &dyn Fn(&(Verdict, bool, bool)) -> bool| verdicts.iter().filter(|v| is(v)).count();
    Judged {
        pixels: verdicts.len(),
        surfaces: count(&|v| v.1 || v.0 == Verdict::TooFar),
        hits: count(&|v| v.1),
        too_near: count(&|v| v.0 == Verdict::TooNear),
        too_far: count(&|v| v.0 == Verdict::TooFar),
        away: count(&|v| v.2),
    }
}

impl Judged {
    fn wrong(&self) -> usize {
        self.too_near + self.too_far
    }

    fn breaks_limit(&self) -> bool {
        self.away > 0 || self.wrong() as f64 > MOST_WRONG * self.pixels as f64
    }
}

/// Part of a picture's pixels that may be out of their brackets.
const MOST_WRONG: f64 = 0.005;
/// Part of all pictures' pixels.
const MOST_WRONG_OF_ALL: f64 = 0.001;

/// How true the pictures of random views are.
struct Judgement {
    /// What is said of each view that breaks a limit.
    broken: Vec<String>,
    /// The pixels of all views.
    all: Judged,
}

impl Judgement {
    fn assert_within_limits(&self) {
        let Self { broken, all } = self;
        assert!(broken.is_empty(), "{broken:#?}");
        assert!(all.wrong() as f64 <= MOST_WRONG_OF_ALL * all.pixels as f64, "all: {all:?}");
    }
}

/// Judges random views until `wanted` of them show something; `draw` gets the number of those before. Pictures that break a
/// limit are judged again at the size `finer`, if any. Views that break it still are stored, to look at.
fn judge_views(
    seed: u64,
    wanted: usize,
    finer: Option<Size>,
    draw: impl Fn(&mut Random, usize) -> Option<RandomView>,
) -> Judgement {
    println!("MANDELIGHT_SEED={seed}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("random-views");
    fs::create_dir_all(&folder).expect("a folder");
    let mut random = Random(seed);
    let (mut found, mut all, mut broken) = (0, Judged::default(), Vec::new());
    while found < wanted {
        let Some(view) = draw(&mut random, found) else { continue };
        let mut judged = judge(&view.scene, SIZE);
        if let Some(finer) = finer.filter(|_| judged.breaks_limit()) {
            println!("{}: {judged:?}, judged again", view.name);
            judged = judge(&view.scene, finer);
        }
        // A picture that misses what it should show counts.
        if judged.surfaces * 10 < judged.pixels * 3 {
            continue;
        }
        found += 1;
        println!("{}: {judged:?}", view.name);
        all.pixels += judged.pixels;
        all.surfaces += judged.surfaces;
        all.hits += judged.hits;
        all.too_near += judged.too_near;
        all.too_far += judged.too_far;
        all.away += judged.away;
        if judged.breaks_limit() {
            let file = folder.join(format!("{seed}-{found}.json"));
            fs::write(&file, document::to_json(&view.scene)).expect("a file");
            broken.push(format!("{}: {judged:?}, {}", view.name, file.display()));
        }
    }
    println!("all: {all:?}");
    Judgement { broken, all }
}

#[test]
fn hard_views_hold_their_limits() {
    for (index, (text, size)) in HARD.into_iter().enumerate() {
        let judged = judge(&document::from_json(text).expect("a scene"), size);
        println!("{index}: {judged:?}");
        let most = MOST_WRONG_OF_HARD * judged.pixels as f64;
        assert!(judged.wrong() as f64 <= most, "{index}: {judged:?}");
        assert_eq!(judged.away, 0, "{index}: {judged:?}");
    }
}

/// Power 9 at 5e-21: no surface is nearer than 1e-15, but orbits in front of the eye are slow, and the set of the
/// iterations that 1e-15 needs covers most of the picture.
#[test]
fn slow_orbits_in_front_of_the_pivot_have_enough_iterations() {
    let scene =
        document::from_json(include_str!("hard_views/slow_in_front.json")).expect("a scene");
    let depths = single_samples(&scene, SIZE).depth;
    let looking = SetView::exact(&scene, SIZE, scene.fractal.iterations);
    let hits = depths.iter().filter(|depth| looking.hit_at(**depth).is_some()).count();
    assert!(hits < 5, "{hits} of {} rays hit", depths.len());
}

/// The angles that 90 of 100 of their normals hold, degrees: 25 and 8.0 measured; 74 and 15 if points inside the set face
/// the eye, and grids are about the point.
const FOOTPRINT_NORMALS: [(&str, f64); 2] = [(RIPPLED, 35.0), (RIPPLED_BELOW, 10.0)];
/// Width and height of their pictures.
const RIPPLED_SIZE: Size = [240, 160];
/// Every so many pixels are compared.
const EVERY: usize = 197;
/// Cells along an edge of the cube that a footprint's normal is of; the program's has two.
const CUTS: u32 = 4;

#[test]
fn normals_of_rippled_views_are_a_footprints() {
    for (text, most) in FOOTPRINT_NORMALS {
        let scene = document::from_json(text).expect("a scene");
        let samples = single_samples(&scene, RIPPLED_SIZE);
        let looking = SetView::exact(&scene, RIPPLED_SIZE, views::plenty(&scene));
        let pixels: Vec<_> = pixels(RIPPLED_SIZE).step_by(EVERY).collect();
        let angles = in_parallel(&pixels, |&(pixel, index): &([u32; 2], usize)| {
            let depth = looking.hit_at(samples.depth[index])?;
            let normal = looking.footprint_normal(looking.direction(centre(pixel)), depth, CUTS);
            Some(normal.angle_between(samples.normal[index].as_dvec3()).to_degrees())
        });
        let mut angles: Vec<_> = angles.into_iter().flatten().collect();
        angles.sort_by(f64::total_cmp);
        let at = |part: usize| angles[(angles.len() - 1) * part / 100];
        println!("{:.1} {:.1} {:.1} degrees", at(50), at(75), at(90));
        assert!(angles.len() > 150 && at(90) < most, "{} of {} normals", at(90), angles.len());
    }
}

/// Of views that hold the limits.
const SEED: u64 = 11;

#[test]
fn twenty_views_are_true() {
    judge_views(SEED, 20, None, |random, _| random_view(random, NEAREST)).assert_within_limits();
}

/// Distance of the nearest of views that are mostly drawn in plain f32, scene units.
const NEAREST_PLAIN: f64 = 1e-6;

#[test]
fn forty_views_from_farther_away_are_true() {
    judge_views(SEED, 40, None, |random, _| random_view(random, NEAREST_PLAIN))
        .assert_within_limits();
}

/// Whole powers that random views do not have.
const OTHER_POWERS: [f64; 6] = [7.0, 10.0, 11.0, 13.0, 14.0, 15.0];

#[test]
fn a_view_of_each_other_whole_power_is_true() {
    judge_views(SEED, OTHER_POWERS.len(), None, |random, found| {
        random_view_of(OTHER_POWERS[found], random, NEAREST)
    })
    .assert_within_limits();
}

/// Of twenty new views, the most that may break a limit: about one in a hundred does.
const MOST_BROKEN: usize = 1;

/// `MANDELIGHT_SEED` draws the views of a run again.
#[test]
fn at_most_one_of_twenty_new_views_breaks_a_limit() {
    let judgement =
        judge_views(variables::seed(), 20, Some(FINER), |random, _| random_view(random, NEAREST));
    assert!(judgement.broken.len() <= MOST_BROKEN, "{:#?}", judgement.broken);
}

#[test]
#[ignore = "minutes, and other views each run: see CONTRIBUTING.md"]
fn random_views_are_true() {
    if let Some(file) = std::env::var_os("MANDELIGHT_VIEW") {
        let text = fs::read_to_string(&file).expect("a file");
        let judged = judge(&document::from_json(&text).expect("a scene"), SIZE);
        println!("{}: {judged:?}", file.display());
        return;
    }
    let wanted = variables::number("MANDELIGHT_VIEWS").unwrap_or(200) as usize;
    let nearest =
        variables::number("MANDELIGHT_DECADES").map_or(NEAREST, |n| 10_f64.powi(-(n as i32)));
    judge_views(variables::seed(), wanted, Some(FINER), |random, _| random_view(random, nearest))
        .assert_within_limits();
}
