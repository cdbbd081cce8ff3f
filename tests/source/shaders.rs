//! Every shader module parses and validates under default WebGPU capabilities, and every struct
//! that the host shares with it has the same fields at the same places.

use std::collections::BTreeMap;

use mandelight::{
    fractal::{deep, estimator, march},
    gpu::shader::Module,
    render::{lattice, pass::MODULES, post, report, uniforms, work_queues},
    scene::MAX_LIGHTS,
};
use mandelight_test_support::probe;
use naga::{
    TypeInner,
    proc::Layouter,
    valid::{Capabilities, ValidationFlags, Validator},
};

/// Name, offset and size of each field, and the whole size: of a WGSL struct.
type StructLayout = (u32, Vec<(String, u32, u32)>);

fn parsed(module: &Module) -> naga::Module {
    let text = module.text();
    naga::front::wgsl::parse_str(&text)
        .unwrap_or_else(|error| panic!("{}: {}", module.label, error.emit_to_string(&text)))
}

fn structs(module: &naga::Module) -> BTreeMap<String, StructLayout> {
    let mut layouter = Layouter::default();
    layouter.update(module.to_ctx()).expect("a layout");
    module
        .types
        .iter()
        .filter_map(|(_, ty)| {
            let TypeInner::Struct { members, span } = &ty.inner else { return None };
            let fields = members
                .iter()
                .map(|m| (m.name.clone().unwrap_or_default(), m.offset, layouter[m.ty].size))
                .collect();
            Some((ty.name.clone()?, (*span, fields)))
        })
        .collect()
}

/// The program's modules and the tests' own.
fn all_modules() -> impl Iterator<Item = &'static Module> {
    MODULES.iter().copied().chain([&*probe::MODULE])
}

#[test]
fn every_module_validates() {
    for module in all_modules() {
        let text = module.text();
        Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&parsed(module))
            .unwrap_or_else(|error| panic!("{}: {}", module.label, error.emit_to_string(&text)));
    }
}

#[test]
fn every_pass_has_one_entry_point_of_64_threads_within_default_limits() {
    for module in all_modules() {
        let parsed = parsed(module);
        let [entry] = &parsed.entry_points[..] else { panic!("{}", module.label) };
        assert_eq!((entry.name.as_str(), entry.workgroup_size), ("main", [64, 1, 1]));
        let storage = parsed
            .global_variables
            .iter()
            .filter(|(_, v)| matches!(v.space, naga::AddressSpace::Storage { .. }))
            .count();
        assert!(storage <= 8, "{} binds {storage} storage buffers", module.label);
    }
}

#[test]
fn host_structs_match_their_wgsl_twins() {
    let mut seen = Vec::new();
    for module in MODULES {
        let wgsl = structs(&parsed(module));
        for (name, size, fields) in uniforms::HOST_SHARED {
            let Some((span, members)) = wgsl.get(*name) else { continue };
            seen.push(*name);
            assert_eq!(*size as u32, *span, "size of {name} in {}", module.label);
            let host: Vec<_> = fields
                .iter()
                .map(|(field, offset, size)| (field.to_string(), *offset as u32, *size as u32))
                .collect();
            assert_eq!(host, *members, "fields of {name} in {}", module.label);
        }
    }
    for (name, ..) in uniforms::HOST_SHARED {
        assert!(seen.contains(name), "no shader knows the host's struct {name}");
    }
}

/// Else it would be all zeros: see `types/frame_uniforms.wgsl`.
#[test]
fn every_pass_begins_by_reading_the_frame_uniforms() {
    for module in all_modules() {
        let text = module.text();
        let (_, main) = text.split_once("fn main(").expect("an entry point");
        let (_, body) = main.split_once("{\n").expect("its body");
        let first = body.lines().next().map(str::trim);
        assert_eq!(first, Some("frame = frame_uniforms;"), "{}", module.label);
    }
}

/// A file in `shaders/` that no module joins is dead.
#[test]
fn every_shader_file_is_part_of_a_module() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let joined: Vec<_> =
        MODULES.iter().flat_map(|module| module.files).map(|file| file.path).collect();
    for folder in std::fs::read_dir(&root).expect("shaders/") {
        let folder = folder.expect("an entry").path();
        for file in std::fs::read_dir(&folder).expect("a folder of shaders/") {
            let file = file.expect("an entry").path();
            let path = file.strip_prefix(&root).expect("below shaders/").to_string_lossy();
            assert!(joined.contains(&path.as_ref()), "{path} is joined into no module");
        }
    }
}

/// A pass's shader has the stem of its Rust half.
#[test]
fn every_pass_file_has_its_rust_half() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for module in MODULES {
        let last = module.files.last().expect("at least one file").path;
        assert_eq!(last, format!("pass/{}.wgsl", module.label));
        assert!(root.join(format!("src/render/pass/{}.rs", module.label)).is_file());
    }
}

#[test]
fn host_constants_match_their_wgsl_twins() {
    let whole = f64::from;
    let host = [
        ("MAX_LIGHTS", MAX_LIGHTS as f64),
        ("GRADIENT_ENTRIES", uniforms::GRADIENT_ENTRIES as f64),
        ("WORKGROUP_SIDE", whole(lattice::WORKGROUP_SIDE)),
        ("WORKGROUP_THREADS", whole(lattice::WORKGROUP_THREADS)),
        ("BLOCK_THREADS", whole(work_queues::BLOCK_THREADS)),
        ("BLOCKS", whole(lattice::WORKGROUP_THREADS / work_queues::BLOCK_THREADS)),
        ("RAY_QUEUES", work_queues::RAY_QUEUES as f64),
        ("SERIES", uniforms::SERIES as f64),
        ("MOST_REFERENCE_POINTS", deep::reference::MOST_REFERENCE_POINTS as f64),
        ("MOST_NEAR_STEPS", uniforms::MOST_NEAR_STEPS as f64),
        ("FIRST_RADIUS", uniforms::FIRST_RADIUS),
        ("RADII_RATIO", uniforms::RADII_RATIO),
        ("CLOSE", deep::CLOSE),
        ("SIDEWAYS_MAX", estimator::SIDEWAYS_MAX),
        ("DEEP_SIDEWAYS_MAX", estimator::DEEP_SIDEWAYS_MAX),
        ("LEAST_STEP", march::LEAST_STEP),
        ("LEAST_STEP_WITH_HIT_CHECK", march::LEAST_STEP_WITH_HIT_CHECK),
        ("THICK", march::THICK),
        ("THICK_PLACES", whole(march::THICK_PLACES)),
        ("HALVINGS", whole(march::HALVINGS)),
        ("HISTOGRAM_BINS", report::HISTOGRAM_BINS as f64),
        ("HISTOGRAM_LOW_STOPS", report::HISTOGRAM_LOW_STOPS),
        ("HISTOGRAM_BINS_PER_STOP", report::HISTOGRAM_BINS_PER_STOP),
        ("FIRST_MIP_LEVEL", whole(post::FIRST_LEVEL)),
    ];
    for (name, value) in host {
        let files = MODULES.iter().flat_map(|module| module.files);
        let found: Vec<_> = files.filter_map(|file| constant(file.text, name)).collect();
        assert!(!found.is_empty(), "no shader has {name}");
        for text in found {
            assert_eq!(text.trim_end_matches('u').parse(), Ok(value), "{name}");
        }
    }
}

/// The value of a constant in a shader's text. Parsed modules have no more those that are of no
/// one type.
fn constant<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let named =
        |line: &'a str| line.strip_prefix("const ")?.strip_prefix(name)?.strip_prefix(" = ");
    text.lines().find_map(named)?.split(';').next()
}
