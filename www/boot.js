// Boots the page: checks for WebGPU, loads the module, starts it on the canvas.
// Every failure becomes a notice that says what to do; the page never stays blank.

import * as accessibility from "./accessibility.js";
import * as decoder from "./decoder.js";
import * as gallery from "./gallery.js";
import * as share from "./share.js";

/** The module's size in bytes, set by the build: a compressed response does not contain it. */
const WASM_BYTES = 0;

/** What the notice says until the page draws. */
let loadingText = "Opening the scene…";

const element = (id) => document.getElementById(id);

/**
 * Shows the notice over the canvas, or hides it where `text` is empty.
 * The module calls it too, for example after too many GPU losses.
 * @param {string} text the trouble, in a few words
 * @param {string} [detail] what to do; line breaks are kept
 * @param {{again?: boolean, progress?: number}} [options] `again`: whether to show the button that
 *   reloads the page; `progress`: a progress bar from 0 to 1, NaN where the part done is unknown
 */
function showNotice(text, detail = "", { again = true, progress } = {}) {
  element("notice").hidden = !text;
  // Progress leaves the opening picture in sight; an obstacle does not.
  element("notice").className = progress !== undefined && !element("opening").hidden ? "small" : "";
  element("notice-text").textContent = text || "";
  element("notice-detail").textContent = detail;
  element("notice-again").hidden = !again;
  const bar = element("notice-progress");
  bar.hidden = progress === undefined;
  if (Number.isFinite(progress)) bar.value = progress;
  else bar.removeAttribute("value");
}

/**
 * Shows the opening picture on a first visit, where the interface will draw the same. A link or a
 * stored scene opens on another picture.
 */
function showOpening() {
  if (window.location.hash.length > 1) return;
  try {
    if (localStorage.getItem("mandelight.scene")) return;
    const settings = JSON.parse(localStorage.getItem("mandelight.settings") ?? "{}");
    // The style sheet knows the places of the panel at a first visit alone.
    if (settings.timeline_open || (settings.sheet ?? "low") !== "low") return;
    element("opening").dataset.panel = settings.panel_open === false ? "hidden" : "shown";
  } catch {
    // Without storage, each visit is a first one.
  }
  element("opening").hidden = false;
  loadingText = "Loading…";
}

const showLoading = (text, progress) => showNotice("Mandelight", text, { again: false, progress });

/** The obstacle to WebGPU and what to do about it; undefined where WebGPU works. */
async function findObstacle() {
  if (!window.isSecureContext) {
    return {
      text: "This address is not secure",
      detail:
        "Mandelight draws with the graphics card, through WebGPU. Browsers allow that only to " +
        "pages from https:// addresses and from this computer itself.\n\n" +
        "Open the page by its https:// address, or from localhost.",
    };
  }
  if (!navigator.gpu) {
    return {
      text: "This browser has no WebGPU",
      detail:
        "Mandelight draws with the graphics card, through WebGPU. This browser does not have WebGPU, " +
        "or it is turned off.\n\n" +
        "Open the page in a current Chrome or Edge, in Safari 26 or later, or in a current Firefox on " +
        "Windows or macOS. On Linux, WebGPU may have to be turned on in the browser's settings.",
    };
  }
  const adapter = await navigator.gpu.requestAdapter().catch(() => null);
  if (!adapter) {
    return {
      text: "The browser offers no graphics card",
      detail:
        "Mandelight draws with the graphics card. This browser has WebGPU, but gives it no graphics " +
        "card to use.\n\n" +
        "Turn on graphics (or hardware) acceleration in the browser's settings and restart the " +
        "browser. If that does not help, update the graphics driver, or try another browser, such as " +
        "Chrome or Edge.",
    };
  }
}

/**
 * Fetches the module and shows the progress of the download. Without a connection, the module comes
 * from the files that the service worker keeps.
 */
async function fetchModule(url) {
  const response = await fetch(url).catch(() => null);
  if (!response?.ok) {
    const kept = await window.caches?.match(url.href);
    if (kept) return kept;
    const reason = response ? `${response.status} ${response.statusText}`.trim() : "no connection";
    throw new TypeError(`${url.pathname.split("/").pop()}: ${reason}`);
  }
  // The module is compiled from the response itself, for which the browser keeps the compiled code.
  // If it breaks off, the compilation fails too.
  showProgress(response.clone().body).catch(() => {});
  return response;
}

/** Whether the module is on its way; afterwards its progress is no longer shown. */
let isLoading = true;

/** Shows the progress of the module's download, of which `body` is a copy. */
async function showProgress(body) {
  let bytes = 0;
  const reader = body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    bytes += part.value.byteLength;
    if (isLoading && bytes < WASM_BYTES) showLoading(loadingText, bytes / WASM_BYTES);
  }
}

/**
 * Keeps the page for visits without a connection, and offers new versions. Pages of this computer
 * itself are under development, and would show old versions; `?offline` keeps those too.
 */
async function keepOffline() {
  const isKept = location.protocol === "https:" || new URLSearchParams(location.search).has("offline");
  if (!isKept || !navigator.serviceWorker) return;
  const workers = navigator.serviceWorker;
  let isAccepted = false;
  const offer = (worker) => {
    element("update").hidden = false;
    element("update-now").onclick = () => {
      isAccepted = true;
      worker.postMessage("activate");
    };
  };
  element("update-later").onclick = () => {
    element("update").hidden = true;
    element("mandelight").focus();
  };
  // Tab stays within the canvas's controls. F6 moves between them and the offer.
  const goToOffer = (event) => {
    const { key, ctrlKey, altKey, metaKey, shiftKey } = event;
    if (key !== "F6" || ctrlKey || altKey || metaKey || shiftKey || element("update").hidden) return;
    event.preventDefault();
    event.stopPropagation();
    const isInOffer = element("update").contains(document.activeElement);
    element(isInOffer ? "mandelight" : "update-now").focus();
  };
  window.addEventListener("keydown", goToOffer, { capture: true });
  workers.addEventListener("controllerchange", () => isAccepted && location.reload());
  const registration = await workers.register("./service-worker.js", { updateViaCache: "none" });
  if (registration.waiting && workers.controller) offer(registration.waiting);
  registration.addEventListener("updatefound", () => {
    const worker = registration.installing;
    worker?.addEventListener("statechange", () => {
      if (worker.state === "installed" && workers.controller) offer(worker);
    });
  });
}

