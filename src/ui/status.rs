//! The status line: the renderer's activity, zoom and picture size.
//!
//! In: the renderer's report and the camera. Out: text that fits the available width.

use egui::{Rect, Sense, Ui, pos2};

use super::{navigation::CameraStatus, theme, widgets::Help as _};
use crate::{
    render::report::{Activity, Report, clamped_text},
    scene::{Camera, Fractal, Scene, presets},
};

/// Height of the line, in points.
pub const HEIGHT: f32 = 24.0;
/// Size of the progress bar, in points.
const BAR: egui::Vec2 = egui::vec2(56.0, 4.0);
/// Width below which all texts are short, in points.
const SHORT_BELOW: f32 = 560.0;
/// Width below which the text of the precision limit is short, in points.
const SHORT_LIMIT_BELOW: f32 = 860.0;

/// The text while the picture shows no surface to zoom toward.
pub const NOTHING_AHEAD: &str = "Nothing to zoom into here: zoom out";

/// The data that the status line displays.
#[derive(Clone, Copy, Debug)]
pub struct StatusInputs<'a> {
    /// The renderer's report.
    pub report: &'a Report,
    /// The current scene.
    pub scene: &'a Scene,
    /// The name of the GPU adapter.
    pub adapter: &'a str,
    /// The camera's distance and precision; none before the first frame.
    pub camera_status: Option<CameraStatus>,
    /// In fly mode, the speed in scene units per second; 0 at rest.
    pub flight: Option<f64>,
}

/// Draws the line over the width of `ui`.
pub fn status_line(ui: &mut Ui, status: &StatusInputs<'_>) {
    let report = status.report;
    let size = egui::vec2(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let short = rect.width() < SHORT_BELOW;
    let painter = ui.painter().with_clip_rect(rect);
    painter.rect_filled(rect, 0.0, theme::PANEL);
    painter.hline(rect.x_range(), rect.top() + 0.5, egui::Stroke::new(1.0, theme::LINE));

    let font = egui::FontId::proportional(12.0);
    let right = right_text(status, rect.width());
    let right = painter.layout_no_wrap(right, font.clone(), theme::TEXT_DIM);
    let right_at =
        pos2(rect.right() - 10.0 - right.size().x, rect.center().y - right.size().y / 2.0);
    painter.galley(right_at, right, theme::TEXT_DIM);
    let line = rect.with_min_x(rect.left() + 10.0);
    let left = progress(report).map_or(line.left(), |part| bar(&painter, line, part) + 8.0);

    let words = activity_text(report, short);
    let words = match status.camera_status {
        Some(CameraStatus { nothing_ahead: true, .. }) => format!("{NOTHING_AHEAD} · {words}"),
        _ => words,
    };
    let words = match status.flight {
        Some(speed) if speed > 0.0 => {
            format!("Flying, {} units a second · {words}", speed_text(speed))
        }
        Some(_) => format!("Fly mode · {words}"),
        None => words,
    };
    let mut job = egui::text::LayoutJob::simple_singleline(words.clone(), font, theme::TEXT);
    job.wrap = egui::text::TextWrapping::truncate_at_width((right_at.x - left - 10.0).max(0.0));
    let galley = painter.layout_job(job);
    let at = pos2(left, rect.center().y - galley.size().y / 2.0);
    painter.galley(at, galley, theme::TEXT);

    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_role(egui::accesskit::Role::Status);
        node.set_label(words);
    });
    response.live_help(|| {
        let mut lines = vec![activity_text(report, false)];
        if report.pixels_per_sample > 1 {
            lines.push(format!("One of {} pixels is drawn so far.", report.pixels_per_sample));
        }
        lines.push(right_text(status, f32::INFINITY));
        if is_at_limit(status) {
            lines.push(limit_help(status.scene).to_owned());
        }
        lines.push(format!("GPU time of the last frame: {:.1} ms", report.frame_ms));
        lines.push(format!("Rendered by {}", status.adapter));
        lines.join("\n")
    });
}

/// The part of the picture's work that is done, 0 to 1; none where no end is known.
fn progress(report: &Report) -> Option<f32> {
    let wanted = match (&report.activity, report.samples_done) {
        (Activity::Refining, 0) => 1,
        (Activity::Refining, _) => report.samples_wanted,
        _ => return None,
    };
    let done = report.samples_so_far / wanted.max(1) as f32;
    // Of a noise target and a number of samples, what is nearer ends the picture.
    Some(done.max(report.converged_fraction.unwrap_or(0.0)).clamp(0.0, 1.0))
}

