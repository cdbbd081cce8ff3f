//! The film's luminance histogram, with the range that the display can show.

use super::hover::Help as _;
use egui::{Color32, Rect, Response, Sense, Stroke, Ui, WidgetInfo, accesskit::Role, pos2, vec2};

use crate::{
    render::report::{HISTOGRAM_BINS, HISTOGRAM_BINS_PER_STOP, HISTOGRAM_LOW_STOPS, Histogram},
    ui::theme,
};

/// Height of the drawing, in points.
const HEIGHT: f32 = 64.0;

/// The film luminances that display as black, grey and white, as log2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayRange {
    /// Luminance that displays as black.
    pub black: f64,
    /// Luminance that becomes middle grey, 0.18, before the curve.
    pub grey: f64,
    /// Luminance that displays as white.
    pub white: f64,
}

/// Draws the histogram over the full width, dark left, bright right.
///
/// Bars outside `range` are dimmed; a line marks middle grey.
pub fn histogram(ui: &mut Ui, histogram: Option<&Histogram>, range: DisplayRange) -> Response {
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Histogram"));
    if ui.is_rect_visible(rect) {
        paint(ui, rect, histogram, range);
    }
    let text = match (histogram, response.hover_pos()) {
        (Some(histogram), Some(pointer)) => {
            let bin = (fraction_at(rect, pointer.x) * HISTOGRAM_BINS as f64) as usize;
            describe(histogram, bin.min(HISTOGRAM_BINS - 1))
        }
        _ => String::new(),
    };
    response.help(format!(
        "How many pixels are dark (left) or bright (right). Each tick doubles the light. The lighter area is the range that the screen can show; the line is middle grey.{text}"
    ))
}

/// The luminance of a bin, and its share of the picture, as text.
fn describe(histogram: &Histogram, bin: usize) -> String {
    let total: f64 = histogram.bins.iter().map(|&count| f64::from(count)).sum();
    let part = 100.0 * f64::from(histogram.bins.get(bin).copied().unwrap_or(0)) / total.max(1.0);
    let stops = HISTOGRAM_LOW_STOPS + (bin as f64 + 0.5) / HISTOGRAM_BINS_PER_STOP;
    format!("\nLuminance {:.2e}: {part:.1} % of the picture", stops.exp2())
}

/// Heights of the bars, 0 to 1: the square root of the counts, so that rare pixels are visible.
///
/// The first and the last bin also count all values beyond, so they do not affect the scale.
fn heights(bins: &[u32]) -> Vec<f32> {
    let inner = bins.get(1..bins.len().saturating_sub(1)).unwrap_or_default();
    let max = inner.iter().copied().max().unwrap_or(0).max(1) as f32;
    bins.iter().map(|&count| (count as f32 / max).sqrt().min(1.0)).collect()
}

/// Position of a log2 luminance: 0 at the first bin's left edge, 1 at the last bin's right edge.
fn fraction(stops: f64) -> f64 {
    let span = HISTOGRAM_BINS as f64 / HISTOGRAM_BINS_PER_STOP;
    ((stops - HISTOGRAM_LOW_STOPS) / span).clamp(0.0, 1.0)
}

fn fraction_at(rect: Rect, x: f32) -> f64 {
    f64::from((x - rect.left()) / rect.width().max(1.0)).clamp(0.0, 1.0)
}

fn paint(ui: &Ui, rect: Rect, histogram: Option<&Histogram>, range: DisplayRange) {
    let painter = ui.painter().with_clip_rect(rect);
    let x = |stops: f64| rect.left() + rect.width() * fraction(stops) as f32;
    let shown = Rect::from_x_y_ranges(x(range.black)..=x(range.white), rect.y_range());
    painter.rect_filled(rect, theme::RADIUS, theme::BACKGROUND);
    painter.rect_filled(shown, 0.0, theme::RAISED);
    if let Some(histogram) = histogram {
        let inside = |bin: usize| {
            let middle = rect.left() + rect.width() * (bin as f32 + 0.5) / HISTOGRAM_BINS as f32;
            shown.x_range().contains(middle)
        };
        for (bin, height) in heights(&histogram.bins).into_iter().enumerate() {
            let color = if inside(bin) { theme::TEXT } else { theme::TEXT_DIM.gamma_multiply(0.6) };
            bar(&painter, rect, bin, height * (HEIGHT - 8.0), color);
        }
    }
    let first = HISTOGRAM_LOW_STOPS.ceil() as i32;
    for stop in first..=(first + (HISTOGRAM_BINS as f64 / HISTOGRAM_BINS_PER_STOP) as i32) {
        let at = x(f64::from(stop));
        let notch = rect.bottom() - if stop % 5 == 0 { 5.0 } else { 2.5 };
        painter.vline(at, notch..=rect.bottom(), Stroke::new(1.0, theme::LINE));
    }
    painter.vline(x(range.grey), rect.y_range(), Stroke::new(1.5, theme::ACCENT));
}

/// Draws one bar from the lower edge; adjacent bars touch.
fn bar(painter: &egui::Painter, rect: Rect, bin: usize, height: f32, color: Color32) {
    let x = |bin: usize| rect.left() + rect.width() * bin as f32 / HISTOGRAM_BINS as f32;
    if height > 0.0 {
        let top_left = pos2(x(bin), rect.bottom() - height.max(1.0));
        let bar = Rect::from_min_max(top_left, pos2(x(bin + 1), rect.bottom()));
        painter.rect_filled(bar, 0.0, color);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outer_bins_do_not_affect_the_scale() {
        let mut bins = [0; HISTOGRAM_BINS];
        (bins[0], bins[40], bins[41]) = (1_000_000, 100, 25);
        let heights = heights(&bins);
        assert_eq!((heights[0], heights[40], heights[41], heights[42]), (1.0, 1.0, 0.5, 0.0));
        assert!(super::heights(&[0; HISTOGRAM_BINS]).iter().all(|height| *height == 0.0));
    }

    #[test]
    fn middle_grey_is_in_its_bin() {
        let bin = (fraction(0.18_f64.log2()) * HISTOGRAM_BINS as f64) as usize;
        // Eleven and a half stops above the first bin's start.
        assert_eq!(bin, 57);
    }
}
