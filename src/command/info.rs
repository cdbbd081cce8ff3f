//! `mandelight info`: which GPU would be used, and which there are.

use std::fmt::Write;

use mandelight::gpu::device;
use serde_json::{Value, json};

use super::{Failure, adapter::AdapterArguments, print};

/// What `mandelight info` takes.
#[derive(clap::Args)]
pub struct Arguments {
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// Prints the GPU's particulars.
pub fn run(arguments: Arguments) -> Result<(), Failure> {
    let gpu = arguments.adapter.open()?;
    let info = gpu.adapter.get_info();
    let limits = limits_of(&gpu.device.limits());
    let formats = formats_of(&gpu.adapter);
    let adapters = pollster::block_on(device::adapter_names());

    if arguments.json {
        let facts = json!({
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
        return print(&format!("{facts:#}\n"));
    }

    let mut text = String::new();
    let mut line = |name: &str, value: &str| {
        // Writing to a string does not fail.
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
    print(&text)
}

/// The limits that the device was asked for and the renderer works within, by WebGPU's names.
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

/// The renderer's texture formats that the adapter can write from a shader.
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