/// Draws the bar of a [`progress`] at the left end of `rect`; returns its right end.
fn bar(painter: &egui::Painter, rect: Rect, part: f32) -> f32 {
    let whole = Rect::from_center_size(pos2(rect.left() + BAR.x / 2.0, rect.center().y), BAR);
    let done = Rect::from_min_size(whole.min, egui::vec2(part * BAR.x, BAR.y));
    painter.rect_filled(whole, BAR.y / 2.0, theme::LINE);
    painter.rect_filled(done, BAR.y / 2.0, theme::ACCENT);
    whole.right()
}

/// The renderer's activity as text.
pub fn activity_text(report: &Report, short: bool) -> String {
    match &report.activity {
        Activity::Idle | Activity::Refining if report.pictures == 0 => "Starting…".to_owned(),
        Activity::Idle if short => format!("Finished in {}", duration_text(report.elapsed_secs)),
        Activity::Idle => format!(
            "Finished in {}: {}{}",
            duration_text(report.elapsed_secs),
            count(report.samples_done, "sample"),
            clamped(report),
        ),
        Activity::Moving => "Preview".to_owned(),
        Activity::Refining if report.samples_done == 0 => {
            // Rounding must not show 100 % before the sample is complete.
            let percent = (report.samples_so_far * 100.0).clamp(0.0, 99.0).floor();
            format!("Preview, {percent} % sharp")
        }
        Activity::Refining => {
            let sample = (report.samples_done + 1).min(report.samples_wanted.max(1));
            // Rounded down: 100 % would mean a finished picture.
            let percent = |part: f32| (100.0 * part).clamp(0.0, 99.0).floor();
            let noise_free = report
                .converged_fraction
                .map_or_else(String::new, |part| format!(", {} % noise-free", percent(part)));
            let noise_free = noise_free + &clamped(report);
            if short {
                format!("Sharp, {sample}/{}{noise_free}", report.samples_wanted)
            } else {
                format!(
                    "Sharp, getting smoother: sample {sample} of {}{noise_free}, {}",
                    report.samples_wanted,
                    duration_text(report.elapsed_secs)
                )
            }
        }
        Activity::Compiling(what) => format!("Preparing {what}…"),
    }
}

/// What the firefly limit removed, as a part of a sentence; empty without a limit.
fn clamped(report: &Report) -> String {
    report.clamped_light.map_or_else(String::new, |light| {
        format!(", {} of the light removed by the firefly limit", clamped_text(light.fraction()))
    })
}

fn right_text(status: &StatusInputs<'_>, width: f32) -> String {
    let [width_px, height_px] = status.report.size_px;
    let zoom = zoom_text(zoom(&status.scene.camera));
    let mut parts = Vec::new();
    if is_at_limit(status) {
        parts.push(limit_text(&status.scene.fractal, width));
    }
    parts.push(zoom);
    if width_px > 0 {
        parts.push(format!("{width_px} × {height_px}"));
    }
    parts.join("  ·  ")
}

fn is_at_limit(status: &StatusInputs<'_>) -> bool {
    status.camera_status.is_some_and(|camera_status| camera_status.at_precision_limit)
}

/// The reason why the eye cannot come nearer, for a line `width` points wide.
fn limit_text(fractal: &Fractal, width: f32) -> String {
    const MAXIMUM: &str = "maximum zoom";
    let formula = fractal.formula();
    let text = match (formula.has_depth(fractal), width, formula.deeper()) {
        (true, ..SHORT_BELOW, _) => "deepest",
        (false, ..SHORT_BELOW, _) => "limit",
        (false, SHORT_LIMIT_BELOW.., Some(deeper)) => return format!("{MAXIMUM}; {deeper}"),
        _ => MAXIMUM,
    };
    text.to_owned()
}

/// The reason why the eye cannot come nearer, for the hover text.
fn limit_help(scene: &Scene) -> String {
    let formula = scene.fractal.formula();
    if formula.has_depth(&scene.fractal) {
        return "Maximum zoom: at a smaller scale, the GPU's numbers would underflow.".to_owned();
    }
    let deeper = formula.deeper().map_or_else(String::new, |deeper| format!(" Here {deeper}."));
    format!(
        "Maximum zoom: nearer, you would see rounding errors of single precision instead of \
         detail.{deeper}"
    )
}

/// Magnification at the pivot, relative to the scene that the program opens on.
pub fn zoom(camera: &Camera) -> f64 {
    let height = |camera: &Camera| camera.view_unit() * camera.half_height(1.0);
    height(&presets::opening().camera) / height(camera).max(f64::MIN_POSITIVE)
}

