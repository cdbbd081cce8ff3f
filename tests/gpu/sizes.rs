//! A view that gets another size keeps the samples that are still true, and ends as if it had kept none.

use std::sync::Arc;

use glam::DVec3;
use mandelight::{
    render::{
        Pace, Region, View,
        pass::{march, scatter, shade},
    },
    scene::{BackgroundKind, EnvironmentMap, IndirectKind, IntegratorKind, Scene, presets},
};
use mandelight_test_support::{
    compare::{RESIZED, assert_within},
    device::gpu,
    view::{finished, pipelines, pixels, sampled, settle, still},
};

const WIDE: [u32; 2] = [96, 64];
const NARROW: [u32; 2] = [70, 64];

/// The film of a part of a picture of `size_px`, `columns` from its left.
fn columns_of(
    film: &[[f32; 3]],
    size_px: [u32; 2],
    columns: std::ops::Range<u32>,
) -> Vec<[f32; 3]> {
    let rows = film.chunks_exact(size_px[0] as usize);
    rows.flat_map(|row| row[columns.start as usize..columns.end as usize].iter().copied()).collect()
}

/// The columns of the wide picture that the narrow one shows.
const SHARED: std::ops::Range<u32> = 13..83;

fn film(view: &View) -> Vec<[f32; 3]> {
    view.film().expect("the film's bytes")
}

fn traced() -> Scene {
    let mut scene = sampled(Scene::default(), 9);
    scene.integrator.kind = IntegratorKind::Path;
    scene
}

#[test]
fn a_narrower_picture_is_a_part_of_the_wider_one() {
    for (scene, pass) in [(sampled(Scene::default(), 5), &march::PASS), (traced(), &scatter::PASS)]
    {
        let mut view = finished(&scene, WIDE, Pace::Interactive);
        let wide = film(&view);
        let before = view.dispatches().clone();
        view.set_region(Region::whole(NARROW));
        settle(&mut view);
        let traces = view.dispatches().since(&before).of(pass).dispatches;
        assert_eq!(traces, 0, "samples are computed again");
        assert!(film(&view) == columns_of(&wide, WIDE, SHARED), "other samples");
        assert_eq!(view.report().samples_done, scene.quality.samples);
        assert_eq!(view.texture().map(wgpu::Texture::width), Some(NARROW[0]));
        if !scene.traces_paths() {
            assert_fresh(&view, &scene);
        }
    }
}

/// A path's noise depends on its pixel's place, which is another in the wider picture: computed again, it would differ.
#[test]
fn a_wider_picture_adds_to_the_narrower_one() {
    for scene in [sampled(Scene::default(), 5), traced()] {
        let mut view = finished(&scene, NARROW, Pace::Interactive);
        let narrow = film(&view);
        view.set_region(Region::whole(WIDE));
        settle(&mut view);
        let wide = film(&view);
        assert!(columns_of(&wide, WIDE, SHARED) == narrow, "kept pixels were computed");
        assert_eq!(view.report().samples_done, scene.quality.samples);
        let fresh = finished(&scene, WIDE, Pace::Interactive);
        let added: Vec<_> = [0..SHARED.start, SHARED.end..WIDE[0]].to_vec();
        for columns in added {
            let [new, expected] =
                [&wide, &film(&fresh)].map(|film| columns_of(film, WIDE, columns.clone()));
            let off = new.iter().zip(&expected).filter(|(a, b)| {
                a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 0.02 * b.abs().max(0.1))
            });
            assert!(off.count() * 100 <= new.len(), "new pixels are not those of a fresh view");
        }
        if !scene.traces_paths() {
            assert_fresh(&view, &scene);
        }
    }
}

/// Holds that the view's picture is that of a fresh view.
fn assert_fresh(view: &View, scene: &Scene) {
    let size_px = view.region().size_px;
    let what = format!("a view that became {size_px:?}");
    assert_within(&pixels(view), &still(scene, size_px), size_px, RESIZED, &what);
}

/// The centre samples' depths, normals and shadows stay true where a gradient that follows the view changes.
#[test]
fn colors_that_follow_the_view_are_shaded_anew() {
    // Its surface goes over the narrow picture's borders.
    let mut scene = sampled((presets::opening_scenes()[1].scene)(), 1);
    scene.indirect.kind = IndirectKind::Off;
    assert!(scene.surface.follows_view());
    let smooth = sampled(scene.clone(), 6);
    for (from, to) in [(WIDE, NARROW), (NARROW, WIDE)] {
        let mut view = finished(&scene, from, Pace::Interactive);
        let passes = [&march::PASS, &shade::PASS];
        let before = view.dispatches().clone();
        view.set_region(Region::whole(to));
        settle(&mut view);
        let since = view.dispatches().since(&before);
        let [marches, shades] = passes.map(|pass| since.of(pass).dispatches);
        assert!(shades > marches, "{marches} marches and {shades} shades");
        assert_eq!(marches > 0, to == WIDE, "{marches} marches");
        view.set_scene(&smooth, false);
        settle(&mut view);
        assert_fresh(&view, &smooth);
    }
}

/// Indirect light comes from a pixel's neighbours, 6 pixels around it.
#[test]
fn indirect_light_stays_away_from_the_borders_that_move() {
    let mut scene = sampled(Scene::default(), 3);
    scene.indirect.kind = IndirectKind::Uniform;
    scene.indirect.radius = 0.06;
    let mut view = finished(&scene, NARROW, Pace::Interactive);
    let narrow = film(&view);
    view.set_region(Region::whole(WIDE));
    settle(&mut view);
    let inner = columns_of(&narrow, NARROW, 6..64);
    assert!(columns_of(&film(&view), WIDE, 19..77) == inner, "pixels are not kept");
    assert_fresh(&view, &scene);
    view.set_region(Region::whole(NARROW));
    settle(&mut view);
    assert!(columns_of(&film(&view), NARROW, 6..64) == inner, "pixels are not kept");
    assert_fresh(&view, &scene);
}

