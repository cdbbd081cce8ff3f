//! Widgets that egui does not have. Each takes a plain value and returns a `Response`.

pub mod ball;
mod card;
mod color;
mod gradient;
mod histogram;
mod hover;
mod param;
mod reveal;
mod scale;
mod scrolled_row;
mod section;
mod swatch;
mod window_heading;

pub use ball::{ArrowSteps, arrow_steps, ball};
pub use card::card;
pub use color::{color, color_size};
pub use gradient::{gradient, gradient_card, move_stop, paint_bar};
pub use histogram::{DisplayRange, histogram};
pub use hover::{Help, set_panel_area};
pub use param::{number, param_slider, param_slider_count, param_slider_wide};
pub use reveal::{
    Sought, focus_named, is_seeking, note_part, reveal, reveal_focus, reveal_named, revealed,
};
pub use scrolled_row::scrolled_row;
pub use section::{button_row, caption, choice, choice_button, section};
pub use swatch::{NAME_HEIGHT, swatch};
pub use window_heading::window_heading;
