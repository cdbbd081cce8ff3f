//! Brings a control into sight that was asked for by name, or has the keyboard.

use egui::{Context, Id, Rect, Ui};

/// Frames in which the control must be drawn: its section opens first.
const FRAMES: u64 = 10;

/// Asks for the control or section called `name`, which brings itself into sight when it is drawn.
pub fn reveal(ui: &Ui, name: &'static str) {
    let until = ui.ctx().cumulative_frame_nr() + FRAMES;
    ui.ctx().data_mut(|data| data.insert_temp(Id::unique("reveal"), (name, until)));
    ui.ctx().request_repaint();
}

/// True once for the control or section that was asked for.
pub fn revealed(ui: &Ui, name: &str) -> bool {
    let id = Id::unique("reveal");
    let asked = ui.data(|data| data.get_temp::<(&'static str, u64)>(id));
    let is_asked = asked
        .is_some_and(|(asked, until)| asked == name && ui.ctx().cumulative_frame_nr() <= until);
    if is_asked {
        ui.data_mut(|data| data.remove::<(&'static str, u64)>(id));
    }
    is_asked
}

/// Scrolls to the control that the keyboard has just brought the focus to, if it is out of sight.
pub fn reveal_focus(ui: &Ui) {
    let id = ui.scope_id().with("last focus");
    let focused = ui.memory(|memory| memory.focused());
    if ui.data(|data| data.get_temp(id)) == Some(focused) {
        return;
    }
    ui.data_mut(|data| data.insert_temp(id, focused));
    if let Some(control) = focused.and_then(|focused| ui.ctx().read_response(focused)) {
        let is_cut = !control.interact_rect.expand(1.0).contains_rect(control.rect);
        if is_cut && control.layer_id == ui.layer_id() {
            ui.scroll_to_rect(control.rect, None);
        }
    }
}

/// Seconds in which a control must be drawn: its section opens first.
const WAIT_SECS: f64 = 2.0;

/// A control that is asked for by its name in the accessibility tree.
#[derive(Clone)]
struct Named {
    label: String,
    until_secs: f64,
    /// Where the control was in the last frame.
    last: Option<Rect>,
}

fn named_id() -> Id {
    Id::unique("reveal named")
}

/// Asks for the control of this name; [`focus_named`] gives the control the keyboard.
pub fn reveal_named(ctx: &Context, label: String) {
    let until_secs = ctx.input(|input| input.time) + WAIT_SECS;
    let named = Named { label, until_secs, last: None };
    ctx.data_mut(|data| data.insert_temp(named_id(), named));
    ctx.enable_accesskit();
    ctx.request_repaint();
}

/// Gives the keyboard to the control that was asked for by name, once it rests at its place.
///
/// Called at the end of a frame. Where the control is scrolled out of sight, its panel shows what has the keyboard.
pub fn focus_named(ctx: &Context) {
    let Some(named) = ctx.data(|data| data.get_temp::<Named>(named_id())) else { return };
    let found = place_of(ctx, &named.label);
    let is_at_rest = found.is_some_and(|(_, rect)| named.last == Some(rect));
    if let Some((id, _)) = found.filter(|_| is_at_rest) {
        ctx.memory_mut(|memory| memory.request_focus(id));
    }
    if is_at_rest || ctx.input(|input| input.time) > named.until_secs {
        ctx.data_mut(|data| data.remove::<Named>(named_id()));
    } else {
        let last = found.map(|(_, rect)| rect).or(named.last);
        ctx.data_mut(|data| data.insert_temp(named_id(), Named { last, ..named }));
        // A screen reader's side may switch the tree off between its own frames.
        ctx.enable_accesskit();
    }
    ctx.request_repaint();
}

/// The control of this name in this frame, and its place.
fn place_of(ctx: &Context, label: &str) -> Option<(Id, Rect)> {
    let widgets: Vec<(Id, Rect)> = ctx.viewport(|viewport| {
        let widgets = viewport.this_pass.widgets.layers().flat_map(|(_, widgets)| widgets);
        let controls = widgets.filter(|widget| widget.sense.is_focusable() && widget.enabled);
        controls.map(|widget| (widget.id, widget.rect)).collect()
    });
    widgets.into_iter().find(|(id, _)| {
        ctx.has_accesskit_node(*id)
            && ctx.accesskit_node_builder(*id, |node| node.label() == Some(label)) == Some(true)
    })
}
