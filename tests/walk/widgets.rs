//! Actions on the widgets that the accessibility tree has.

use egui::{
    Event, Modifiers, PointerButton, Rect,
    accesskit::{Action, ActionData, ActionRequest, Role},
    vec2,
};
use egui_kittest::kittest::NodeT as _;

use crate::walker::{Formulas, Walker};

/// Texts that people type, paste or let fall on the keyboard.
const TEXTS: [&str; 28] = [
    "9",
    "-",
    "1e9",
    "nan",
    "inf",
    ".5",
    "0,5",
    "1,000.5",
    "−3",
    "+",
    "1e-400",
    "1e400",
    "0",
    "99999999999999999999999999999999",
    "٣",
    "½",
    "abc",
    "\u{202e}gnp",
    "é🙂",
    "a\nb\tc",
    "",
    " ",
    "2^3",
    "50 %",
    "0x10",
    "power",
    "z = z*z + c;",
    "\u{0}\u{7f}\u{fffd}",
];

/// Numbers that a screen reader may set.
const NUMBERS: [f64; 12] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    3.7,
    1e9,
    -1e300,
    f64::MIN_POSITIVE,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
];

/// A widget of the last frame.
#[derive(Clone)]
struct Widget {
    role: Role,
    name: String,
    rect: Rect,
    range: Option<[f64; 2]>,
    /// The request that a screen reader sends, without its action.
    request: ActionRequest,
}

impl Walker {
    fn widgets(&self) -> Vec<Widget> {
        let nodes = self.harness.root().children_recursive();
        nodes
            .filter(|node| {
                let role = node.accesskit_node().role();
                egui::accessibility::is_input(role) || role == Role::Window
            })
            .filter(|node| node.accesskit_node().bounding_box().is_some())
            .map(|node| {
                let inner = node.accesskit_node();
                let (target_node, target_tree) = inner.locate();
                let action = Action::Click;
                Widget {
                    role: inner.role(),
                    name: inner.label().unwrap_or_default(),
                    rect: node.rect(),
                    range: inner
                        .min_numeric_value()
                        .zip(inner.max_numeric_value())
                        .map(|(a, b)| [a, b]),
                    request: ActionRequest { action, target_node, target_tree, data: None },
                }
            })
            .filter(|widget| {
                self.formulas == Formulas::Typed || widget.role != Role::MultilineTextInput
            })
            .collect()
    }

    /// Does something with a random widget.
    pub fn use_widget(&mut self) {
        let widgets = self.widgets();
        if widgets.is_empty() {
            self.log("no widgets".to_owned());
            return self.frame();
        }
        let widget = self.pick(&widgets);
        let at =
            if self.dice.chance(0.7) { widget.rect.center() } else { self.point_of(widget.rect) };
        let what = self.below(14);
        let (role, name) = (widget.role, &widget.name);
        self.log(format!("{} {role:?} {name:?} at {at:?}", NAMES[what]));
        match what {
            0..4 => self.click(at, PointerButton::Primary, Modifiers::NONE),
            4 => {
                self.click(at, PointerButton::Primary, Modifiers::NONE);
                self.click(at, PointerButton::Primary, Modifiers::NONE);
            }
            5 => {
                let button = self.pick(&[PointerButton::Secondary, PointerButton::Middle]);
                let modifiers = self.pick(&[Modifiers::NONE, Modifiers::SHIFT, Modifiers::ALT]);
                self.click(at, button, modifiers);
            }
            6 | 7 => {
                let [x, y] = [(); 2].map(|()| 160.0 * self.dice.signed() as f32);
                self.drag(at, at + vec2(x, y), PointerButton::Primary, Modifiers::NONE);
            }
            8 => {
                self.event(Event::PointerMoved(at));
                self.frame();
                // Long enough for a tooltip.
                let now_secs = self.harness.ctx.input(|input| input.time);
                self.harness.input_mut().time = Some(now_secs + 1.0);
                self.frame();
                self.harness.input_mut().time = None;
            }
            9 => self.request(&widget, Action::Click, None),
            10 => self.request(&widget, Action::Focus, None),
            11 => {
                let action =
                    self.pick(&[Action::Increment, Action::Decrement, Action::ScrollIntoView]);
                self.request(&widget, action, None);
            }
            12 => {
                let number = match widget.range {
                    Some([min, max]) if self.dice.chance(0.6) => {
                        min + (max - min) * self.dice.unit()
                    }
                    _ => self.pick(&NUMBERS),
                };
                self.request(&widget, Action::SetValue, Some(ActionData::NumericValue(number)));
            }
            _ => {
                let text = self.pick(&TEXTS);
                self.request(&widget, Action::SetValue, Some(ActionData::Value(text.into())));
            }
        }
    }

    fn request(&mut self, widget: &Widget, action: Action, data: Option<ActionData>) {
        let request = ActionRequest { action, data, ..widget.request.clone() };
        self.event(Event::AccessKitActionRequest(request));
        self.frame();
        self.frame();
    }

    /// Types or pastes into whatever has the keyboard, mostly after giving it to a field.
    pub fn type_something(&mut self) {
        let fields: Vec<Widget> =
            self.widgets().into_iter().filter(|it| is_field(it.role)).collect();
        if !fields.is_empty() && self.dice.chance(0.7) {
            let field = self.pick(&fields);
            self.log(format!("focus {:?} {:?}", field.role, field.name));
            self.click(field.rect.center(), PointerButton::Primary, Modifiers::NONE);
            if self.dice.chance(0.5) {
                self.key(egui::Key::A, Modifiers::COMMAND);
            }
        } else if self.formulas == Formulas::AsTheyAre {
            // The formula editor may have the keyboard.
            return self.frame();
        }
        let text = match self.below(12) {
            0 => "7".repeat(5000),
            1 => "length(z) ".repeat(300),
            _ => self.pick(&TEXTS).to_owned(),
        };
        let shown: String = text.chars().take(40).collect();
        self.log(format!("type {shown:?}, {} bytes", text.len()));
        let is_pasted = self.dice.chance(0.3);
        self.event(if is_pasted { Event::Paste(text) } else { Event::Text(text) });
        self.frame();
        let key =
            self.pick(&[egui::Key::Enter, egui::Key::Tab, egui::Key::Escape, egui::Key::Backspace]);
        if self.dice.chance(0.8) {
            self.key(key, Modifiers::NONE);
            self.frame();
        }
    }
}

/// The names of the actions in [`Walker::use_widget`].
const NAMES: [&str; 14] = [
    "click",
    "click",
    "click",
    "click",
    "double click",
    "other click",
    "drag",
    "drag",
    "hover",
    "press",
    "focus",
    "step",
    "set number",
    "set text",
];

fn is_field(role: Role) -> bool {
    matches!(
        role,
        Role::TextInput | Role::MultilineTextInput | Role::SpinButton | Role::NumberInput
    )
}
