//! Brings a control into sight that was asked for by name, or has the keyboard.

use egui::{Context, Id, LayerId, Rect, Ui};

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
        if named(ui.ctx()).is_some_and(|named| named.sought.param == Some(name)) {
            end_search(ui.ctx());
        }
    }
    is_asked
}

/// Shows `contents` of a scrolled area, and scrolls to its control that the keyboard has just brought the focus to, if
/// the control is out of sight.
pub fn reveal_focus<R>(ui: &mut Ui, contents: impl FnOnce(&mut Ui) -> R) -> R {
    let layer = ui.layer_id();
    let count =
        |ui: &Ui| ui.ctx().viewport(|viewport| viewport.this_pass.widgets.get_layer(layer).count());
    let first = count(ui);
    let shown = contents(ui);
    let id = ui.scope_id().with("last focus");
    let focused = ui.memory(|memory| memory.focused());
    if ui.data(|data| data.get_temp(id)) == Some(focused) {
        return shown;
    }
    ui.data_mut(|data| data.insert_temp(id, focused));
    // A control elsewhere may be cut as well, by an area of its own.
    let is_in_contents = |control: Id| {
        ui.ctx().viewport(|viewport| {
            let mut widgets = viewport.this_pass.widgets.get_layer(layer).skip(first);
            widgets.any(|widget| widget.id == control)
        })
    };
    if let Some(control) = focused.and_then(|focused| ui.ctx().read_response(focused)) {
        let is_cut = !control.interact_rect.expand(1.0).contains_rect(control.rect);
        if is_cut && is_in_contents(control.id) {
            ui.scroll_to_rect(control.rect, None);
        }
    }
    shown
}

/// Seconds in which a control must be drawn: its section opens first.
const WAIT_SECS: f64 = 2.0;

/// A control to find by its name in the accessibility tree.
#[derive(Clone)]
pub struct Sought {
    /// The name.
    pub label: String,
    /// The title of the control's part of the interface, see [`note_part`].
    pub part: &'static str,
    /// The parameter of the control: if the control itself answers [`reveal`], the search by name ends.
    pub param: Option<&'static str>,
}

/// The search for a control.
#[derive(Clone)]
struct Named {
    sought: Sought,
    until_secs: f64,
    /// Where the part is in this frame.
    area: Option<(LayerId, Rect)>,
    /// Where the control was in the last frame.
    last: Option<Rect>,
    /// True if egui made an accessibility tree before the search.
    had_tree: bool,
}

fn named_id() -> Id {
    Id::unique("reveal named")
}

fn named(ctx: &Context) -> Option<Named> {
    ctx.data(|data| data.get_temp(named_id()))
}

/// True while a control is sought by its name, which needs egui's accessibility tree in every frame.
pub fn is_seeking(ctx: &Context) -> bool {
    named(ctx).is_some()
}

/// Begins to search for a control; [`focus_named`] gives the control the keyboard.
pub fn reveal_named(ctx: &Context, sought: Sought) {
    let until_secs = ctx.input(|input| input.time) + WAIT_SECS;
    let had_tree = ctx.has_accesskit_node(egui::accesskit_root_id());
    let named = Named { sought, until_secs, area: None, last: None, had_tree };
    ctx.data_mut(|data| data.insert_temp(named_id(), named));
    ctx.enable_accesskit();
    ctx.request_repaint();
}

fn end_search(ctx: &Context) {
    if named(ctx).is_some_and(|named| !named.had_tree) {
        ctx.disable_accesskit();
    }
    ctx.data_mut(|data| data.remove::<Named>(named_id()));
}

/// Says where a part of the interface is in this frame.
pub fn note_part(ui: &Ui, part: &str, area: Rect) {
    if let Some(named) = named(ui.ctx()).filter(|named| named.sought.part == part) {
        let named = Named { area: Some((ui.layer_id(), area)), ..named };
        ui.data_mut(|data| data.insert_temp(named_id(), named));
    }
}

/// Gives the keyboard to the control that is sought, once the control rests at its place.
///
/// Called at the end of a frame. Where the control is scrolled out of sight, its panel shows what has the keyboard.
/// Returns the control's name in the frame in which the search ends without the control.
pub fn focus_named(ctx: &Context) -> Option<String> {
    let named = named(ctx)?;
    let found = named.area.and_then(|area| place_of(ctx, &named.sought.label, area));
    let is_over = ctx.input(|input| input.time) > named.until_secs;
    let is_at_rest = found.is_some_and(|(_, rect)| is_over || named.last == Some(rect));
    if let Some((id, _)) = found.filter(|_| is_at_rest) {
        ctx.memory_mut(|memory| memory.request_focus(id));
    }
    ctx.request_repaint();
    if is_at_rest || is_over {
        end_search(ctx);
        return found.is_none().then_some(named.sought.label);
    }
    let last = found.map(|(_, rect)| rect).or(named.last);
    ctx.data_mut(|data| data.insert_temp(named_id(), Named { area: None, last, ..named }));
    None
}

/// The control of this name in an area of this frame, and its place.
fn place_of(ctx: &Context, label: &str, (layer, area): (LayerId, Rect)) -> Option<(Id, Rect)> {
    let widgets: Vec<(Id, Rect)> = ctx.viewport(|viewport| {
        let widgets = viewport.this_pass.widgets.get_layer(layer);
        let controls = widgets.filter(|widget| {
            widget.sense.is_focusable() && widget.enabled && area.contains(widget.rect.center())
        });
        controls.map(|widget| (widget.id, widget.rect)).collect()
    });
    widgets.into_iter().find(|(id, _)| {
        ctx.has_accesskit_node(*id)
            && ctx.accesskit_node_builder(*id, |node| node.label() == Some(label)) == Some(true)
    })
}