/// A zoom as text: `1.5×`, from 10000 on `3.2 × 10⁵`.
pub fn zoom_text(zoom: f64) -> String {
    if !zoom.is_finite() || zoom <= 0.0 {
        return "–".to_owned();
    }
    if zoom < 1e4 { format!("{}×", plain(zoom)) } else { scientific(zoom) }
}

/// A speed above 0 as text.
fn speed_text(speed: f64) -> String {
    if (0.1..1e4).contains(&speed) { plain(speed) } else { scientific(speed) }
}

/// A number as text with few decimal places: `0.05`, `1.5`, `812`.
fn plain(number: f64) -> String {
    let places = match number {
        ..0.1 => 2,
        ..100.0 => 1,
        _ => 0,
    };
    format!("{number:.places$}")
}

/// A number above 0 as text: `3.2 × 10⁵`.
fn scientific(number: f64) -> String {
    // A mantissa that rounds to 10.0 becomes 1.0 with the next exponent.
    let exponent = number.log10().floor();
    let mantissa = (number / 10f64.powf(exponent) * 10.0).round() / 10.0;
    let (mantissa, exponent) =
        if mantissa >= 10.0 { (1.0, exponent + 1.0) } else { (mantissa, exponent) };
    theme::printable(&format!("{mantissa:.1} × 10{}", superscript(exponent as i32)))
}

fn superscript(number: i32) -> String {
    let of = |c: char| c.to_digit(10).map_or('⁻', |digit| theme::SUPERSCRIPTS[digit as usize]);
    number.to_string().chars().map(of).collect()
}

/// A duration as text: `0.8 s`, `1 min 05 s`, `2 h 10 min`.
pub fn duration_text(secs: f64) -> String {
    if !secs.is_finite() || secs < 0.0 {
        return "–".to_owned();
    }
    let whole = secs.round() as u64;
    match whole {
        0..10 => format!("{secs:.1} s"),
        10..60 => format!("{whole} s"),
        60..3600 => format!("{} min {:02} s", whole / 60, whole % 60),
        3600..3_600_000 => format!("{} h {:02} min", whole / 3600, whole / 60 % 60),
        _ => "over 1000 h".to_owned(),
    }
}

fn count(number: u32, what: &str) -> String {
    if number == 1 { format!("1 {what}") } else { format!("{number} {what}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zooms_are_formatted() {
        assert_eq!(zoom_text(1.0), "1.0×");
        assert_eq!(zoom_text(0.054), "0.05×");
        assert_eq!(zoom_text(812.3), "812×");
        assert_eq!(zoom_text(320_000.0), "3.2 × 10⁵");
        assert_eq!(zoom_text(9.99e11), "1.0 × 10¹²");
        assert_eq!(zoom_text(3.6e27), "3.6 × 10²⁷");
        assert_eq!(zoom_text(f64::NAN), "–");
        assert_eq!(speed_text(1.58), "1.6");
        assert_eq!(speed_text(3.24e-5), "3.2 × 10^-5");
    }

    #[test]
    fn a_new_scene_has_zoom_one() {
        assert!((zoom(&presets::opening().camera) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn durations_are_formatted() {
        assert_eq!(duration_text(0.84), "0.8 s");
        assert_eq!(duration_text(42.4), "42 s");
        assert_eq!(duration_text(65.0), "1 min 05 s");
        assert_eq!(duration_text(7860.0), "2 h 11 min");
        assert_eq!(duration_text(4e6), "over 1000 h");
        assert_eq!(duration_text(f64::INFINITY), "–");
    }

    #[test]
    fn the_activity_text_counts_samples_from_one() {
        let mut report = Report {
            activity: Activity::Refining,
            samples_done: 4,
            samples_wanted: 16,
            elapsed_secs: 2.0,
            pictures: 5,
            ..Default::default()
        };
        assert_eq!(activity_text(&report, false), "Sharp, getting smoother: sample 5 of 16, 2.0 s");
        assert_eq!(activity_text(&report, true), "Sharp, 5/16");
        report.samples_done = 0;
        report.samples_so_far = 0.378;
        assert_eq!(activity_text(&report, false), "Preview, 37 % sharp");
        assert!((progress(&report).unwrap() - 0.378).abs() < 1e-6);
        report.samples_so_far = 1.0;
        assert_eq!(activity_text(&report, true), "Preview, 99 % sharp");
        report.activity = Activity::Compiling("power 5".into());
        assert_eq!(activity_text(&report, false), "Preparing power 5…");
        assert_eq!(progress(&report), None);
        report.activity = Activity::Refining;
        report.pictures = 0;
        assert_eq!(activity_text(&report, false), "Starting…");
    }
}
