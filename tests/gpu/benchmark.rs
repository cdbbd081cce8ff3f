//! The benchmark: that it runs, and that its literal kernel is literal.

#[path = "../../benches/speed/main.rs"]
#[expect(dead_code, reason = "tests use parts of the benchmark")]
mod bench;

use bench::{
    arguments::Arguments,
    counts, descent, instrument,
    limits::{Limits, Measure, Measured},
    literal, pixels, powers, statistics, tuning, views,
};
use clap::Parser as _;
use glam::DVec3;
use mandelight::{
    formula::{
        Kernel, Ray,
        mandelbulb::{
            Mandelbulb,
            estimator::Estimator,
            variant::{Steps, Variant},
        },
    },
    fractal::FractalModel,
    gpu::Gpu,
    render::{Region, space, uniforms::Inputs},
};
use mandelight_test_support::{
    device::fresh_gpu,
    oracle::estimate,
    probe::{self, bind_group, filled},
};

/// Width and height of the pictures.
const SIZE: [u32; 2] = [96, 54];

/// The thesis's rays in f64, step by step as `literal.wgsl` has them, on the oracle's Algorithm 1.
struct Thesis {
    fractal: Mandelbulb,
    tuning: literal::Tuning,
    outside: f64,
}

impl Thesis {
    fn distance(&self, point: DVec3) -> f64 {
        estimate::printed_distance(&self.fractal, point)
    }

    fn march(&self, ray: Ray) -> Option<f64> {
        let mut t = 0.0;
        for _ in 0..self.tuning.steps {
            let point = ray.at(t);
            if point.length() > self.fractal.bailout && point.dot(ray.direction) > 0.0 {
                return None;
            }
            let d = self.distance(point);
            if d < self.tuning.epsilon {
                return Some(t);
            }
            t += d;
        }
        Some(t)
    }

    fn normal(&self, point: DVec3) -> DVec3 {
        let slope = |axis: DVec3| {
            let offset = axis * self.tuning.epsilon;
            self.distance(point + offset) - self.distance(point - offset)
        };
        DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z)).normalize_or_zero()
    }

    fn is_lit(&self, point: DVec3, normal: DVec3, light: DVec3) -> bool {
        if normal.dot(light) <= 0.0 {
            return false;
        }
        let epsilon = self.tuning.epsilon;
        let ray = Ray { origin: point + normal * (2.0 * epsilon), direction: light };
        let mut s = ray.sphere_span(DVec3::ZERO, self.outside).map_or(0.0, |(_, far)| far);
        for _ in 0..self.tuning.steps {
            if s <= epsilon {
                return true;
            }
            let d = self.distance(ray.at(s));
            if d < 0.5 * epsilon {
                return false;
            }
            s -= d;
        }
        true
    }
}

/// Every pixel of a literal picture against the same algorithm in f64.
fn is_literal(literal: &literal::Literal, view: &views::View) {
    let views::View { name, scene, .. } = view;
    // What an f32 makes of positions at 1e-3 of the surface.
    let grain = if view.normals_within_deg > 1.0 { 10.0 } else { 1.0 };
    let tuning = tuning::find(scene, SIZE);
    let inputs = Inputs::new(scene, Region::whole(SIZE));
    let picture = literal::Picture::new(literal, &inputs, 1, tuning, 1);
    picture.draw_ms();
    let seen = picture.seen().expect("the picture's bytes");
    assert_eq!(seen.len(), (SIZE[0] * SIZE[1]) as usize, "{name}");
    let fractal = Mandelbulb { iterations: tuning.iterations, ..Mandelbulb::of(&scene.fractal) };
    let outside = Estimator::new(&Mandelbulb::of(&scene.fractal)).bounding_radius();
    let thesis = Thesis { fractal, tuning, outside };
    let lights: Vec<_> =
        scene.lights.environment.iter().map(|light| DVec3::from_array(light.direction)).collect();
    let both = statistics::in_parallel(&seen, |seen| {
        let ray = pixels::pixel_ray(scene, SIZE, seen.pixel);
        let is_same_hit = thesis.march(ray).is_some() == (seen.depth > 0.0);
        let depth = thesis.march(ray).filter(|_| seen.depth > 0.0);
        let off = depth.map(|depth| {
            let found = f64::from(seen.depth);
            // Of the kernel's own point, and for shadows its own normal.
            let (point, normal) = (ray.at(found), seen.normal.as_dvec3());
            let bits: u64 = (0..)
                .zip(&lights)
                .map(|(k, l)| u64::from(thesis.is_lit(point, normal, *l)) << k)
                .sum();
            let angle_deg = normal.angle_between(thesis.normal(point)).to_degrees();
            (
                (found - depth).abs() / tuning.epsilon,
                angle_deg,
                (bits ^ seen.visibility).count_ones(),
            )
        });
        (is_same_hit, off)
    });
    let differ = both.iter().filter(|(is_same, _)| !is_same).count();
    let off: Vec<_> = both.iter().filter_map(|(_, off)| *off).collect();
    let depths: Vec<_> = off.iter().map(|(depth, _, _)| *depth).collect();
    let angles: Vec<_> = off.iter().map(|(_, angle, _)| *angle).collect();
    let bits: u32 = off.iter().map(|(_, _, bits)| bits).sum();
    let bits = f64::from(bits) / (off.len() * lights.len()) as f64;
    let (depth, angle) = (statistics::quantile(depths, 0.95), statistics::median(&angles));
    assert!(off.len() > 500, "{name}: {} hits", off.len());
    assert!(differ <= 10, "{name}: {differ} hits differ");
    assert!(depth < 0.1 * grain, "{name}: depths differ by {depth} epsilons");
    assert!(angle < 0.1 * grain, "{name}: normals differ by {angle} degrees");
    assert!(bits < 0.02, "{name}: {bits} of the shadow bits differ");
}

