//! Every shader module parses and validates under default WebGPU capabilities, and every struct
//! that the host shares with it has the same fields at the same places.

use std::collections::BTreeMap;

use mandelight::{
    render::{lattice, lists, pass::MODULES, uniforms},
    scene::MAX_LIGHTS,
};
use naga::{
    TypeInner,
    proc::Layouter,
    valid::{Capabilities, ValidationFlags, Validator},
};

/// Name, offset and size of each field, and the whole size: of a WGSL struct.
type StructLayout = (u32, Vec<(String, u32, u32)>);

fn parsed(module: &mandelight::gpu::shader::Module) -> naga::Module {
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
    for module in MODULES {
        let text = module.text();
        Validator::new(ValidationFlags::all(), Capabilities::default())
            .validate(&parsed(module))
            .unwrap_or_else(|error| panic!("{}: {}", module.label, error.emit_to_string(&text)));
    }
}

#[test]
fn every_pass_has_one_entry_point_of_64_threads_within_default_limits() {
    for module in MODULES {
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

/// Else it would be all zeros: see `types/picture.wgsl`.
#[test]
fn every_pass_begins_by_reading_the_picture() {
    for module in MODULES {
        let text = module.text();
        let (_, main) = text.split_once("fn main(").expect("an entry point");
        let (_, body) = main.split_once("{\n").expect("its body");
        let first = body.lines().next().map(str::trim);
        assert_eq!(first, Some("picture = given.picture;"), "{}", module.label);
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
    let host = [
        ("MAX_LIGHTS", MAX_LIGHTS),
        ("GRADIENT_ENTRIES", uniforms::GRADIENT_ENTRIES),
        ("WORKGROUP_SIDE", lattice::WORKGROUP_SIDE as usize),
        ("WORKGROUP_THREADS", lattice::WORKGROUP_THREADS as usize),
        ("BLOCK_THREADS", lists::BLOCK_THREADS as usize),
        ("BLOCKS", (lattice::WORKGROUP_THREADS / lists::BLOCK_THREADS) as usize),
        ("RAY_LISTS", lists::RAY_LISTS),
        ("SKIPS", uniforms::SKIPS),
        ("NEAR_PLACES", uniforms::NEAR_PLACES),
    ];
    for (name, value) in host {
        let mut seen = 0;
        for module in MODULES.iter().map(|module| parsed(module)) {
            let named = module.constants.iter().filter(|(_, c)| c.name.as_deref() == Some(name));
            for (_, constant) in named {
                let naga::Expression::Literal(naga::Literal::U32(found)) =
                    module.global_expressions[constant.init]
                else {
                    panic!("{name} is no whole number");
                };
                assert_eq!(found as usize, value, "{name}");
                seen += 1;
            }
        }
        assert!(seen > 0, "no shader has {name}");
    }
}
