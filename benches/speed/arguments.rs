//! The command line.
//!
//! In: words. Out: which views and tables to measure, how, and which files to write.

use std::path::PathBuf;

use clap::Parser;
use mandelight::export;

/// Compares the renderer with the thesis's own algorithm, in one run on one adapter.
#[derive(Clone, Debug, Parser)]
#[command(name = "bench", bin_name = "cargo xtask bench")]
pub struct Arguments {
    /// Names of views and tables to run, separated by commas [default: all]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub views: Vec<String>,
    /// Draw every view at this size instead of its own, such as 320x180
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,
    /// Rounds in which each side draws one picture; results are medians
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub rounds: u32,
    /// Limit the descent to places whose names contain one of these, such as streaky-8
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub places: Vec<String>,
    /// Also time each of the program's passes over the whole picture
    #[arg(long)]
    pub passes: bool,
    /// About how many pixels to compare with the reference in f64
    #[arg(long, value_name = "N", default_value_t = 4000)]
    pub error_pixels: u32,
    /// Also write both sides' pictures as PNG files to this folder
    #[arg(long, value_name = "FOLDER")]
    pub pictures: Option<PathBuf>,
    /// Also write the scenes of `pieces` to this folder, for benches/page/pieces.mjs
    #[arg(long, value_name = "FOLDER")]
    pub keep_scenes: Option<PathBuf>,
    /// Also write all results as JSON to this file, or to standard output for -
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Also replace the tables of this file, docs/benchmark.md
    #[arg(long, value_name = "FILE")]
    pub tables: Option<PathBuf>,
    /// Fail if a ratio does not count or, at the views' own sizes, if a measurement breaks its
    /// limit
    #[arg(long)]
    pub check: bool,
    /// Also tighten the limits of this file, benches/speed/limits.txt, to the results
    #[arg(long, value_name = "FILE", conflicts_with_all = ["size", "places"])]
    pub tighten: Option<PathBuf>,
    /// Use the first GPU whose name contains this, in any case [env: WGPU_ADAPTER_NAME]
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Start once and print the times
    #[arg(long, hide = true)]
    pub start_once: bool,
    /// Compile each formula's passes once and print the times
    #[arg(long, hide = true)]
    pub compile_once: bool,
    /// Cargo passes this flag to every benchmark
    #[arg(long, hide = true)]
    pub bench: bool,
}

impl Arguments {
    /// True if a view or table is selected by name, or nothing is.
    pub fn wants(&self, name: &str) -> bool {
        self.views.is_empty() || self.views.iter().any(|wanted| wanted == name)
    }

    /// Part of the adapter's name, from the flag or the environment.
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
