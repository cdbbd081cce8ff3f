//! Icons drawn as shapes: the bundled fonts lack most symbols, and shapes are sharp at any scale.

use egui::{Button, Color32, Painter, Pos2, Response, Sense, Stroke, Ui, Vec2, vec2};

use super::widgets::Help as _;

/// An icon, designed for a box of 16 points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Icon {
    /// An arrow that turns back.
    Undo,
    /// An arrow that turns forward.
    Redo,
    /// A question mark.
    Help,
    /// Three sliders.
    Controls,
    /// A chevron that points down.
    ChevronDown,
    /// A chevron that points up.
    ChevronUp,
    /// A chevron that points right.
    ChevronRight,
    /// A diagonal cross.
    Cross,
    /// Four corners.
    Fullscreen,
    /// A triangle.
    Play,
    /// Two bars.
    Pause,
    /// A triangle that points left to a bar.
    Previous,
    /// A triangle that points right to a bar.
    Next,
    /// A strip of film.
    Timeline,
    /// A house.
    Home,
    /// A ball in a frame: the whole fractal.
    Whole,
    /// An arrow that points down to a line.
    Dive,
    /// A map pin.
    Pin,
    /// An arrow that points up out of a box.
    Share,
    /// A die that shows five.
    Dice,
    /// Nine squares.
    Grid,
    /// Two halves of a frame, one of them filled.
    Halves,
    /// A clock whose hands turn back.
    Before,
    /// Three dots.
    More,
}

/// Width and height of a button with an icon, in points.
pub fn icon_side(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y.max(26.0)
}

/// A square button with an icon; `name` is for screen readers.
pub fn icon_button(ui: &mut Ui, icon: Icon, name: &str, hover: &str) -> Response {
    let side = icon_side(ui);
    let response = ui
        .add(
            Button::new("")
                .min_size(Vec2::splat(side))
                .sense(Sense::click())
                .frame_when_inactive(false),
        )
        .accessible_name(name)
        .help(hover)
        .disabled_help(hover);
    let color = if ui.is_enabled() {
        ui.style().interact(&response).fg_stroke.color
    } else {
        super::theme::TEXT_DIM
    };
    paint(ui.painter(), icon, response.rect.center(), 16.0, color);
    response
}

