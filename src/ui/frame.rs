//! Where the picture is in the window, and window positions in the picture.

use egui::Rect;
use glam::DVec2;

use crate::scene::StereoLayout;

/// The picture's rectangle in the window.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The rectangle, in points.
    pub rect: Rect,
    /// The picture's height in pixels.
    pub height_px: u32,
}

impl Frame {
    /// A window position in normalised device coordinates of the picture.
    pub fn ndc(&self, at: egui::Pos2) -> DVec2 {
        let part = (at - self.rect.min) / self.rect.size().max(egui::Vec2::splat(1.0));
        DVec2::new(f64::from(part.x) * 2.0 - 1.0, 1.0 - f64::from(part.y) * 2.0)
    }

    /// The frame of the eye's picture at `at`; without `at`, of the first picture.
    pub fn of_eye(self, layout: StereoLayout, at: Option<egui::Pos2>) -> Self {
        let Rect { min, max } = self.rect;
        let center = self.rect.center();
        let at = at.unwrap_or(min);
        let (rect, height_px) = match layout {
            StereoLayout::Off | StereoLayout::Anaglyph => return self,
            StereoLayout::SideBySide if at.x < center.x => {
                (Rect::from_min_max(min, egui::pos2(center.x, max.y)), self.height_px)
            }
            StereoLayout::SideBySide => {
                (Rect::from_min_max(egui::pos2(center.x, min.y), max), self.height_px)
            }
            StereoLayout::TopBottom if at.y < center.y => {
                (Rect::from_min_max(min, egui::pos2(max.x, center.y)), self.height_px / 2)
            }
            StereoLayout::TopBottom => {
                (Rect::from_min_max(egui::pos2(min.x, center.y), max), self.height_px / 2)
            }
        };
        Self { rect, height_px }
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.rect.width().max(1.0)) / f64::from(self.rect.height().max(1.0))
    }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn the_pointer_is_over_the_picture_of_one_eye() {
        let rect = Rect::from_min_max(pos2(100.0, 50.0), pos2(500.0, 250.0));
        let frame = Frame { rect, height_px: 400 };
        let ndc = |layout, x: f32, y: f32| {
            let at = pos2(x, y);
            frame.of_eye(layout, Some(at)).ndc(at).to_array()
        };
        // The centres of the halves are the centres of the pictures.
        assert_eq!(ndc(StereoLayout::Off, 300.0, 150.0), [0.0, 0.0]);
        assert_eq!(ndc(StereoLayout::Anaglyph, 300.0, 150.0), [0.0, 0.0]);
        for x in [200.0, 400.0] {
            assert_eq!(ndc(StereoLayout::SideBySide, x, 150.0), [0.0, 0.0]);
        }
        for y in [100.0, 200.0] {
            assert_eq!(ndc(StereoLayout::TopBottom, 300.0, y), [0.0, 0.0]);
        }
        assert_eq!(ndc(StereoLayout::SideBySide, 300.0, 50.0), [-1.0, 1.0]);
        assert_eq!(ndc(StereoLayout::TopBottom, 500.0, 150.0), [1.0, 1.0]);
        // Each eye's frame has the aspect and the height of one picture.
        let aspect_and_height = |layout, at| {
            let of_eye = frame.of_eye(layout, at);
            (of_eye.aspect(), of_eye.height_px)
        };
        assert_eq!(aspect_and_height(StereoLayout::Off, None), (2.0, 400));
        assert_eq!(aspect_and_height(StereoLayout::SideBySide, None), (1.0, 400));
        assert_eq!(aspect_and_height(StereoLayout::TopBottom, Some(rect.max)), (4.0, 200));
    }
}
