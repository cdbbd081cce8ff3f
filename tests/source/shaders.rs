//! Every shader module parses and validates under default WebGPU capabilities, and every struct
//! that the host shares with it has the same fields at the same places.

use std::{collections::BTreeMap, sync::LazyLock};

use mandelight::{
    formula::{
        self, Kernel, language,
        mandelbulb::{
            self, deep, estimator,
            variant::{Steps, Variant},
        },
        march,
    },
    gpu::{host_shared::HostShared, shader::Module},
    render::{
        lattice,
        pass::{self, Pass},
        post, report, shaders, uniforms, work_queues,
    },
    scene::{Fractal, MAX_LIGHTS},
};
use mandelight_test_support::probe;
use naga::{
    TypeInner,
    proc::Layouter,
    valid::{Capabilities, ValidationFlags, Validator},
};

/// Every kernel of every formula that is specialised in another way.
fn kernels() -> Vec<Kernel> {
    let of = |fractal: Fractal| {
        let formula = fractal.formula();
        let dive = formula.dive_variants(&fractal, 0);
        [0].into_iter().chain(dive).map(move |variant| Kernel { formula, variant })
    };
    let steps = [Steps::RotatingFrame].map(|steps| Variant { power: 8, steps }.number());
    let rotating = steps.map(|variant| Kernel { formula: Fractal::default().formula(), variant });
    formula::all().flat_map(|formula| of(Fractal::new(formula))).chain(rotating).collect()
}

/// The module of every pass with every kernel, and the probe's.
static MODULES: LazyLock<Vec<Module>> = LazyLock::new(|| {
    let of = |pass: &Pass| match pass.set.has_kernel {
        false => vec![shaders::module(pass.name, None)],
        true => kernels().into_iter().map(|k| shaders::module(pass.name, Some(k))).collect(),
    };
    pass::all().flat_map(of).chain(kernels().into_iter().map(probe::module)).collect()
});

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

#[test]
fn every_module_validates() {
    for module in MODULES.iter() {
        let text = module.text();
        Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&parsed(module))
            .unwrap_or_else(|error| panic!("{}: {}", module.label, error.emit_to_string(&text)));
    }
}