#[test]
fn the_literal_kernel_is_literal() {
    let gpu = fresh_gpu();
    let literal = literal::Literal::new(&gpu);
    for view in views::all().into_iter().filter(|view| !view.is_long) {
        is_literal(&literal, &view);
    }
    assert_eq!(gpu.faults(), 0);
}

/// The part of the blocks that stand for all of them is spread over the whole picture.
#[test]
fn left_out_blocks_are_left_out_evenly() {
    let gpu = fresh_gpu();
    let literal = literal::Literal::new(&gpu);
    let scene = views::filled();
    let size = [256, 144];
    let tuning = tuning::find(&scene, size);
    let inputs = Inputs::new(&scene, Region::whole(size));
    let seen = |stride| {
        let picture = literal::Picture::new(&literal, &inputs, 1, tuning, stride);
        picture.draw_ms();
        (picture.share(), picture.seen().expect("the picture's bytes"))
    };
    let ((whole, all), (part, some)) = (seen(1), seen(4));
    assert_eq!(whole, 1.0);
    assert!((0.05..0.08).contains(&part), "{part}");
    for seen in &some {
        assert!(all.contains(seen), "{seen:?}");
    }
    for quarter in 0..4 {
        let inside = |[x, y]: [u32; 2]| x / 128 + y / 72 * 2 == quarter;
        let count = some.iter().filter(|seen| inside(seen.pixel)).count() as f64;
        assert!((0.15..0.4).contains(&(count / some.len() as f64)), "{quarter}: {count}");
    }
}

#[test]
fn the_benchmark_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    let json = folder.path().join("speed.json");
    let words = "bench --views whole,crevice,scaling --size 96x54 --rounds 1 --error-pixels 300 \
                 --passes --json";
    let words = words.split(' ').map(Into::into).chain([json.clone().into_os_string()]);
    bench::run(&Arguments::parse_from(words)).expect("figures");
    let text = std::fs::read_to_string(json).expect("the figures' file");
    let figures: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let views = figures["views"].as_array().expect("views");
    let names: Vec<_> = views.iter().filter_map(|view| view["view"].as_str()).collect();
    assert_eq!(names, ["whole", "crevice"]);
    for view in views {
        let ratio = view["literal"]["ms"].as_f64().zip(view["ours"]["ms"].as_f64());
        let ratio = ratio.map(|(literal, ours)| literal / ours).expect("times");
        assert!((ratio / view["ratio"].as_f64().expect("a ratio") - 1.0).abs() < 1e-6);
        // A view with a hole in it is no view.
        assert!(view["hit"].as_f64() > Some(0.25), "{view}");
    }
    let rows = figures["scaling"].as_array().expect("rows");
    assert!(rows.iter().all(|row| row["growth"].as_f64() > Some(0.0)), "{rows:?}");
    bench::start::once(&Arguments::parse_from(["bench", "--size", "96x54"])).expect("a start");
}

