//! The tables of `docs/benchmark.md`.
//!
//! In: the page's text and a report. Out: the text with the report's tables between their
//! markers. Tables without results in the report stay.

use std::fmt::Write as _;

use super::{
    compare::Comparison, counts::Counts, descent::Row, formulas, mandelbulber, paths::Side,
    report::Report,
};

/// `text` with the tables of `report`.
///
/// # Errors
/// If a table's markers are missing.
pub fn updated(mut text: String, report: &Report) -> Result<String, String> {
    let mut tables = Vec::new();
    if !report.views.is_empty() {
        tables.push(("times", times(report)));
        tables.push(("errors", errors(&report.views)));
        tables.push(("counts", counts(&report.views)));
    }
    if let Some(powers) = &report.powers {
        let mut table = head(&["power", "products", "own kernel", "fit", "general kernel"]);
        for row in &powers.rows {
            let ns = [row.special_ns, row.fitted_ns, row.general_ns].map(|ns| format!("{ns:.2}"));
            line(
                &mut table,
                [row.power.to_string(), row.products.to_string()].into_iter().chain(ns),
            );
        }
        let (fixed, product, worst) = (powers.fixed_ns, powers.product_ns, powers.worst);
        let _ = writeln!(
            table,
            "\nFit: {fixed:.2} ns and {product:.2} ns a product; no power is further off than {worst:.2} times."
        );
        tables.push(("powers", table));
    }
    if !report.deep.is_empty() {
        tables.push(("deep", deep(report)));
    }
    if !report.descent.is_empty() {
        tables.push(("descent", descent(report)));
    }
    if !report.paths.is_empty() {
        tables.push(("light paths", paths(report)));
    }
    if !report.mandelbulber.is_empty() {
        tables.push(("mandelbulber", mandelbulber(report)));
    }
    if !report.scaling.is_empty() {
        let mut table = head(&["asked for", "beside", "times as much", "times as long"]);
        for row in report.scaling.iter().filter(|row| row.factor > 1.0) {
            let numbers = [row.factor, row.growth].map(|factor| format!("{factor:.2}"));
            line(&mut table, [row.name.into(), row.against.into()].into_iter().chain(numbers));
        }
        tables.push(("scaling", table));
    }
    if let Some(start) = &report.start {
        let mut table = head(&["milliseconds", "first visit", "later"]);
        for (name, part) in super::start::PARTS {
            let ms = [part(&start.first), part(&start.later)].map(|ms| format!("{ms:.0}"));
            line(&mut table, [(*name).to_owned()].into_iter().chain(ms));
        }
        tables.push(("start", table));
    }
    if !report.step_costs.is_empty() {
        let mut table = head(&["formula", "baseline", "estimate", "gradient"]);
        for row in &report.step_costs {
            let gradient =
                row.gradient.map_or("–".to_owned(), |gradient| format!("{gradient:.2}"));
            let cells = [row.formula.into(), row.baseline.into(), format!("{:.2}", row.estimate)];
            line(&mut table, cells.into_iter().chain([gradient]));
        }
        tables.push(("steps", table));
    }
    if !report.formulas.is_empty() {
        tables.push(("formulas", formulas(&report.formulas)));
    }
    if !report.pieces.is_empty() {
        tables.push(("pieces", pieces(report)));
    }
    for (name, table) in tables {
        let (begin, end) = (format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->"));
        let missing = || format!("there are no markers for a table of {name}");
        let from = text.find(&begin).ok_or_else(missing)? + begin.len();
        let to = from + text[from..].find(&end).ok_or_else(missing)?;
        text.replace_range(from..to, &table);
    }
    Ok(text)
}

fn head(columns: &[&str]) -> String {
    format!("| {} |\n|{}\n", columns.join(" | "), "---|".repeat(columns.len()))
}

fn line(table: &mut String, cells: impl Iterator<Item = String>) {
    let cells: Vec<_> = cells.collect();
    let _ = writeln!(table, "| {} |", cells.join(" | "));
}

fn pieces(report: &Report) -> String {
    let mut table = format!("On {}:\n\n", report.adapter);
    table += &head(&[
        "scenes",
        "pieces",
        "median, budgets",
        "99 %, budgets",
        "over two budgets",
        "longest, ms",
        "longest display, ms",
    ]);
    for row in &report.pieces {
        let cells = [
            format!("{} of {}", row.scenes, row.name),
            row.pieces.to_string(),
            format!("{:.2}", row.median),
            format!("{:.2}", row.most),
            format!("{:.1} %", row.over),
            format!("{:.0}", row.longest_ms),
            format!("{:.0}", row.display_ms),
        ];
        line(&mut table, cells.into_iter());
    }
    table
}

fn times(report: &Report) -> String {
    let mut table = format!("On {}:\n\n", report.adapter);
    table += &head(&["view", "pixels", "samples", "lights", "literal, ms", "ours, ms", "ratio"]);
    for view in &report.views {
        let [width, height] = view.size_px;
        let counts = if view.complaints.is_empty() { "" } else { " (does not count)" };
        let cells = [
            format!("`{}`: {}", view.view, view.about),
            format!("{width}×{height}"),
            view.samples.to_string(),
            view.lights.to_string(),
            format!("{:.0}", view.literal.ms),
            format!("{:.0}", view.ours.ms),
            format!("{:.1}{counts}", view.ratio),
        ];
        line(&mut table, cells.into_iter());
    }
    table
}

fn deep(report: &Report) -> String {
    let columns =
        ["view", "drawn", "ms", "estimates a pixel", "orbit steps an estimate", "ns an estimate"];
    let mut table = head(&[columns.as_slice(), &["cost"]].concat());
    for row in &report.deep {
        let Counts { estimates, steps } = row.counts;
        let drawn = if row.is_deep { "from an anchor" } else { "plain" };
        let numbers = [
            format!("{:.0}", row.ms),
            format!("{estimates:.1}"),
            format!("{:.1}", steps / estimates),
            format!("{:.1}", row.estimate_ns),
            format!("{:.1}", row.cost),
        ];
        line(&mut table, [format!("`{}`", row.name), drawn.to_owned()].into_iter().chain(numbers));
    }
    table
}

fn paths(report: &Report) -> String {
    let columns = [
        "view",
        "µs a path",
        "paths a second",
        "estimates a path",
        "variance a sample",
        "mean radiance",
        "speedup at equal noise",
        "estimates of bounces 1, 2, 3–4, 5–8",
    ];
    let mut table = format!("On {}:\n\n", report.adapter);
    table += &head(&columns);
    for row in &report.paths {
        let both = |value: &dyn Fn(&Side) -> String| {
            let literal = row.literal.as_ref().map_or("–".into(), value);
            format!("{literal} / {}", value(&row.ours))
        };
        let bounces: Vec<_> =
            row.bounces.iter().map(|bounce| format!("{:.1}", bounce.estimates)).collect();
        let cells = [
            format!("`{}`", row.name),
            both(&|side| format!("{:.2}", side.path_us)),
            both(&|side| format!("{:.0}", 1e6 / side.path_us)),
            both(&|side| format!("{:.0}", side.counts.estimates)),
            both(&|side| format!("{:.4}", side.variance)),
            both(&|side| format!("{:.3}", side.radiance)),
            row.ratio.map_or("–".into(), |ratio| format!("{ratio:.1}")),
            bounces.join(", "),
        ];
        line(&mut table, cells.into_iter());
    }
    table
}

fn mandelbulber(report: &Report) -> String {
    let columns =
        ["view", "ms a sample", "variance a sample", "mean radiance", "seconds to 5 % noise"];
    let mut table = format!("On {}:\n\n", report.adapter);
    table += &head(&[columns.as_slice(), &["speedup at equal noise"]].concat());
    for row in &report.mandelbulber {
        let both = |value: &dyn Fn(&mandelbulber::Side) -> String| {
            format!("{} / {}", value(&row.theirs), value(&row.ours))
        };
        let cells = [
            format!("`{}`", row.name),
            both(&|side| format!("{:.0}", side.sample_ms)),
            both(&|side| format!("{:.4}", side.variance)),
            both(&|side| format!("{:.3}", side.radiance)),
            both(&|side| format!("{:.1}", side.secs_to_noise())),
            format!("{:.1}", row.ratio),
        ];
        line(&mut table, cells.into_iter());
    }
    table
}

fn formulas(rows: &[formulas::Row]) -> String {
    let columns = [
        "formula",
        "step",
        "relaxation",
        "estimates a pixel",
        "orbit steps a pixel",
        "ms",
        "overstepped",
        "compilation, ms",
    ];
    let mut table = head(&columns);
    for row in rows {
        let cells = [
            row.formula.to_owned(),
            format!("{:.2}", row.step),
            format!("{:.1}", row.relaxation),
            format!("{:.1}", row.counts.estimates),
            format!("{:.0}", row.counts.steps),
            format!("{:.0}", row.ms),
            row.overstepped.map_or("–".to_owned(), |part| format!("{:.2} %", 100.0 * part)),
            format!("{:.0}", row.compilation_ms),
        ];
        line(&mut table, cells.into_iter());
    }
    table
}

/// A line per place: cost and picture time at some scales, then the largest values.
fn descent(report: &Report) -> String {
    const SCALES: [&str; 8] = ["3e-3", "1e-3", "1e-4", "1e-5", "1e-9", "1e-13", "1e-20", "1e-27"];
    let mut table = head(&[["place"].as_slice(), &SCALES, &["worst", "largest change"]].concat());
    for rows in report.descent.chunk_by(|a, b| a.place == b.place) {
        let at = |scale: &str| rows.iter().find(|row| row.scale == scale);
        let cells = SCALES.map(|scale| {
            at(scale).map_or("–".into(), |row| format!("{:.1} / {:.1}", row.cost, row.picture))
        });
        let most = |value: fn(&Row) -> f64| rows.iter().map(value).fold(0.0, f64::max);
        let worst = format!("{:.1} / {:.1}", most(|row| row.cost), most(|row| row.picture));
        let changes = [most(|row| row.changes[0]), most(|row| row.changes[1])];
        let changes = format!("{:.2} / {:.2}", changes[0], changes[1]);
        let place = rows.first().map_or(String::new(), |row| row.place.clone());
        line(&mut table, [place].into_iter().chain(cells).chain([worst, changes]));
    }
    table
}

fn errors(views: &[Comparison]) -> String {
    let names = views.first().map(|view| view.ours.errors.columns().map(|(name, _)| name));
    let mut table = head(&[["view"].as_slice(), names.unwrap_or_default().as_slice()].concat());
    for view in views {
        let both = view.literal.errors.columns().into_iter().zip(view.ours.errors.columns());
        let cells = both.map(|((name, literal), (_, ours))| {
            if name.starts_with("hit") || name.starts_with("shadow") {
                format!("{:.2} / {:.2} %", 100.0 * literal, 100.0 * ours)
            } else {
                format!("{literal:.2} / {ours:.2}")
            }
        });
        line(&mut table, [format!("`{}`", view.view)].into_iter().chain(cells));
    }
    table
}

fn counts(views: &[Comparison]) -> String {
    let columns =
        ["view", "iterations", "estimates a pixel", "orbit steps a pixel", "share of the peak"];
    let mut table = head(&columns);
    for view in views {
        let (literal, ours) = (&view.literal, &view.ours);
        let share = view.peak_share.map_or("–".into(), |share| format!("{:.0} %", 100.0 * share));
        let cells = [
            format!("`{}`", view.view),
            format!("{} / {}", literal.iterations, ours.iterations),
            format!("{:.1} / {:.1}", literal.counts.estimates, ours.counts.estimates),
            format!("{:.0} / {:.0}", literal.counts.steps, ours.counts.steps),
            share,
        ];
        line(&mut table, cells.into_iter());
    }
    table
}