/// Draws `icon` around `center`, `size` points large.
pub fn paint(painter: &Painter, icon: Icon, center: Pos2, size: f32, color: Color32) {
    let stroke = Stroke::new(1.5, color);
    let at = |x: f32, y: f32| center + vec2(x, y) * (size / 16.0);
    let line = |points: &[(f32, f32)]| {
        painter.line(points.iter().map(|&(x, y)| at(x, y)).collect(), stroke);
    };
    let fill = |points: &[(f32, f32)]| {
        let corners = points.iter().map(|&(x, y)| at(x, y)).collect();
        painter.add(egui::Shape::convex_polygon(corners, color, Stroke::NONE));
    };
    match icon {
        Icon::ChevronDown => line(&[(-4.0, -2.0), (0.0, 2.0), (4.0, -2.0)]),
        Icon::ChevronUp => line(&[(-4.0, 2.0), (0.0, -2.0), (4.0, 2.0)]),
        Icon::ChevronRight => line(&[(-2.0, -4.0), (2.0, 0.0), (-2.0, 4.0)]),
        Icon::Cross => {
            line(&[(-4.0, -4.0), (4.0, 4.0)]);
            line(&[(-4.0, 4.0), (4.0, -4.0)]);
        }
        Icon::Undo | Icon::Redo => {
            let s = if icon == Icon::Undo { 1.0 } else { -1.0 };
            line(&[(-3.0 * s, -7.0), (-6.0 * s, -3.5), (-3.0 * s, 0.0)]);
            let mut arc = vec![(-6.0 * s, -3.5), (1.5 * s, -3.5)];
            arc.extend((0..=8).map(|i| {
                let a = -std::f32::consts::FRAC_PI_2 + std::f32::consts::PI * i as f32 / 8.0;
                ((1.5 + 4.5 * a.cos()) * s, 1.0 + 4.5 * a.sin())
            }));
            arc.push((-2.0 * s, 5.5));
            line(&arc);
        }
        Icon::Help => {
            painter.text(
                center,
                egui::Align2::CENTER_CENTER,
                "?",
                egui::FontId::proportional(size),
                color,
            );
        }
        Icon::Controls => {
            for (y, x) in [(-4.5, 2.0), (0.0, -3.0), (4.5, 3.5)] {
                line(&[(-7.0, y), (7.0, y)]);
                painter.circle_filled(at(x, y), 2.4 * size / 16.0, color);
            }
        }
        Icon::Play => fill(&[(-4.0, -6.0), (6.0, 0.0), (-4.0, 6.0)]),
        Icon::Pause => {
            for x in [-5.0, 1.5] {
                fill(&[(x, -5.5), (x + 3.5, -5.5), (x + 3.5, 5.5), (x, 5.5)]);
            }
        }
        Icon::Previous | Icon::Next => {
            let s = if icon == Icon::Next { 1.0 } else { -1.0 };
            fill(&[(-4.0 * s, -5.0), (3.0 * s, 0.0), (-4.0 * s, 5.0)]);
            line(&[(4.5 * s, -5.0), (4.5 * s, 5.0)]);
        }
        Icon::Timeline => {
            line(&[(-7.0, -5.5), (7.0, -5.5), (7.0, 5.5), (-7.0, 5.5), (-7.0, -5.5)]);
            for x in [-3.5, 3.5] {
                line(&[(x, -5.5), (x, 5.5)]);
            }
            for y in [-1.8, 1.8] {
                line(&[(-7.0, y), (-3.5, y)]);
                line(&[(3.5, y), (7.0, y)]);
            }
        }
        Icon::Fullscreen | Icon::Whole => {
            for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                line(&[(6.0 * sx, 2.5 * sy), (6.0 * sx, 6.0 * sy), (2.5 * sx, 6.0 * sy)]);
            }
            if icon == Icon::Whole {
                painter.circle_filled(center, 3.2 * size / 16.0, color);
            }
        }
        Icon::Dive => {
            line(&[(0.0, -7.0), (0.0, 2.5)]);
            line(&[(-4.5, -2.0), (0.0, 2.5), (4.5, -2.0)]);
            line(&[(-6.0, 6.5), (6.0, 6.5)]);
        }
        Icon::Pin => {
            // Two tangents from the tip to a circle.
            let (center, radius) = ((0.0, -2.5_f32), 4.7_f32);
            let mut outline = vec![(0.0, 7.5)];
            outline.extend((0..=12).map(|i| {
                let a = (150.0 + 20.0 * i as f32).to_radians();
                (center.0 + radius * a.cos(), center.1 + radius * a.sin())
            }));
            outline.push((0.0, 7.5));
            line(&outline);
            painter.circle_filled(at(center.0, center.1), 1.9 * size / 16.0, color);
        }
        Icon::Dice => {
            line(&[(-6.5, -6.5), (6.5, -6.5), (6.5, 6.5), (-6.5, 6.5), (-6.5, -6.5)]);
            for (x, y) in [(-3.2, -3.2), (3.2, -3.2), (0.0, 0.0), (-3.2, 3.2), (3.2, 3.2)] {
                painter.circle_filled(at(x, y), 1.4 * size / 16.0, color);
            }
        }
        Icon::Grid => {
            for (x, y) in (0..9).map(|i| ((i % 3) as f32 - 1.0, (i / 3) as f32 - 1.0)) {
                let (x, y) = (5.0 * x, 5.0 * y);
                fill(&[
                    (x - 1.7, y - 1.7),
                    (x + 1.7, y - 1.7),
                    (x + 1.7, y + 1.7),
                    (x - 1.7, y + 1.7),
                ]);
            }
        }
        Icon::Halves => {
            line(&[(-7.0, -5.5), (7.0, -5.5), (7.0, 5.5), (-7.0, 5.5), (-7.0, -5.5)]);
            fill(&[(-7.0, -5.5), (0.0, -5.5), (0.0, 5.5), (-7.0, 5.5)]);
        }
        Icon::Before => {
            let circle = (0..=20).map(|i| {
                let a = (-160.0 + 16.0 * i as f32).to_radians();
                (6.5 * a.cos(), 6.5 * a.sin())
            });
            line(&circle.collect::<Vec<_>>());
            line(&[(-9.0, -4.5), (-6.1, -2.2), (-3.8, -5.2)]);
            line(&[(0.0, -3.5), (0.0, 0.5), (2.8, 2.0)]);
        }
        Icon::More => {
            for x in [-5.0, 0.0, 5.0] {
                painter.circle_filled(at(x, 0.0), 1.7 * size / 16.0, color);
            }
        }
        Icon::Share => {
            line(&[(0.0, 3.0), (0.0, -7.0)]);
            line(&[(-3.5, -3.5), (0.0, -7.0), (3.5, -3.5)]);
            line(&[(-3.5, -0.5), (-6.0, -0.5), (-6.0, 7.0), (6.0, 7.0), (6.0, -0.5), (3.5, -0.5)]);
        }
        Icon::Home => {
            line(&[(-7.0, 0.0), (0.0, -6.5), (7.0, 0.0)]);
            line(&[(-4.5, -1.5), (-4.5, 6.0), (4.5, 6.0), (4.5, -1.5)]);
        }
    }
}