#[test]
fn every_pass_has_one_entry_point_of_64_threads_within_default_limits() {
    for module in MODULES.iter() {
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

/// A host-shared struct: its name in WGSL, its size in bytes and its fields.
type HostStruct = (&'static str, usize, &'static [(&'static str, usize, usize)]);

/// The structs of the renderer.
fn render_structs() -> impl Iterator<Item = HostStruct> {
    uniforms::HOST_SHARED.iter().chain(uniforms::OF_DISPATCHES).copied()
}

/// The structs of a formula, whose kernels' files begin with its id.
fn formula_structs(id: &str) -> Vec<HostStruct> {
    match id {
        "mandelbulb" => mandelbulb::uniforms::HOST_SHARED.to_vec(),
        _ => {
            let [(_, size, fields)] = *language::uniforms::HOST_SHARED else {
                panic!("one struct")
            };
            vec![("Fractal", size, fields)]
        }
    }
}

#[test]
fn host_structs_match_their_wgsl_twins() {
    let mut seen = Vec::new();
    for module in MODULES.iter() {
        let wgsl = structs(&parsed(module));
        let formula = formula::all().find(|formula| {
            module.files.iter().any(|file| file.path.starts_with(&format!("{}/", formula.id())))
        });
        let own = formula.map_or_else(Vec::new, |formula| formula_structs(formula.id()));
        for (name, size, fields) in render_structs().chain(own) {
            let Some((span, members)) = wgsl.get(name) else { continue };
            seen.push((name, size));
            let mut members = members.clone();
            if name == "FrameUniforms" {
                // The formula's part follows the host's fields.
                let (last, offset, _) = members.pop().expect("a field");
                assert_eq!((last.as_str(), offset), ("formula", size as u32));
            } else {
                assert_eq!(size as u32, *span, "size of {name} in {}", module.label);
            }
            let host: Vec<_> = fields
                .iter()
                .map(|(field, offset, size)| (field.to_string(), *offset as u32, *size as u32))
                .collect();
            assert_eq!(host, members, "fields of {name} in {}", module.label);
        }
    }
    let formulas = formula::all().flat_map(|formula| formula_structs(formula.id()));
    for (name, size, _) in render_structs().chain(formulas) {
        assert!(seen.contains(&(name, size)), "no shader knows the host's struct {name}");
    }
}

#[test]
fn formulas_fit_their_buffers() {
    for formula in formula::all() {
        for (name, size, _) in formula_structs(formula.id()) {
            assert!(size <= formula::contract::MAX_UNIFORM_BYTES, "{name} of {}", formula.id());
        }
    }
    let anchor_orbit = mandelbulb::uniforms::SERIES
        * mandelbulb::uniforms::SeriesApproximation::SIZE
        + deep::reference::MAX_REFERENCE_POINTS * mandelbulb::uniforms::ReferencePoint::SIZE;
    assert!(anchor_orbit <= formula::contract::MAX_TABLE_BYTES);
}

/// Else `frame` would be all zeros: see `types/frame_uniforms.wgsl`.
#[test]
fn every_pass_begins_by_reading_the_frame_uniforms() {
    for module in MODULES.iter() {
        let text = module.text();
        let (_, main) = text.split_once("fn main(").expect("an entry point");
        let (_, body) = main.split_once("{\n").expect("its body");
        let first = body.lines().next().map(str::trim);
        assert_eq!(first, Some("read_frame();"), "{}", module.label);
    }
}

/// A file in `shaders/` that no module joins is dead.
#[test]
fn every_shader_file_is_part_of_a_module() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let joined: Vec<_> =
        MODULES.iter().flat_map(|module| &module.files).map(|file| file.path).collect();
    for folder in std::fs::read_dir(&root).expect("shaders/") {
        let folder = folder.expect("an entry").path();
        for file in std::fs::read_dir(&folder).expect("a folder of shaders/") {
            let file = file.expect("an entry").path();
            let path = file.strip_prefix(&root).expect("below shaders/").to_string_lossy();
            let path = path.strip_suffix(".wgsl").expect("a WGSL file");
            let path = if folder.ends_with("pass") { file_stem(path) } else { path };
            assert!(joined.contains(&path), "{path} is joined into no module");
        }
    }
}

/// A pass's shader has the stem of its Rust half.
#[test]
fn every_pass_file_has_its_rust_half() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for pass in pass::all() {
        for half in ["src/render/pass/{}.rs", "shaders/pass/{}.wgsl"] {
            assert!(root.join(half.replace("{}", pass.name)).is_file(), "{half} of {}", pass.name);
        }
    }
}

/// Else a module would grow by what nobody reads any more.
#[test]
fn headers_name_only_files_that_are_used() {
    for module in MODULES.iter() {
        let (root, used) = module.files.split_last().expect("a pass");
        for file in used {
            let mut names = declared(file.text);
            if file.path == "types/frame_uniforms" {
                names.extend(declared(&module.generated));
            }
            let is_used =
                module.files.iter().filter(|other| other.path != file.path).any(|other| {
                    let words: Vec<_> = code(other.text)
                        .split(|c: char| c != '_' && !c.is_alphanumeric())
                        .map(str::to_owned)
                        .collect();
                    names.iter().any(|name| words.contains(name))
                });
            assert!(is_used, "{} joins {}, of which it uses nothing", root.path, file.path);
        }
    }
}

/// WGSL text without its comments.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

/// The names that a file declares at its top level.
fn declared(text: &str) -> Vec<String> {
    let declaration = |line: &str| {
        let line = line
            .rsplit_once(") ")
            .filter(|(before, _)| before.starts_with('@'))
            .map_or(line, |(_, rest)| rest)
            .to_owned();
        let keyword = line.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("");
        if !["fn", "struct", "const", "override", "alias", "var"].contains(&keyword) {
            return None;
        }
        let rest = line[keyword.len()..].trim_start();
        let rest = if rest.starts_with('<') { rest.split_once('>')?.1.trim_start() } else { rest };
        rest.split(|c: char| c != '_' && !c.is_alphanumeric()).next().map(str::to_owned)
    };
    code(text).lines().filter_map(declaration).collect()
}

#[test]
fn host_constants_match_their_wgsl_twins() {
    let whole = f64::from;
    let host = [
        ("MAX_LIGHTS", MAX_LIGHTS as f64),
        ("GRADIENT_ENTRIES", uniforms::GRADIENT_ENTRIES as f64),
        ("WORKGROUP_SIDE", whole(lattice::WORKGROUP_SIDE)),
        ("WORKGROUP_THREADS", whole(lattice::WORKGROUP_THREADS)),
        ("BLOCK_THREADS", whole(lattice::BLOCK_THREADS)),
        ("BLOCKS", whole(lattice::WORKGROUP_BLOCKS)),
        ("RAY_QUEUES", work_queues::RAY_QUEUES as f64),
        ("SERIES", mandelbulb::uniforms::SERIES as f64),
        ("MAX_REFERENCE_POINTS", deep::reference::MAX_REFERENCE_POINTS as f64),
        ("MAX_NEAR_STEPS", mandelbulb::variant::MAX_NEAR_STEPS as f64),
        ("FIRST_RADIUS", mandelbulb::uniforms::FIRST_RADIUS),
        ("RADII_RATIO", mandelbulb::uniforms::RADII_RATIO),
        ("CLOSE", deep::CLOSE),
        ("SIDEWAYS_MAX", estimator::SIDEWAYS_MAX),
        ("DEEP_SIDEWAYS_MAX", estimator::DEEP_SIDEWAYS_MAX),
        ("MIN_STEP", march::MIN_STEP),
        ("MIN_STEP_WITH_HIT_CHECK", march::MIN_STEP_WITH_HIT_CHECK),
        ("CHECKED_THICKNESS", march::CHECKED_THICKNESS),
        ("THICKNESS_CHECKS", whole(march::THICKNESS_CHECKS)),
        ("HALVINGS", whole(march::HALVINGS)),
        ("HISTOGRAM_BINS", report::HISTOGRAM_BINS as f64),
        ("HISTOGRAM_LOW_STOPS", report::HISTOGRAM_LOW_STOPS),
        ("HISTOGRAM_BINS_PER_STOP", report::HISTOGRAM_BINS_PER_STOP),
        ("SAMPLES_PER_ROUND", whole(pass::assess_noise::SAMPLES_PER_ROUND)),
        ("MIN_ROUNDS", whole(pass::assess_noise::MIN_ROUNDS)),
        ("FIRST_MIP_LEVEL", whole(post::FIRST_LEVEL)),
    ];
    for (name, value) in host {
        let files = MODULES.iter().flat_map(|module| &module.files);
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

fn file_stem(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}
