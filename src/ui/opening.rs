//! The picture that the page shows until the first frame: the opening scene, rendered beforehand.
//!
//! In: the opening scene. Out: the scene of the picture, and its geometry. `cargo xtask thumbnails`
//! renders it to `www/opening.jpg`, which the page's build writes into `index.html`.

use crate::scene::{Scene, presets};

/// Width and height in pixels.
pub const SIDE_PX: u32 = 1024;

/// Part of the picture's side that the camera's angle spans.
///
/// The rest shows what wide windows have at their sides, and tall windows above and below.
pub const SPAN: f64 = 9.0 / 16.0;

/// The scene of the picture: the opening scene, seen through a wider angle.
pub fn scene() -> Scene {
    let mut scene = presets::opening();
    let half_height = (scene.camera.vertical_fov_deg.to_radians() / 2.0).tan() / SPAN;
    scene.camera.vertical_fov_deg = 2.0 * half_height.atan().to_degrees();
    scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::{sheet_height, status, theme};

    #[test]
    fn the_picture_spans_the_camera_of_the_opening_scene() {
        let wide = scene().camera.half_height(1.0);
        assert!((presets::opening().camera.half_height(1.0) / wide - SPAN).abs() < 1e-12);
        assert_eq!(scene().validate(), Ok(()));
    }

    /// Before the module is there, the style sheet places the picture where the interface will.
    #[test]
    fn the_style_sheet_has_the_layout_of_the_interface() {
        let style = include_str!("../../www/style.css");
        let has = |text: String| assert!(style.contains(&text), "style.css lacks {text}");
        has(format!("--status: {}px;", status::HEIGHT));
        has(format!("--panel: min({}px, {}vw);", theme::PANEL_WIDTH, 100.0 * theme::PANEL_PART));
        has(format!(
            "--sheet: min({}px, {}vh);",
            sheet_height::LOW,
            100.0 * sheet_height::HALF_PART
        ));
        has(format!("--span: {SPAN};"));
        let [wide, landscape] = [theme::WIDE_FROM, theme::LANDSCAPE_FROM].map(|from| from - 0.02);
        has(format!("(max-width: {landscape}px)"));
        has(format!("(max-width: {wide}px) and (orientation: portrait)"));
    }
}
