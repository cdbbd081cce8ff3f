//! `mandelight info`: the GPU, its limits, the other GPUs, and the memory of a view.

use std::{fmt::Write, sync::Arc};

use mandelight::{
    gpu::{Gpu, device},
    render::{
        MAX_REGION_PIXELS, MAX_REGION_PX, Pace, Pipelines, Region, View,
        memory::{self, Memory},
    },
    scene::{EnvironmentMap, Scene},
};
use serde_json::{Value, json};

use super::{Failure, adapter::AdapterArguments, print};

/// The arguments of `mandelight info`.
#[derive(clap::Args)]
pub struct InfoArguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
    /// Also print the GPU memory of a view of this size with every effect on: stereo, 64 lights,
    /// indirect light, auto exposure, bloom, an environment map; and of one in path-traced light
    #[arg(long, value_name = "WxH", value_parser = super::render::parse_size)]
    size: Option<[u32; 2]>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// Prints the properties of the GPU.
pub fn run(arguments: InfoArguments) -> Result<(), Failure> {
    let gpu = arguments.adapter.open()?;
    let info = gpu.adapter.get_info();
    let limits = limits_of(&gpu.device.limits());
    let formats = formats_of(&gpu.adapter);
    let adapters = pollster::block_on(device::adapter_names());
    let memory_of = |what| arguments.size.map(|size_px| memory_of(&gpu, size_px, what)).transpose();
    let memory = memory_of(memory::everything_on())?;
    let traced = memory_of(memory::everything_traced())?;

    if arguments.json {
        let mut facts = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "adapter": gpu.name(),
            "type": format!("{:?}", info.device_type),
            "backend": format!("{:?}", info.backend),
            "driver": info.driver,
            "driver_info": info.driver_info,
            "limits": limits.iter().map(|&(name, value)| (name.to_owned(), value.into())).collect::<serde_json::Map<_, Value>>(),
            "formats": formats,
            "adapters": adapters,
        });
        if let Some(memory) = memory {
            let purposes = memory.purposes().into_iter();
            facts["memory_bytes"] = purposes
                .map(|(purpose, bytes)| (purpose.replace(' ', "_"), bytes.into()))
                .collect::<serde_json::Map<_, Value>>()
                .into();
            facts["total_bytes"] = memory.total().into();
        }
        if let Some(traced) = traced {
            facts["total_bytes_with_path_tracing"] = traced.total().into();
        }
        return print(&format!("{facts:#}\n"));
    }

    let mut text = String::new();
    let mut line = |name: &str, value: &str| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<12}{value}");
    };
    line("mandelight", env!("CARGO_PKG_VERSION"));
    line("adapter", &gpu.name());
    line("type", &format!("{:?}", info.device_type));
    line("driver", format!("{} {}", info.driver, info.driver_info).trim());
    for (i, (name, value)) in limits.iter().enumerate() {
        line(if i == 0 { "limits" } else { "" }, &format!("{name} {value}"));
    }
    line("formats", &formats.join(", "));
    for (i, name) in adapters.iter().enumerate() {
        line(if i == 0 { "adapters" } else { "" }, name);
    }
    if let Some(memory) = memory {
        for (i, (purpose, bytes)) in memory.purposes().into_iter().enumerate() {
            let value = format!("{bytes:>12} {purpose}");
            line(if i == 0 { "memory" } else { "" }, &value);
        }
        let _ = writeln!(text, "total_bytes {}", memory.total());
    }
    if let Some(traced) = traced {
        let _ = writeln!(text, "total_bytes_with_path_tracing {}", traced.total());
    }
    print(&text)
}

/// Creates a view of `size_px` of a scene with every effect on and measures its GPU memory.
fn memory_of(
    gpu: &Gpu,
    size_px: [u32; 2],
    (scene, environment_map): (Scene, Arc<EnvironmentMap>),
) -> Result<Memory, Failure> {
    let region = Region::whole(size_px).shared_by(scene.camera.stereo.layout);
    if !region.fits() {
        let [width, height] = size_px;
        return Err(Failure::usage(format!(
            "{width}x{height} is too large for one view: the limits are {MAX_REGION_PX} pixels per side and {MAX_REGION_PIXELS} pixels in all"
        )));
    }
    let mut view = View::new(&Pipelines::new(gpu), region, Pace::Interactive);
    view.set_environment_map(Some(&environment_map));
    view.set_scene(&scene, false);
    view.pump(0.0);
    gpu.wait();
    Ok(view.report().memory)
}

/// The device's limits that matter to the renderer, by WebGPU's names.
fn limits_of(limits: &wgpu::Limits) -> Vec<(&'static str, u64)> {
    vec![
        ("maxTextureDimension2D", limits.max_texture_dimension_2d.into()),
        ("maxBindGroups", limits.max_bind_groups.into()),
        ("maxStorageBuffersPerShaderStage", limits.max_storage_buffers_per_shader_stage.into()),
        ("maxStorageTexturesPerShaderStage", limits.max_storage_textures_per_shader_stage.into()),
        ("maxStorageBufferBindingSize", limits.max_storage_buffer_binding_size),
        ("maxBufferSize", limits.max_buffer_size),
        ("maxComputeInvocationsPerWorkgroup", limits.max_compute_invocations_per_workgroup.into()),
        ("maxComputeWorkgroupStorageSize", limits.max_compute_workgroup_storage_size.into()),
    ]
}

/// The renderer's texture formats that shaders can write on this adapter.
fn formats_of(adapter: &wgpu::Adapter) -> Vec<&'static str> {
    [("rgba8unorm", wgpu::TextureFormat::Rgba8Unorm)]
        .into_iter()
        .filter(|&(_, format)| {
            adapter
                .get_texture_format_features(format)
                .allowed_usages
                .contains(wgpu::TextureUsages::STORAGE_BINDING)
        })
        .map(|(name, _)| name)
        .collect()
}
