//! A colour as a button that opens egui's picker.

use egui::{
    Response, Rgba, Ui,
    color_picker::{Alpha, color_edit_button_rgba},
};

/// A button in the colour (linear Rec. 709), which opens a picker. `name` is for those who
/// cannot see it, `hover` for those who point at it.
pub fn color(ui: &mut Ui, name: &str, hover: &str, linear: &mut [f32; 3]) -> Response {
    let [r, g, b] = *linear;
    let mut picked = Rgba::from_rgb(r, g, b);
    let response = color_edit_button_rgba(ui, &mut picked, Alpha::Opaque);
    // The picker's round trip through hue and saturation is not exact: keep the colour unless
    // it was changed by hand.
    if response.changed() {
        *linear = [picked.r(), picked.g(), picked.b()]
            .map(|v| if v.is_finite() { v.clamp(0.0, 1.0) } else { 0.0 });
    }
    response.accessible_name(name).on_hover_text(hover)
}
