//! The share window: a link to the view, its QR code, and the picture for other programs.
//!
//! In: the page's address, and what the browser can do. Out: commands.

use egui::{Align2, Button, Color32, Label, Mesh, Rect, RichText, Sense, Ui, Vec2, vec2};
use qrcodegen::{QrCode, QrCodeEcc};

use super::{
    rects::Rects,
    shortcuts::Command,
    theme,
    widgets::{Help as _, window_heading},
};
use crate::scene::{Project, link};

/// Length of a link, in bytes, up to which phones can read its QR code from a screen.
const MAX_QR_BYTES: usize = 1200;
/// Light modules around a QR code, which scanners need (ISO/IEC 18004).
const QUIET_ZONE: i32 = 4;
/// Width and height of the QR code, in points.
const QR_SIDE: f32 = 232.0;
/// Least width and height of the QR code, in points: scanners still resolve its modules.
const QR_SIDE_LEAST: f32 = 170.0;
/// Height of the screen, in points, below which the window is wide instead of high.
const LOW: f32 = 560.0;
/// Width of the window, in points.
const WIDTH: f32 = 288.0;

/// What the program around the interface can share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sharing<'a> {
    /// The page's address without a fragment; empty if there is none.
    pub address: &'a str,
    /// True if the system has a share sheet that takes pictures.
    pub has_share_sheet: bool,
}

/// The share window.
#[derive(Debug, Default)]
pub struct Share {
    is_open: bool,
    /// What was shared last; made again for another view.
    shared: Option<Shared>,
}

/// What the open window shares.
#[derive(Debug)]
struct Shared {
    project: Project,
    code: Option<Code>,
}

/// The modules of a QR code with its quiet zone, row by row.
#[derive(Debug)]
struct Code {
    side: usize,
    is_dark: Vec<bool>,
}

impl Share {
    /// Opens the window, or closes it.
    pub fn toggle(&mut self) {
        *self = Self { is_open: !self.is_open, shared: None };
    }

    /// True while the window is open.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Shows the open window over the picture in `view`, and returns the commands of its buttons.
    pub fn show(
        &mut self,
        ui: &Ui,
        view: Rect,
        project: &Project,
        sharing: Sharing<'_>,
        rects: &mut Rects,
    ) -> Vec<Command> {
        let mut commands = Vec::new();
        if !self.is_open {
            return commands;
        }
        let last = self.shared.take().filter(|shared| shared.project == *project);
        let shared = self.shared.insert(last.unwrap_or_else(|| Shared::new(project, sharing)));
        let mut open = true;
        let screen = ui.ctx().content_rect();
        // In a low window the buttons are beside the code, so that all of them are seen.
        let width = (2.0 * WIDTH).min(screen.width() - 40.0);
        let is_low = screen.height() < LOW && width > 1.5 * WIDTH;
        let width = if is_low { width } else { WIDTH };
        let shown = egui::Window::new("Share this view")
            .fixed_pos(view.center())
            .pivot(Align2::CENTER_CENTER)
            .constrain_to(screen)
            .title_bar(false)
            .resizable(false)
            .fixed_size(vec2(width, (screen.height() - 48.0).max(120.0)))
            .show(ui.ctx(), |window| {
                window.spacing_mut().interact_size.y = ui.spacing().interact_size.y.max(34.0);
                open = !window_heading(window, "Share this view");
                egui::ScrollArea::vertical().auto_shrink([false, true]).show(window, |ui| {
                    if is_low {
                        ui.columns_const(|[code, others]| {
                            shared.show_code(code, rects);
                            buttons(others, sharing, rects, &mut commands);
                        });
                    } else {
                        shared.show_code(ui, rects);
                        buttons(ui, sharing, rects, &mut commands);
                    }
                });
            });
        if let Some(shown) = shown {
            rects.record("share window", &shown.response);
        }
        if !open {
            self.toggle();
        }
        commands
    }
}

impl Shared {
    fn new(project: &Project, sharing: Sharing<'_>) -> Self {
        let fragment = link::project_to_fragment(project)
            .or_else(|_| link::to_fragment(&project.scene))
            .ok()
            .filter(|_| !sharing.address.is_empty());
        let link = fragment.map(|fragment| format!("{}#{fragment}", sharing.address));
        let code = link.filter(|link| link.len() <= MAX_QR_BYTES);
        Self { project: project.clone(), code: code.and_then(|link| Code::of(&link)) }
    }

