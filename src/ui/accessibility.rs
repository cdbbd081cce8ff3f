//! The interface as a screen reader reads it: egui's accessibility tree as a list of elements.
//!
//! In: the tree of a frame. Out: [`Element`]s in reading order for the shell, which shows them to screen
//! readers (on the web, as unseen HTML). The shell's requests come back through [`ScreenReader::request`].

use std::collections::HashMap;

use egui::{
    Context, FullOutput, Plugin, RawInput, Ui,
    accesskit::{
        Action, ActionData, ActionRequest, Node, NodeId, Role, Toggled, TreeId, TreeUpdate,
    },
};
use serde::Serialize;

use super::widgets::is_seeking;

/// What an [`Element`] is, and its state of that kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase", tag = "kind")]
pub enum Kind {
    /// Text to read.
    Text,
    /// A picture; the name says of what.
    Image,
    /// A message that is read out at once.
    Alert,
    /// The progress of work.
    Progress,
    /// A button.
    Button {
        /// Whether a button that stays down is down.
        pressed: Option<bool>,
        /// Whether the button's section is open.
        expanded: Option<bool>,
    },
    /// A box to tick.
    Checkbox {
        /// Whether it is ticked; `None` if some of what it stands for is.
        checked: Option<bool>,
    },
    /// One of several choices.
    Radio {
        /// Whether it is chosen.
        checked: bool,
    },
    /// A slider, or a divider that can be moved.
    Slider(Range),
    /// A place in an area, such as a direction: the arrow keys move it.
    Place,
    /// A number to type.
    Number(Range),
    /// Text to edit.
    Textbox,
}

/// A number and its limits, in the parameter's own unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Range {
    /// The value.
    pub now: f64,
    /// The smallest value, where there is one.
    pub min: Option<f64>,
    /// The largest value, where there is one.
    pub max: Option<f64>,
    /// The difference between neighbouring values.
    pub step: Option<f64>,
}

/// Something that a screen reader reads or acts on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Element {
    /// The widget's id. A text, for JavaScript's numbers hold 53 bits.
    pub id: String,
    /// What it is.
    #[serde(flatten)]
    pub kind: Kind,
    /// The name that is read out.
    pub name: String,
    /// The help that can be read out after the name.
    pub help: Option<String>,
    /// The value as text, where it is one.
    pub value: Option<String>,
    /// Whether it cannot be used now.
    pub disabled: bool,
    /// Left, top, width and height in points.
    pub bounds: [f64; 4],
}

/// The interface's elements at one time.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Elements {
    /// The elements in reading order.
    pub elements: Vec<Element>,
    /// The id of the element that has the keyboard.
    pub focus: Option<String>,
}

impl Elements {
    /// The elements of egui's tree: without containers and parts of texts.
    pub fn of_tree(tree: &TreeUpdate) -> Self {
        let nodes: HashMap<NodeId, &Node> =
            tree.nodes.iter().map(|(id, node)| (*id, node)).collect();
        let mut elements = Vec::new();
        let mut seen = 0;
        let mut stack: Vec<NodeId> = tree.tree.iter().map(|tree| tree.root).collect();
        while let Some(id) = stack.pop() {
            let Some(node) = nodes.get(&id) else { continue };
            // A tree has each node once; a cycle would never end.
            seen += 1;
            if seen > nodes.len() {
                break;
            }
            elements.extend(element(id, node, &nodes));
            stack.extend(node.children().iter().rev());
        }
        let focus = text_of_id(tree.focus);
        let focus = elements.iter().any(|element| element.id == focus).then_some(focus);
        Self { elements, focus }
    }
}

fn text_of_id(id: NodeId) -> String {
    format!("{:x}", id.0)
}

/// The element of a node; `None` for containers, and for what has neither name nor use.
fn element(id: NodeId, node: &Node, nodes: &HashMap<NodeId, &Node>) -> Option<Element> {
    let kind = kind(node)?;
    let name = name(node, nodes);
    if name.is_empty() && matches!(kind, Kind::Text | Kind::Image | Kind::Alert) {
        return None;
    }
    let value = match kind {
        // Their value is their name.
        Kind::Text | Kind::Alert => None,
        _ => node.value().map(str::to_owned),
    };
    let rect = node.bounds().unwrap_or_default();
    Some(Element {
        id: text_of_id(id),
        kind,
        name,
        help: node.description().map(str::to_owned),
        value,
        disabled: node.is_disabled(),
        bounds: [rect.x0, rect.y0, rect.width(), rect.height()].map(f64::round),
    })
}

/// A node's own name, else that of its labels.
fn name(node: &Node, nodes: &HashMap<NodeId, &Node>) -> String {
    let own = |node: &Node| match node.role() {
        Role::Label | Role::Heading => node.value().or(node.label()).map(str::to_owned),
        _ => node.label().map(str::to_owned),
    };
    own(node).unwrap_or_else(|| {
        let labels = node.labelled_by().iter().filter_map(|id| own(nodes.get(id)?));
        labels.collect::<Vec<_>>().join(" ")
    })
}