/// What counting shaders count against orbits in f64: two estimates, gradient and colours of the same
/// points, an orbit each.
#[test]
fn counters_count_orbits() {
    let gpu = fresh_gpu();
    for (power, julia) in [(2.0, false), (3.0, false), (8.0, false), (8.0, true), (6.5, false)] {
        let mut scene = views::filled();
        scene.fractal = Mandelbulb { power, julia, ..Mandelbulb::of(&scene.fractal) }.into();
        // A grid through the set and past it, of points that an f32 holds.
        let side = |i: u32| f64::from(i) / 8.0 - 1.25;
        let points: Vec<_> = (0..21 * 21 * 21_u32)
            .map(|i| DVec3::new(side(i % 21), side(i / 21 % 21), side(i / 441)) * 0.9375)
            .collect();
        // As many iterations as the view's pixels need.
        let inputs = Inputs::new(&scene, Region::whole([64, 64]));
        let followed = Mandelbulb {
            iterations: inputs.frame.march.iterations,
            ..Mandelbulb::of(&scene.fractal)
        };
        let expected: u32 = points.iter().map(|p| estimate::orbit(&followed, *p).steps).sum();
        for power in [0, followed.integer_power().unwrap_or(0)] {
            let found = counted(&gpu, &inputs, &points, power);
            assert_eq!(found.estimates, 2.0 * points.len() as f64, "{:?}", scene.fractal);
            let off = found.steps / (4.0 * f64::from(expected)) - 1.0;
            assert!(off.abs() < 2e-3, "{:?}: {found:?} for {expected}", scene.fractal);
        }
    }
    assert_eq!(gpu.faults(), 0);
}

#[test]
fn what_cannot_be_counted_is_said() {
    let marks = |estimates| instrument::Marks {
        orbits_in: "mandelbulb/",
        other_loops: &[],
        steps: &["step"],
        estimates,
        entries: &["main"],
        counters: instrument::Counters::Buffer([0, 0]),
    };
    let orbit = "fn step() {\n    return;\n}\nfn far(n: u32) {\n    for (var i = 0u; i < n; i++) {\n    }\n}\n";
    let entry = "@compute @workgroup_size(1)\nfn main(@builtin(workgroup_id) id: vec3u) {\n}\n";
    let files = [("mandelbulb/a", orbit), ("b", entry)];
    let text = instrument::counting(&files, &marks(&["far"])).expect("all is there");
    assert!(text.contains("fn counted_main(id: vec3u) {"), "{text}");
    assert!(text.contains("fn far(n: u32) { counted_estimates += 1u;"), "{text}");
    assert!(text.contains("return;\ncounted_steps += 1u;\n}\nfn far"), "{text}");
    assert!(instrument::counting(&files, &marks(&["near"])).unwrap_err().contains("near"));
    assert!(instrument::counting(&files[..1], &marks(&["far"])).unwrap_err().contains("main"));
    assert!(instrument::counting(&files[1..], &marks(&[])).unwrap_err().contains("mandelbulb/"));
}

/// Counts the program's probe at `points`.
fn counted(gpu: &Gpu, inputs: &Inputs, points: &[DVec3], power: u32) -> counts::Counts {
    let device = &gpu.device;
    let marks = counts::marks("mandelbulb/", &["estimate"], instrument::Counters::Buffer([2, 0]));
    let variant = Variant { power, steps: Steps::Plain }.number();
    let kernel = Kernel { variant, ..inputs.formula.kernel };
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("counting probe"),
        layout: None,
        module: &counts::counting(gpu, &probe::module(kernel), &marks).expect("a countable text"),
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions {
            constants: &kernel.overrides(),
            ..Default::default()
        },
        cache: None,
    });
    let points: Vec<_> = points.iter().map(|p| p.as_vec3().extend(0.0).to_array()).collect();
    let filled = |bytes: &[u8]| {
        filled(gpu, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC, bytes)
    };
    let bindings = probe::bindings(gpu, inputs);
    let questions = filled(bytemuck::cast_slice(&points));
    let answers = filled(&vec![0; 32 * points.len()]);
    let sums = filled(&[0; 8]);
    let groups = [bindings.iter().collect(), vec![&questions, &answers], vec![&sums]];
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    for (index, buffers) in (0..).zip(&groups) {
        let group = bind_group(gpu, &pipeline, index, buffers);
        pass.set_bind_group(index, &group, &[]);
    }
    pass.dispatch_workgroups((points.len() as u32).div_ceil(64), 1, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    counts::Counts::read(gpu, &sums).expect("the counts")
}

