//! `cargo xtask bench`: the renderer's speed beside that of the thesis's own algorithm.
//!
//! In: the command line. Out: tables for people, and lines `ratio <view> <value>` for scripts, of
//! fixed views drawn by both sides in turn on one adapter.
//!
//! | file | what lives there |
//! |---|---|
//! | `arguments` | the command line |
//! | `views` | what is drawn |
//! | `literal` | the thesis's algorithm on the GPU |
//! | `kindness` | its kindest honest settings |
//! | `ours` | the program's stills, and its passes one by one |
//! | `picture` | what both sides draw, as files |
//! | `statistics` | medians, quantiles |

mod arguments;
mod kindness;
mod literal;
mod ours;
mod picture;
mod statistics;
mod views;

use std::{process::ExitCode, sync::Arc};

use arguments::Arguments;
use clap::Parser as _;
use mandelight::{
    gpu::Gpu,
    render::{Kernels, Region, uniforms::Inputs},
};
use views::View;

type Failure = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("bench: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let views = chosen(arguments)?;
    let gpu = pollster::block_on(Gpu::open(arguments.adapter_name().as_deref()))?;
    println!("adapter {}", gpu.name());
    let kernels = Kernels::new(&gpu);
    let literal = literal::Literal::new(&gpu);
    for view in &views {
        compare(arguments, &kernels, &literal, view)?;
    }
    match gpu.faults() {
        0 => Ok(()),
        faults => Err(format!("the device reported {faults} errors").into()),
    }
}

/// The views that were asked for, in the size that was asked for.
fn chosen(arguments: &Arguments) -> Result<Vec<View>, Failure> {
    let mut views = views::all();
    for name in &arguments.views {
        if !views.iter().any(|view| view.name == name) {
            let names: Vec<_> = views.iter().map(|view| view.name).collect();
            return Err(format!("there is no view {name:?}; there are {}", names.join(", ")).into());
        }
    }
    views.retain(|view| {
        arguments.views.is_empty() || arguments.views.iter().any(|name| name == view.name)
    });
    for view in &mut views {
        view.size_px = arguments.size.unwrap_or(view.size_px);
    }
    Ok(views)
}

fn compare(
    arguments: &Arguments,
    kernels: &Arc<Kernels>,
    literal: &literal::Literal,
    view: &View,
) -> Result<(), Failure> {
    let View { name, about, scene, size_px, stride } = view;
    let [width, height] = *size_px;
    let samples = scene.quality.samples;
    println!(
        "\n{name}: {about}; {width}x{height}, {samples} samples, {} lights",
        scene.lights.len()
    );
    let kindness = kindness::find(scene, *size_px);
    println!(
        "  literal: epsilon {:.3e}, {} iterations; ours: {} iterations",
        kindness.epsilon, kindness.iterations, scene.fractal.iterations
    );
    let inputs = Inputs::new(scene, Region::whole(*size_px));
    let picture = literal::Picture::new(literal, &inputs, samples, kindness, *stride);
    // Pipelines are compiled, and drivers have seen them.
    picture.draw_ms();
    let (_, shown) = ours::draw_ms(kernels, scene, *size_px);
    if let Some(folder) = &arguments.pictures {
        std::fs::create_dir_all(folder)?;
        let ours = ours::display(kernels, &shown)?;
        picture::write(&folder.join(format!("{name}.png")), *size_px, &ours)?;
        let (exposure, white) = (scene.tone.exposure, scene.tone.white_point);
        let literal = picture::developed(&picture.seen()?, *size_px, exposure, white);
        picture::write(&folder.join(format!("{name}-literal.png")), *size_px, &literal)?;
    }
    let (mut literal_ms, mut ours_ms) = (Vec::new(), Vec::new());
    for _ in 0..arguments.rounds {
        literal_ms.push(picture.draw_ms());
        ours_ms.push(ours::draw_ms(kernels, scene, *size_px).0);
    }
    let [literal_ms, ours_ms] = [literal_ms, ours_ms].map(|times| statistics::median(&times));
    println!("  literal {literal_ms:.1} ms, ours {ours_ms:.1} ms");
    if arguments.passes {
        passes(arguments, kernels, view, ours_ms);
    }
    println!("ratio {name} {:.2}", literal_ms / ours_ms);
    Ok(())
}

/// Times the program's passes over one sample of each pixel.
fn passes(arguments: &Arguments, kernels: &Kernels, view: &View, still_ms: f64) {
    let split = ours::Split::new(kernels, &view.scene, view.size_px);
    split.draw_ms();
    let rounds: Vec<_> = (0..arguments.rounds).map(|_| split.draw_ms()).collect();
    let mut sum_ms = 0.0;
    for (index, (name, _)) in rounds[0].iter().enumerate() {
        let times: Vec<_> = rounds.iter().map(|round| round[index].1).collect();
        let ms = statistics::median(&times);
        sum_ms += ms;
        println!("  pass {name} {ms:.1} ms");
    }
    let rest_ms = still_ms / f64::from(view.scene.quality.samples) - sum_ms;
    println!("  rest {rest_ms:.1} ms a sample: tone mapping, slicing");
}