    fn show_code(&self, ui: &mut Ui, rects: &mut Rects) {
        let Some(code) = &self.code else {
            let text = "This view's link is too long for a QR code. Copy the link instead.";
            ui.add(Label::new(RichText::new(text).color(theme::TEXT_DIM)).wrap());
            ui.add_space(6.0);
            return;
        };
        ui.vertical_centered(|ui| {
            // In a low window the code is smaller, so that it is whole.
            let side = QR_SIDE.min((ui.ctx().content_rect().height() - 220.0).max(QR_SIDE_LEAST));
            let (rect, response) = ui.allocate_exact_size(Vec2::splat(side), Sense::hover());
            ui.ctx().accesskit_node_builder(response.id, |node| {
                node.set_role(egui::accesskit::Role::Image);
                node.set_label("QR code of the link to this view");
            });
            rects.record("QR code", &response);
            ui.painter().add(code.mesh(rect));
            ui.add_space(4.0);
            let text = "Scan it to open this view on another device.";
            ui.add(Label::new(RichText::new(text).color(theme::TEXT_DIM)).wrap());
            ui.add_space(6.0);
        });
    }
}

impl Code {
    /// The code of a text; none for a text that is too long.
    fn of(text: &str) -> Option<Self> {
        let code = QrCode::encode_text(text, QrCodeEcc::Low).ok()?;
        let range = -QUIET_ZONE..code.size() + QUIET_ZONE;
        let is_dark = range.clone().flat_map(|y| range.clone().map(move |x| (x, y)));
        let is_dark = is_dark.map(|(x, y)| code.get_module(x, y)).collect();
        Some(Self { side: range.len(), is_dark })
    }

    /// The code over `rect`, dark on white.
    fn mesh(&self, rect: Rect) -> Mesh {
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(rect, Color32::WHITE);
        let module = rect.size() / self.side as f32;
        for (y, row) in self.is_dark.chunks(self.side).enumerate() {
            for (x, _) in row.iter().enumerate().filter(|(_, is_dark)| **is_dark) {
                let corner = rect.min + vec2(x as f32, y as f32) * module;
                mesh.add_colored_rect(Rect::from_min_size(corner, module), Color32::BLACK);
            }
        }
        mesh
    }
}

/// The window's buttons, one a row.
fn buttons(ui: &mut Ui, sharing: Sharing<'_>, rects: &mut Rects, commands: &mut Vec<Command>) {
    let mut button = |name: &'static str, hover: &str, command: Command| {
        let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
        let response = ui.add_sized(size, Button::new(name)).help(hover);
        rects.record(name, &response);
        if response.clicked() {
            commands.push(command);
        }
    };
    if sharing.has_share_sheet {
        let hover = "Sends the picture through another app of this device";
        button("Send picture…", hover, Command::SharePicture);
    }
    button("Copy link", "The link opens this view in any browser (L)", Command::CopyLink);
    button("Copy picture", "Copies the picture as it is on the screen", Command::CopyPicture);
    button("Save picture", "In the size that Export sets (Ctrl S)", Command::SavePicture);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    const SHARING: Sharing<'_> =
        Sharing { address: "https://example.org/fractals/", has_share_sheet: false };

    #[test]
    fn a_code_has_its_patterns_in_three_corners_and_a_quiet_zone() {
        let code = Code::of("https://example.org/").expect("a short text");
        let is_dark = |x: usize, y: usize| code.is_dark[y * code.side + x];
        let quiet = QUIET_ZONE as usize;
        let last = code.side - 1;
        assert!((0..code.side).all(|i| !is_dark(i, quiet - 1) && !is_dark(last, i)));
        for corner in [(quiet, quiet), (last - quiet - 6, quiet), (quiet, last - quiet - 6)] {
            let edge: Vec<bool> = (0..7).map(|i| is_dark(corner.0 + i, corner.1)).collect();
            assert_eq!(edge, [true; 7], "the finder pattern at {corner:?}");
        }
    }

    #[test]
    fn opening_scenes_have_codes_and_a_view_without_an_address_has_none() {
        for preset in presets::opening_scenes() {
            let project: Project = (preset.scene)().into();
            assert!(Shared::new(&project, SHARING).code.is_some(), "{}", preset.name);
            assert!(Shared::new(&project, Sharing::default()).code.is_none());
        }
    }
}
