// One visit to the page in a real browser: launching it, watching it for errors, leaving a record.
//
// A script tells a visit's story with `visit(…)`. What it observes lands in a folder, as
// `observations.json` and pictures, for tests/browser.rs to judge. Only errors of the page, of its
// console or of the GPU are judged here: each of them is put on the record.

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

/** WebGPU on Chromium's own software; without the last four a screenshot shows no canvas. */
const SOFTWARE_GPU = [
  "--enable-unsafe-webgpu",
  "--use-webgpu-adapter=swiftshader",
  "--enable-features=Vulkan",
  "--use-vulkan=swiftshader",
  "--use-angle=swiftshader",
  "--ignore-gpu-blocklist",
];

const POLL_MS = 50;

/** What Chromium says of a request that its page's leaving, or a download, broke off. */
const LEFT = "net::ERR_ABORTED";

/**
 * Visits the page.
 * @param {{gpu?: boolean, context?: object}} how `gpu: false` starts the browser without a GPU;
 *   `context` goes to playwright's newContext (viewport, touch, pixels per point)
 * @param {(v: Visit) => Promise<void>} story
 */
export async function visit({ gpu = true, context = {} }, story) {
  const out = setting("MANDELIGHT_OUT");
  await mkdir(out, { recursive: true });
  const server = await host(setting("MANDELIGHT_DIST"));
  const browser = await chromium.launch({
    executablePath: setting("MANDELIGHT_CHROMIUM"),
    args: [...FLAGS, ...(gpu ? SOFTWARE_GPU : ["--disable-gpu"])],
  });
  const v = new Visit(out, server, await browser.newContext(context));
  try {
    await v.open();
    await story(v);
  } catch (error) {
    v.seen.failure = String(error?.stack ?? error);
    // The picture is a help only; the failure is what counts.
    await v.screenshot("failure").catch(() => {});
  } finally {
    v.seen.asked = server.asked;
    await writeFile(join(out, "observations.json"), `${JSON.stringify(v.seen, null, 2)}\n`);
    await browser.close();
    await server.close();
  }
}

/** A tab and what was seen in it. */
export class Visit {
  constructor(out, server, context) {
    this.out = out;
    this.address = server.address;
    this.context = context;
    this.seen = { errors: [], secs: {} };
  }

  /** Opens a tab that keeps a record of everything that goes wrong in it. */
  async open() {
    this.tab = await this.context.newPage();
    const note = (kind, text) => this.seen.errors.push(`${kind}: ${text}`);
    this.tab.on("pageerror", (error) => note("page", error.stack ?? String(error)));
    this.tab.on("crash", () => note("page", "the tab crashed"));
    this.tab.on("requestfailed", (request) => {
      // What was still under way when the tab went to another page (an icon, say) failed nobody.
      if (request.failure()?.errorText === LEFT) return;
      note("request", `${request.url()} (${request.failure()?.errorText})`);
    });
    this.tab.on("console", (message) => {
      const text = message.text();
      if (process.env.MANDELIGHT_TALK) console.error(`${message.type()}: ${text}`);
      // Chromium reports GPU errors that nobody caught as mere warnings.
      const fromGpu = /uncaptured|validation|\[Invalid /i.test(text);
      if (message.type() === "error" || fromGpu) note("console", text);
    });
  }

  /** Waits until `look` returns something true, and returns that. (playwright's own waiting
   * evaluates text, which the page's content security policy forbids.) */
  async until(what, look, limitSecs = 240) {
    const start = performance.now();
    for (;;) {
      const found = await look();
      if (found) return found;
      if (performance.now() - start > limitSecs * 1000) {
        throw new Error(`waited ${limitSecs} s in vain for ${what}`);
      }
      await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    }
  }

  /** Runs `step` and notes the seconds that it took. */
  async timed(name, step) {
    const start = performance.now();
    const result = await step();
    this.seen.secs[name] = (performance.now() - start) / 1000;
    return result;
  }

  async screenshot(name) {
    await this.tab.screenshot({ path: join(this.out, `${name}.png`) });
  }

  /** The notice over the page; null while it is hidden. */
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
  if (!value) throw new Error(`${name} is not set: run this by \`cargo xtask test\``);
  return value;
}