/**
 * Removes `devicePixelContentBoxSize` where it is wrong, so that the module uses CSS pixels times
 * `devicePixelRatio`. A browser that emulates another screen can report pixels of its own screen.
 * @param {HTMLCanvasElement} canvas
 */
async function fixDevicePixels(canvas) {
  const entry = await new Promise((resolve) => {
    const observer = new ResizeObserver(([first]) => {
      observer.disconnect();
      resolve(first);
    });
    observer.observe(canvas);
    // A hidden page gets no callback.
    setTimeout(resolve, 500);
  });
  const reported = entry?.devicePixelContentBoxSize?.[0]?.inlineSize;
  const expected = entry?.contentRect.width * window.devicePixelRatio;
  if (reported > 0 && Math.abs(reported / expected - 1) > 0.05) {
    delete ResizeObserverEntry.prototype.devicePixelContentBoxSize;
  }
}

/** What went wrong while the page loaded, in plain words, with the browser's own words at the end. */
function explainLoading(error) {
  // Browsers report a lost connection as a TypeError, whose message is for programmers.
  if (error instanceof TypeError) {
    return (
      "A part of the page did not arrive. Check the internet connection, then try again. If that does not " +
      `help, update the browser.\n\n${error.message}`
    );
  }
  const detail = error instanceof Error ? error.message : String(error);
  if (error instanceof RangeError) {
    return `This device has too little free memory. Close other pages and programs, then try again.\n\n${detail}`;
  }
  return (
    "A part of the page arrived damaged, or this browser is too old for it. Try again; if that does not " +
    `help, update the browser.\n\n${detail}`
  );
}

async function boot() {
  // The document's own words, for where this script does not arrive.
  element("notice-late").remove();
  showOpening();
  showLoading(loadingText, NaN);
  const obstacle = await findObstacle();
  if (obstacle) {
    showNotice(obstacle.text, obstacle.detail);
    return;
  }
  // Not awaited yet: it runs while the module loads.
  const pixelsFixed = fixDevicePixels(element("mandelight"));
  let mandelight;
  try {
    mandelight = await import("./mandelight.js");
    const module = new URL("./mandelight_bg.wasm", import.meta.url);
    await mandelight.default({ module_or_path: fetchModule(module) });
  } catch (error) {
    // The rest of the module may still be on its way.
    isLoading = false;
    console.error(error);
    showNotice("Mandelight could not be loaded", explainLoading(error));
    return;
  }
  isLoading = false;
  noteEnd = mandelight.note_end;
  try {
    showLoading(loadingText, NaN);
    await pixelsFixed;
    await mandelight.start(element("mandelight"));
    showNotice("");
    keepOffline().catch((error) => console.warn("the page is not kept for visits offline:", error));
  } catch (error) {
    console.error(error);
    if (isTrap(error)) return reportTrap(error);
    const reason = error instanceof Error ? error.message : String(error);
    showNotice(
      "Mandelight could not start",
      `Close other pages that use the graphics card, or update its driver, then try again.\n\n${reason}`,
    );
  }
}

/** Whether the module has shown a notice of its own, which says more than a trap's message. */
let hasModuleNotice = false;

/** Notes in the storage that the scene in view ended the program. */
let noteEnd = () => {};

/** Shows that the program has ended by an error in it. */
const showStop = (reason) =>
  showNotice(
    "Mandelight stopped because of an error in the program",
    `Your scene is saved. Press “Try again”, then “Open the scene anyway”.\n\n${reason}`,
  );

/** Whether the module's code threw `error`: a trap, or a stack that is too deep, which Firefox calls an internal error. */
const isTrap = (error) =>
  error instanceof WebAssembly.RuntimeError ||
  (["RangeError", "InternalError"].includes(error?.name) && Boolean(error.stack?.includes("wasm")));

// A trap ends the module for good; without a notice the picture would just freeze.
const reportTrap = (error) => {
  if (!isTrap(error) || hasModuleNotice) return;
  showStop(error.message);
  try {
    noteEnd();
  } catch {
    // A broken module may throw again.
  }
};
window.addEventListener("error", (event) => reportTrap(event.error));
window.addEventListener("unhandledrejection", (event) => reportTrap(event.reason));

window.mandelightAccessibility = accessibility;
window.mandelightDecoder = decoder;
window.mandelightGallery = gallery;
window.mandelightShare = share;

/** A part that is loaded when it is first used; a failure says what helps. */
const part = (loading) =>
  loading.catch((error) => {
    throw new Error(`a part of the page did not arrive (load the page again): ${error.message}`);
  });
window.mandelightCodecs = () => part(import("./codecs.js"));
window.mandelightVideo = () => part(import("./video.js"));
window.mandelightNotice = (text, detail) => {
  hasModuleNotice = true;
  showNotice(text, detail);
};
window.mandelightStop = (reason) => {
  hasModuleNotice = true;
  showStop(reason);
};
element("notice-again").addEventListener("click", () => window.location.reload());
boot();