/// What a node is to a screen reader; `None` for containers.
fn kind(node: &Node) -> Option<Kind> {
    let is_on = |toggled: Toggled| toggled == Toggled::True;
    let range = || Range {
        now: node.numeric_value().unwrap_or(0.0),
        min: node.min_numeric_value(),
        max: node.max_numeric_value(),
        step: node.numeric_value_step(),
    };
    Some(match node.role() {
        // egui's text runs repeat the text of their label.
        Role::TextRun => return None,
        Role::Label | Role::Heading | Role::Status => Kind::Text,
        Role::Alert => Kind::Alert,
        Role::ProgressIndicator => Kind::Progress,
        Role::CheckBox | Role::Switch => Kind::Checkbox {
            checked: match node.toggled() {
                Some(Toggled::Mixed) => None,
                toggled => Some(toggled.is_some_and(is_on)),
            },
        },
        Role::RadioButton => Kind::Radio { checked: node.toggled().is_some_and(is_on) },
        Role::Slider if node.numeric_value().is_none() => Kind::Place,
        Role::Slider | Role::Splitter => Kind::Slider(range()),
        Role::SpinButton => Kind::Number(range()),
        Role::TextInput | Role::MultilineTextInput | Role::SearchInput => Kind::Textbox,
        Role::Image | Role::Canvas => Kind::Image,
        _ if node.supports_action(Action::Click) && has_name(node) => {
            Kind::Button { pressed: node.toggled().map(is_on), expanded: node.is_expanded() }
        }
        _ => return None,
    })
}

fn has_name(node: &Node) -> bool {
    node.label().is_some() || !node.labelled_by().is_empty()
}

/// What a screen reader asks of an element.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// To press it.
    Press,
    /// To give it the keyboard, and show it.
    Focus,
    /// To set its number.
    SetNumber(f64),
}

/// Takes the elements out of frames, and puts requests into them.
///
/// egui makes a tree only for frames that ask for one, since it costs them some time. A frame asks if the
/// last tree is old enough; otherwise it requests a later frame, so that the last change is never missed.
pub struct ScreenReader {
    show: fn(&Elements),
    interval_secs: f64,
    shown: Elements,
    requests: Vec<ActionRequest>,
    next_secs: f64,
    /// Seconds until the next tree; `None` in a frame that makes one.
    wait_secs: Option<f64>,
}

impl ScreenReader {
    /// A screen reader's side of an interface; `show` gets the elements at every change, at least
    /// `interval_secs` apart unless requests or a search for a control come in between.
    pub fn new(show: fn(&Elements), interval_secs: f64) -> Self {
        let shown = Elements::default();
        Self { show, interval_secs, shown, requests: Vec::new(), next_secs: 0.0, wait_secs: None }
    }

    /// Passes a request on to the next frame. Does nothing for an id that is none.
    pub fn request(&mut self, id: &str, request: &Request) {
        let Ok(id) = u64::from_str_radix(id, 16) else { return };
        let (action, data) = match *request {
            Request::Press => (Action::Click, None),
            Request::Focus => (Action::Focus, None),
            Request::SetNumber(value) => (Action::SetValue, Some(ActionData::NumericValue(value))),
        };
        let (target_tree, target_node) = (TreeId::ROOT, NodeId(id));
        self.requests.push(ActionRequest { action, target_tree, target_node, data });
    }
}

impl Plugin for ScreenReader {
    fn debug_name(&self) -> &'static str {
        "screen reader"
    }

    fn input_hook(&mut self, context: &Context, input: &mut RawInput) {
        let now_secs = input.time.unwrap_or_else(|| context.input(|input| input.time));
        // An answer to a request is not kept waiting.
        if now_secs >= self.next_secs || !self.requests.is_empty() {
            context.enable_accesskit();
            self.next_secs = now_secs + self.interval_secs;
            self.wait_secs = None;
        } else {
            // The search for a control reads the tree of every frame.
            if is_seeking(context) {
                context.enable_accesskit();
            } else {
                context.disable_accesskit();
            }
            self.wait_secs = Some(self.next_secs - now_secs);
        }
        input.events.extend(self.requests.drain(..).map(egui::Event::AccessKitActionRequest));
    }

    fn on_begin_pass(&mut self, ui: &mut Ui) {
        if let Some(secs) = self.wait_secs {
            ui.ctx().request_repaint_after_secs(secs as f32);
        }
    }

    fn output_hook(&mut self, _context: &Context, output: &mut FullOutput) {
        let Some(tree) = &output.platform_output.accesskit_update else { return };
        let elements = Elements::of_tree(tree);
        if elements != self.shown {
            (self.show)(&elements);
            self.shown = elements;
        }
    }
}
