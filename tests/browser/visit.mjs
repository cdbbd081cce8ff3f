// One visit to the page in a real browser: launches it, records its errors and observations.
//
// A script calls `visit(…)` with its steps. Its observations go to a folder, as `observations.json`
// and pictures, where tests/browser/main.rs checks them. This file records every error of the page, of
// its console and of the GPU; any of them fails the test.

import { mkdir, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { chromium } from "playwright-core";
import { host } from "./host.mjs";

const FLAGS = [
  "--headless=new",
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** WebGPU on Chromium's software GPU; without the last four, screenshots lack the canvas. */
const SOFTWARE_GPU = [
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
  "--enable-features=Vulkan",
  "--use-vulkan=swiftshader",
  "--use-angle=swiftshader",
  "--ignore-gpu-blocklist",
];

/** Context of visits whose screenshots show only failures: half the pixels per CSS pixel, a quarter of the work. Names of
 * screenshots give CSS pixels. */
export const COARSE = { deviceScaleFactor: 0.5 };

const POLL_MS = 50;

/** Longest wait for anything: only what hangs takes that long, on a busy machine with a software GPU too. */
const LIMIT_SECS = 600;

/** Longest wait for the screenshot of a failed visit. */
const FAILURE_LIMIT_MS = 30_000;

/** Chromium's error for a request that a navigation or a download aborted. */
const ABORTED = "net::ERR_ABORTED";

/**
 * Visits the page and writes the observations.
 * @param {{gpu?: boolean, context?: object}} options `gpu: false` starts the browser without a GPU;
 *   `context` goes to playwright's newContext (viewport, touch, pixels per point)
 * @param {(v: Visit) => Promise<void>} steps
 */
export async function visit({ gpu = true, context = {} }, steps) {
  const out = setting("MANDELIGHT_OUT");
  await mkdir(out, { recursive: true });
  const server = await host(setting("MANDELIGHT_DIST"), process.env.MANDELIGHT_PICTURES);
  const browser = await chromium.launch({
    executablePath: setting("MANDELIGHT_CHROMIUM"),
    args: [...FLAGS, ...(gpu ? SOFTWARE_GPU : ["--disable-gpu"])],
  });
  const v = new Visit(out, server, await browser.newContext(context));
  try {
    await v.open();
    await steps(v);
  } catch (error) {
    v.seen.failure = String(error?.stack ?? error);
    // At once: the test that reads the observations keeps its output to the end of all tests.
    console.error(`${v.seen.failure}\nerrors of the page: ${JSON.stringify(v.seen.errors, null, 2)}`);
    // A failed screenshot must not hide the failure itself, nor a tab that hangs hold it back.
    v.context.setDefaultTimeout(FAILURE_LIMIT_MS);
    await v.screenshot("failure").catch(() => {});
  } finally {
    v.seen.asked = server.requests;
    await writeFile(join(out, "observations.json"), `${JSON.stringify(v.seen, null, 2)}\n`);
    await browser.close();
    await server.close();
  }
}

/** A tab and its observations. */
export class Visit {
  constructor(out, server, context) {
    this.out = out;
    this.address = server.address;
    this.server = server;
    this.context = context;
    this.seen = { errors: [], secs: {} };
    /** Errors of the browser that the script provokes on purpose: texts that match. */
    this.provoked = null;
    /** Origins besides the page's own that the page may ask. */
    this.otherHosts = new Set();
  }

  /** Opens a tab and records every error in it. */
  async open() {
    this.context.setDefaultTimeout(LIMIT_SECS * 1000);
    this.tab = await this.context.newPage();
    // Browsers ask for it where a page links no icon.
    await this.context.route("**/favicon.ico", (route) => route.fulfill({ status: 204 }));
    const record = (kind, text) => {
      if (this.provoked?.test(text)) return;
      // A host that is down makes requests fail, on purpose.
      if (this.server.isDown && text.includes("net::ERR")) return;
      this.seen.errors.push(`${kind}: ${text}`);
    };
    this.tab.on("pageerror", (error) => record("page", error.stack ?? String(error)));
    this.context.on("request", (request) => {
      const { protocol, origin } = new URL(request.url());
      const isElsewhere = protocol.startsWith("http") && origin !== new URL(this.address).origin;
      if (isElsewhere && !this.otherHosts.has(origin)) record("request", `${origin} is another host`);
    });
    this.tab.on("crash", () => record("page", "the tab crashed"));
    this.tab.on("requestfailed", (request) => {
      // A navigation aborts requests (for an icon, say); those are no errors.
      if (request.failure()?.errorText === ABORTED) return;
      record("request", `${request.url()} (${request.failure()?.errorText})`);
    });
    this.tab.on("console", (message) => {
      const text = message.text();
      if (process.env.MANDELIGHT_TALK) console.error(`${message.type()}: ${text}`);
      // Chromium reports uncaught GPU errors as warnings.
      const isGpuError = /uncaptured|validation|\[Invalid /i.test(text);
      if (message.type() === "error" || isGpuError) record("console", text);
    });
  }

  /** The texts in sight of an element of the document: `{text, isButton, width, height, fontPx, contrast}` each,
   * in CSS pixels; contrast as WCAG 2.2 defines it, to the nearest background behind the text. */
  texts(selector) {
    return this.tab.evaluate((selector) => {
      const channels = (color) => color.match(/[\d.]+/g).map(Number);
      const luminance = (color) => {
        const linear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
        const [red, green, blue] = channels(color).map((value) => linear(value / 255));
        return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
      };
      const backgroundOf = (element) => {
        for (let it = element; it; it = it.parentElement) {
          const color = getComputedStyle(it).backgroundColor;
          if (channels(color)[3] !== 0) return color;
        }
        return "rgb(255, 255, 255)";
      };
      const own = (element) => [...element.childNodes].filter((node) => node.nodeType === Node.TEXT_NODE);
      const all = [...document.querySelectorAll(`${selector}, ${selector} *`)];
      return all.flatMap((element) => {
        const text = own(element).map((node) => node.data.trim()).join(" ").trim();
        if (text === "" || !element.checkVisibility({ visibilityProperty: true })) return [];
        const { color, fontSize } = getComputedStyle(element);
        const [dark, light] = [luminance(color), luminance(backgroundOf(element))].toSorted((a, b) => a - b);
        const { width, height } = element.getBoundingClientRect();
        const isButton = element.tagName === "BUTTON";
        return [{ text, isButton, width, height, fontPx: parseFloat(fontSize), contrast: (light + 0.05) / (dark + 0.05) }];
      });
    }, selector);
  }

  /** Polls `look` until its result is truthy, and returns that result. (playwright's own waiting
   * evaluates text, which the page's content security policy forbids.) */
  async until(what, look) {
    const start = performance.now();
    for (;;) {
      const result = await look();
      if (result) return result;
      if (performance.now() - start > LIMIT_SECS * 1000) {
        throw new Error(`gave up after ${LIMIT_SECS} s of waiting for ${what}`);
      }
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    }
  }

  /** Runs `step` and records its duration in seconds. */
  async timed(name, step) {
    const start = performance.now();
    const result = await step();
    this.seen.secs[name] = (performance.now() - start) / 1000;
    return result;
  }

  async screenshot(name) {
    await this.tab.screenshot({ path: join(this.out, `${name}.png`) });
  }

  /** Closes the window and goes on in a new one, which knows nothing of the first one. */
  async openAnew(context) {
    const browser = this.context.browser();
    await this.context.close();
    this.context = await browser.newContext(context);
    await this.open();
  }

  /** The final notice: the one that has the "Try again" button. */
  finalNotice() {
    return this.until("a notice", async () => {
      const notice = await this.notice();
      return notice?.again && notice;
    });
  }

  /** The notice over the page, or null while none is shown. */
  notice() {
    return this.tab.evaluate(() => {
      if (document.getElementById("notice").hidden) return null;
      const shown = (name) => {
        const element = document.getElementById(`notice-${name}`);
        return element.hidden ? null : element.textContent;
      };
      return { text: shown("text"), detail: shown("detail"), again: shown("again") };
    });
  }
}

function setting(name) {
  const value = process.env[name];
  if (!value) throw new Error(`${name} is not set: run this script through \`cargo xtask test\``);
  return value;
}
