// The interface for screen readers: an unseen HTML element for each widget on the canvas.
//
// The canvas keeps the keyboard, and names the element of the widget that has it. An element that is
// pressed, changed or reached by a screen reader tells the program.

const page = () => document.getElementById("accessible-page");
const canvas = () => document.getElementById("mandelight");

/** The program's listener: `(id, request, value) => void`; `request` is "press", "focus" or "set". */
let listener = () => {};
/** The HTML element of each widget's id. */
const shown = new Map();

/** Sets who hears of requests. */
export function listen(newListener) {
  listener = newListener;
}

/** The input that eframe puts after the canvas, and that has the focus while text is typed. */
function keyboardInput() {
  const next = canvas().nextElementSibling;
  return next instanceof HTMLInputElement ? next : undefined;
}

/** The tags of widgets that are no inputs, by kind. */
const tags = { button: "button", checkbox: "button", radio: "button", text: "span", image: "span" };
/** The types of those that are inputs. */
const inputTypes = { slider: "range", number: "number", textbox: "text" };
const roles = {
  checkbox: "checkbox",
  radio: "radio",
  image: "img",
  alert: "alert",
  place: "group",
  progress: "progressbar",
};

/** A new HTML element for a widget of a kind. */
function create(id, kind) {
  const type = inputTypes[kind];
  const element = document.createElement(type ? "input" : tags[kind] ?? "div");
  element.id = `widget-${id}`;
  element.dataset.kind = kind;
  if (type) element.type = type;
  if (roles[kind]) element.setAttribute("role", roles[kind]);
  if (["text", "image", "alert", "progress"].includes(kind)) return element;
  // The Tab key is egui's; a screen reader comes here in its own way.
  element.tabIndex = -1;
  if (element instanceof HTMLButtonElement) {
    element.type = "button";
    element.addEventListener("click", () => listener(id, "press", 0));
  } else if (kind === "textbox") {
    // Text is typed into the canvas.
    element.addEventListener("focus", () => canvas().focus({ preventScroll: true }));
  } else if (type) {
    const set = () => element.value !== "" && listener(id, "set", element.valueAsNumber);
    element.addEventListener(kind === "slider" ? "input" : "change", set);
  }
  element.addEventListener("focus", () => listener(id, "focus", 0));
  return element;
}

function setAttribute(element, name, value) {
  if (value === undefined || value === null) element.removeAttribute(name);
  else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, String(value));
}

/** Brings an HTML element to its widget's state. */
function update(element, widget) {
  const { kind, name, bounds } = widget;
  if (kind === "text" || kind === "alert") {
    if (element.textContent !== name) element.textContent = name;
  } else {
    setAttribute(element, "aria-label", name);
  }
  setAttribute(element, "aria-description", widget.help);
  setAttribute(element, "aria-disabled", widget.disabled || undefined);
  if (kind === "button") {
    setAttribute(element, "aria-pressed", widget.pressed);
    setAttribute(element, "aria-expanded", widget.expanded);
  } else if (kind === "checkbox") {
    setAttribute(element, "aria-checked", widget.checked ?? "mixed");
  } else if (kind === "radio") {
    setAttribute(element, "aria-checked", widget.checked);
  } else if (kind === "slider" || kind === "number") {
    setAttribute(element, "min", widget.min);
    setAttribute(element, "max", widget.max);
    // A number that is typed need not be on the slider's grid.
    setAttribute(element, "step", kind === "slider" ? (widget.step ?? "any") : "any");
    setAttribute(element, "aria-valuetext", widget.value);
    const isTyping = kind === "number" && document.activeElement === element;
    if (!isTyping) element.value = String(widget.now);
  } else if (kind === "textbox") {
    element.value = widget.value ?? "";
  }
  const [left, top, width, height] = bounds;
  Object.assign(element.style, {
    left: `${left}px`,
    top: `${top}px`,
    width: `${width}px`,
    height: `${height}px`,
  });
}

/** Names the element that has the keyboard, on whatever takes the keys for the canvas. */
function showFocus(id) {
  const focused = id === null ? undefined : `widget-${id}`;
  const input = keyboardInput();
  for (const taker of [canvas(), input]) {
    if (!taker) continue;
    setAttribute(taker, "role", "application");
    setAttribute(taker, "aria-activedescendant", focused);
    // An element has one owner: the one that takes the keys.
    const isOwner = taker === (document.activeElement === canvas() ? canvas() : input ?? canvas());
    setAttribute(taker, "aria-owns", isOwner ? page().id : undefined);
  }
  if (!input) return;
  setAttribute(input, "aria-label", "Mandelight");
  // Otherwise the page would have two places to reach with the Tab key that are one.
  if (input.tabIndex !== -1) input.tabIndex = -1;
}

/**
 * Shows the interface's elements to screen readers.
 * @param {string} json `{elements, focus}`, from src/ui/accessibility.rs
 */
export function show(json) {
  const { elements, focus } = JSON.parse(json);
  const left = new Set(shown.keys());
  let place = page().firstElementChild;
  for (const widget of elements) {
    left.delete(widget.id);
    let element = shown.get(widget.id);
    if (element?.dataset.kind !== widget.kind) {
      if (element === place) place = place?.nextElementSibling ?? null;
      element?.remove();
      element = create(widget.id, widget.kind);
      shown.set(widget.id, element);
    }
    update(element, widget);
    if (element === place) place = place.nextElementSibling;
    else page().insertBefore(element, place);
  }
  for (const id of left) {
    shown.get(id).remove();
    shown.delete(id);
  }
  showFocus(focus);
}

/** Gives keys that are not an element's own to the canvas, which takes the focus with them. */
function passKeyOn(event) {
  const isCommand = event.ctrlKey || event.metaKey || event.altKey;
  if (event.key !== "Tab" && event.key !== "Escape" && !isCommand) return;
  canvas().focus({ preventScroll: true });
  const { key, code, shiftKey, ctrlKey, metaKey, altKey } = event;
  const copy = { key, code, shiftKey, ctrlKey, metaKey, altKey, bubbles: true, cancelable: true };
  if (!canvas().dispatchEvent(new KeyboardEvent("keydown", copy))) event.preventDefault();
  canvas().dispatchEvent(new KeyboardEvent("keyup", copy));
}

page().addEventListener("keydown", passKeyOn);
