// Brings the page up: asks whether the browser can do it, loads the module, starts it on the canvas.
// Whatever goes wrong is said in the notice, with what would help; the page never stays blank.

/** The module's size in bytes, filled in by the build: a host that compresses does not tell it. */
const WASM_BYTES = 0;

const part = (name) => document.getElementById(name);

/**
 * Shows the notice over the canvas, or hides it where `text` is empty.
 * The module calls this as well (for a graphics device that is gone for good, say).
 * @param {string} text what is the matter, in a few words
 * @param {string} [detail] what would help; line breaks are kept
 * @param {{again?: boolean, progress?: number}} [more] a button that loads the page again (unless
 *   `again` is false), a progress bar from 0 to 1 (NaN: under way, no telling how far)
 */
function notice(text, detail = "", { again = true, progress } = {}) {
  part("notice").hidden = !text;
  part("notice-text").textContent = text || "";
  part("notice-detail").textContent = detail;
  part("notice-again").hidden = !again;
  const bar = part("notice-progress");
  bar.hidden = progress === undefined;
  if (Number.isFinite(progress)) bar.value = progress;
  else bar.removeAttribute("value");
}

const loading = (text, progress) => notice("Mandelight", text, { again: false, progress });

/** What is missing for WebGPU here, as a text and what would help; nothing where all is there. */
async function missing() {
  if (!window.isSecureContext) {
    return {
      text: "This address is not secure",
      detail:
        "Mandelight computes on the graphics card, through WebGPU, and browsers offer that only to " +
        "pages from https:// addresses and from this computer itself.\n\n" +
        "Open the page by its https:// address, or from localhost.",
    };
  }
  if (!navigator.gpu) {
    return {
      text: "This browser has no WebGPU",
      detail:
        "Mandelight computes on the graphics card, through WebGPU, which this browser does not have " +
        "or has turned off.\n\n" +
        "A current Chrome or Edge has it, as do Safari from version 26 on and current Firefox on " +
        "Windows and macOS. On Linux it may have to be turned on in the browser's settings.",
    };
  }
  const adapter = await navigator.gpu.requestAdapter().catch(() => null);
  if (!adapter) {
    return {
      text: "No graphics card is on offer",
      detail:
        "This browser has WebGPU, but gives it no graphics card to compute on.\n\n" +
        "Turn on graphics (or hardware) acceleration in the browser's settings and start the " +
        "browser again; update the graphics driver; or try another browser, such as Chrome or Edge.",
    };
  }
}

/** Fetches the module and tells how much of it has come. */
async function fetched(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  let bytes = 0;
  const counter = new TransformStream({
    transform(chunk, stream) {
      bytes += chunk.byteLength;
      loading("Loading…", WASM_BYTES > 0 ? Math.min(bytes / WASM_BYTES, 1) : NaN);
      stream.enqueue(chunk);
    },
  });
  // The browser compiles while the module arrives, if the answer says that it is one.
  return new Response(response.body.pipeThrough(counter), {
    headers: { "Content-Type": "application/wasm" },
  });
}

/**
 * Sees to it that the canvas gets the pixels that it is shown in. Where a browser emulates another
 * screen, as for a phone in its developer tools, it may tell sizes in pixels of its own screen;
 * then those are left out, and the module goes by CSS pixels and their ratio.
 * @param {HTMLCanvasElement} canvas
 */
async function countPixels(canvas) {
  const entry = await new Promise((resolve) => {
    const observer = new ResizeObserver(([first]) => {
      observer.disconnect();
      resolve(first);
    });
    observer.observe(canvas);
    // A page in the background is told nothing.
    setTimeout(resolve, 500);
  });
  const told = entry?.devicePixelContentBoxSize?.[0]?.inlineSize;
  const expected = entry?.contentRect.width * window.devicePixelRatio;
  if (told > 0 && Math.abs(told / expected - 1) > 0.05) {
    delete ResizeObserverEntry.prototype.devicePixelContentBoxSize;
  }
}

async function boot() {
  loading("Loading…", NaN);
  const lack = await missing();
  if (lack) {
    notice(lack.text, lack.detail);
    return;
  }
  // Meanwhile.
  const counted = countPixels(part("mandelight"));
  let mandelight;
  try {
    mandelight = await import("./mandelight.js");
    const module = new URL("./mandelight_bg.wasm", import.meta.url);
    await mandelight.default({ module_or_path: fetched(module) });
  } catch (error) {
    console.error(error);
    notice("Mandelight could not be loaded", `${error}\n\nIs the connection up? Then try again.`);
    return;
  }
  try {
    loading("Starting…", NaN);
    await counted;
    await mandelight.start(part("mandelight"));
    notice("");
  } catch (error) {
    console.error(error);
    const reason = error instanceof Error ? error.message : String(error);
    notice(
      "Mandelight could not start",
      `${reason}\n\nClosing other pages that use the graphics card, or updating its driver, may help.`,
    );
  }
}

/** Whether the module itself has said what is the matter: it knows more than the trap tells. */
let told = false;

// A trap in the module ends it for good: better said than a picture that stands still.
const stopped = (error) => {
  if (error instanceof WebAssembly.RuntimeError && !told) {
    notice("Mandelight stopped", `Something went wrong inside (${error.message}).`);
  }
};
window.addEventListener("error", (event) => stopped(event.error));
window.addEventListener("unhandledrejection", (event) => stopped(event.reason));

window.mandelightNotice = (text, detail) => {
  told = true;
  notice(text, detail);
};
part("notice-again").addEventListener("click", () => window.location.reload());
boot();
