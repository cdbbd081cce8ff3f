//! What the command line asks for.

use std::path::PathBuf;

use clap::Parser;
use mandelight::export;

/// Measures the renderer beside the thesis's own algorithm, in one run on one adapter.
#[derive(Clone, Debug, Parser)]
#[command(name = "bench", bin_name = "cargo xtask bench")]
pub struct Arguments {
    /// Views and tables to run, by name, separated by commas; all of them unless told
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub views: Vec<String>,
    /// Draw every view in this size rather than its own, such as 320x180
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Rounds of one picture by either side; medians are told
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Of the descent, only places whose names contain one of these, such as streaky-8
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub places: Vec<String>,
    /// Also time the program's passes one by one, each a dispatch over the whole picture
    #[arg(long)]
    pub passes: bool,
    /// About how many pixels are compared with the reference in f64
    #[arg(long, value_name = "N", default_value_t = 4000)]
    pub error_pixels: u32,
    /// Also write what both sides draw, as PNG files, to this folder
    #[arg(long, value_name = "FOLDER")]
    pub pictures: Option<PathBuf>,
    /// Also write everything that was measured to this file, or - for standard output, as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Also put the tables into this file, docs/benchmark.md, in place of its own
    #[arg(long, value_name = "FILE")]
    pub tables: Option<PathBuf>,
    /// Fail where a picture is not good enough for its ratio to count, or, in the views' own sizes,
    /// where a limit is broken
    #[arg(long)]
    pub check: bool,
    /// Also tighten the limits in this file, benches/speed/limits.txt, to what was measured
    #[arg(long, value_name = "FILE", conflicts_with_all = ["size", "places"])]
    pub tighten: Option<PathBuf>,
    /// Use the first GPU whose name contains this, in any case [env: WGPU_ADAPTER_NAME]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Start once and say how long that took
    #[arg(long, hide = true)]
    pub start_once: bool,
    /// Cargo says so of every benchmark
    #[arg(long, hide = true)]
    pub bench: bool,
}

impl Arguments {
    /// True where a view or a table was asked for, or nothing in particular.
    pub fn wants(&self, name: &str) -> bool {
        self.views.is_empty() || self.views.iter().any(|wanted| wanted == name)
    }

    /// The wanted adapter's name, where there is one.
    pub fn adapter_name(&self) -> Option<String> {
        let wanted = self.adapter.clone().or_else(|| std::env::var("WGPU_ADAPTER_NAME").ok());
        wanted.filter(|name| !name.is_empty())
    }
}

fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let sides = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    let sides = sides.ok_or("write it as width x height in pixels, such as 320x180")?;
    export::checked_size(sides).map_err(|error| error.to_string())
}