#[test]
fn a_size_that_comes_amid_samples_ends_in_the_same_picture() {
    let scene = sampled(Scene::default(), 6);
    for pumps in 1..9 {
        let mut view = View::new(pipelines(), Region::whole(NARROW), Pace::Interactive);
        view.set_scene(&scene, false);
        for (size_px, pumps) in [(NARROW, pumps), (WIDE, 2 * pumps), (NARROW, 1), ([70, 96], pumps)]
        {
            view.set_region(Region::whole(size_px));
            for pump in 0..pumps {
                view.pump(0.02 * f64::from(pump));
                gpu().wait();
            }
        }
        view.set_region(Region::whole(WIDE));
        settle(&mut view);
        assert_fresh(&view, &scene);
    }
}

/// Light paths leave guides of the denoiser where direct light has its shadows.
#[test]
fn direct_light_after_paths_and_another_width_has_its_shadows() {
    let mut view = finished(&traced(), NARROW, Pace::Interactive);
    view.set_region(Region::whole(WIDE));
    // The centre samples of the borders, at least.
    for pump in 0..6 {
        view.pump(0.02 * f64::from(pump));
        gpu().wait();
    }
    let direct = sampled(Scene::default(), 4);
    view.set_scene(&direct, false);
    settle(&mut view);
    assert_fresh(&view, &direct);
}

/// What is known of the paths' noise goes with them.
#[test]
fn paths_that_have_ended_stay_ended() {
    let mut scene = traced();
    (scene.quality.samples, scene.integrator.noise) = (400, 0.2);
    let mut view = finished(&scene, WIDE, Pace::Interactive);
    let done = view.report().samples_done;
    assert!((32..400).contains(&done), "{done} samples");
    let before = view.dispatches().clone();
    view.set_region(Region::whole(NARROW));
    settle(&mut view);
    let report = view.report();
    assert_eq!((report.samples_done, report.converged_fraction), (done, Some(1.0)));
    assert_eq!(view.dispatches().since(&before).of(&scatter::PASS).dispatches, 0);
    // Amid samples, the noise of the film before says nothing of the new one.
    let mut view = View::new(pipelines(), Region::whole(WIDE), Pace::Interactive);
    view.set_scene(&scene, false);
    let mut now_secs = 0.0;
    while view.report().samples_done < done - 8 {
        now_secs += 0.02;
        view.pump(now_secs);
        gpu().wait();
    }
    view.set_region(Region::whole(NARROW));
    settle(&mut view);
    assert!(view.report().samples_done >= 32, "{:?}", view.report());
}

/// Another edit that comes in the same frame is not lost.
#[test]
fn an_environment_map_that_comes_with_another_width_is_shown() {
    let map = |color| Arc::new(EnvironmentMap::from_fn("map.hdr", [8, 4], |_| color));
    let mut scene = sampled(Scene::default(), 2);
    scene.background.kind = BackgroundKind::EnvironmentMap;
    scene.lights.rig.environment_map.name = "map.hdr".into();
    let [red, blue] = [map(DVec3::X), map(DVec3::Z)];
    let mut view = View::new(pipelines(), Region::whole(WIDE), Pace::Interactive);
    view.set_environment_map(Some(&red));
    view.set_scene(&scene, false);
    settle(&mut view);
    view.set_environment_map(Some(&blue));
    view.set_region(Region::whole(NARROW));
    settle(&mut view);
    let corner = film(&view)[0];
    assert!(corner[2] > 0.9 && corner[0] < 0.1, "{corner:?}");
}

/// Whatever is on the screen, no pixel of it is one that was never computed.
#[test]
fn no_border_is_dark_while_it_is_made() {
    let mut scene = sampled(Scene::default(), 6);
    scene.indirect.kind = IndirectKind::Uniform;
    scene.background.top = [0.5; 3];
    scene.background.bottom = [0.5; 3];
    for pumps in 1..7 {
        let mut view = finished(&sampled(scene.clone(), 2), NARROW, Pace::Interactive);
        view.set_scene(&scene, false);
        for pump in 0..pumps {
            view.pump(100.0 + 0.02 * f64::from(pump));
            gpu().wait();
        }
        view.set_region(Region::whole(WIDE));
        let mut now_secs = 200.0;
        while view.pump(now_secs) {
            gpu().wait();
            now_secs += 0.02;
            if view.texture().map(wgpu::Texture::width) == Some(WIDE[0]) {
                let picture = pixels(&view);
                let darkest = picture.as_chunks::<4>().0.iter().step_by(WIDE[0] as usize);
                let darkest = darkest.map(|pixel| pixel[0]).min().expect("a row");
                assert!(darkest > 90, "a border of {darkest} after {pumps} pumps");
            }
        }
    }
}

/// A picture taller than wide has another scale; an odd difference is half a pixel off.
#[test]
fn pictures_of_other_rays_share_nothing() {
    let overlap = |a, b| Region::whole(a).overlap(&Region::whole(b));
    assert!(overlap([96, 64], [70, 64]).is_some() && overlap([64, 64], [96, 64]).is_some());
    for other in [[96, 60], [71, 64], [62, 64]] {
        assert_eq!(overlap([96, 64], other), None, "{other:?}");
        assert_eq!(overlap(other, [96, 64]), None, "{other:?}");
    }
    let part = Region { picture_px: [96, 64], origin_px: [4, 0], ..Region::whole([70, 64]) };
    assert_eq!(part.overlap(&Region::whole([96, 64])), None);
}