#[test]
fn a_cost_of_so_much_a_product_is_found() {
    let table = powers::table((2..=16).map(|power: u32| {
        let products = power.ilog2() + power.count_ones() - 1;
        let off = if power == 7 { 1.5 } else { 1.0 };
        (power, [(1.5 + 0.25 * f64::from(products)) * off, 10.0])
    }));
    assert!((table.fixed_ns - 1.5).abs() < 0.15, "{table:?}");
    assert!((table.product_ns - 0.25).abs() < 0.05, "{table:?}");
    assert!((1.3..1.5).contains(&table.worst) && !table.is_good(), "{table:?}");
}

fn measured(measure: Measure, view: &str, value: f64) -> Measured {
    Measured { measure, view: view.to_owned(), value }
}

#[test]
fn broken_limits_are_named() {
    let limits = Limits::parse("# why\nratio whole 2\ncost deep-1e-5 1.5 # a reason\n\n");
    let limits = limits.expect("limits");
    let good = [measured(Measure::Ratio, "whole", 2.1), measured(Measure::Cost, "deep-1e-5", 1.4)];
    assert_eq!(limits.complaints(&good), [""; 0]);
    let bad = [
        measured(Measure::Ratio, "whole", 1.9),
        measured(Measure::Cost, "deep-1e-5", 1.6),
        measured(Measure::Steps, "whole", 1.0),
    ];
    let complaints = limits.complaints(&bad);
    assert_eq!(complaints.len(), 2);
    assert!(complaints[0].contains("ratio whole 1.900 breaks its limit of 2.000"));
    assert_eq!((limits.missing(&good), limits.missing(&bad)), (0, 1));
}

#[test]
fn limits_only_tighten() {
    let text = "estimates whole 10 # a reason\nratio whole 2\n";
    let run = [
        measured(Measure::Estimates, "whole", 8.0),
        measured(Measure::Ratio, "whole", 1.0),
        measured(Measure::Cost, "deep-1e-5", 2.0),
    ];
    let tightened = Limits::tightened(text, &run).expect("limits");
    let expected = "estimates whole 8.080 # a reason\nratio whole 2\ncost deep-1e-5 3.000\n";
    assert_eq!(tightened, expected);
}

#[test]
fn nonsense_is_named() {
    for (text, part) in [
        ("ratio whole", "line 1"),
        ("\nspeed whole 2", "line 2"),
        ("ratio whole much", "no number"),
        ("ratio whole 1\nratio whole 2", "already"),
    ] {
        assert!(Limits::parse(text).expect_err(text).contains(part), "{text:?}");
    }
}

#[test]
fn the_file_has_limits() {
    let limits = Limits::parse(include_str!("../../benches/speed/limits.txt")).expect("limits");
    assert_ne!(limits, Limits::default());
}

/// The kernel of the powers' table runs: every time is a number above 0.
#[test]
fn every_power_has_a_time() {
    let gpu = fresh_gpu();
    let table = powers::measure(&gpu, 1).expect("a table");
    assert_eq!(gpu.faults(), 0);
    for row in &table.rows {
        let is_time = |ns: f64| ns.is_finite() && ns > 0.0;
        assert!(is_time(row.special_ns) && is_time(row.general_ns), "{row:?}");
    }
}

/// A place's views are compared with one of them, which has to be plain.
#[test]
fn descents_have_plain_references() {
    for place in descent::PLACES {
        let scene = place.scene(descent::REFERENCE).expect("a scene");
        let is_deep = space::wants_anchor(
            &FractalModel::new(&scene.fractal),
            &scene,
            Region::whole(views::SIZE_PX),
        );
        assert!(!is_deep, "{} {}", place.name, place.set());
    }
}

/// Each place is a point of the surface, seen along a line that is free of the set: from every distance
/// the estimate is far above that of the point itself.
#[test]
fn descents_lead_to_the_surface() {
    for place in descent::PLACES {
        for (_, distance) in descent::distances().into_iter().filter(|(_, d)| *d > 1e-8) {
            let scene = place.scene(distance).expect("a scene");
            let fractal = Mandelbulb { iterations: 60, ..Mandelbulb::of(&scene.fractal) };
            let field = Estimator::new(&fractal);
            let [eye, point] =
                [&scene.camera.position, &scene.camera.pivot].map(|point| point.to_dvec3());
            let [from_eye, from_point] = [eye, point].map(|point| field.distance(point));
            let name = format!("{} {} at {distance:e}", place.name, place.set());
            assert!(from_point < 1e-3 * distance, "{name}: {from_point} at the point");
            assert!(from_eye > 1e-4 * distance, "{name}: {from_eye} at the eye");
        }
    }
}
