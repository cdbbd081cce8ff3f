// Files dropped on the page: good ones, damaged ones, and ones that end their decoder.

import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";

import { Mandelight } from "./mandelight.mjs";
import { COARSE, visit } from "./visit.mjs";

const GOOD = process.env.MANDELIGHT_FILES;
const DAMAGED = new URL("./damaged/", import.meta.url).pathname;

/** Seconds that a decoder without end has. */
const LOOP_SECS = 10;

await visit({ context: { ...COARSE, viewport: { width: 640, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  await page.open();
  await page.redrawn(() => v.tab.evaluate(() => {
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = 1;
    window.mandelight.setScene(JSON.stringify(document));
  }));

  /** Drops a file as a visitor does, under the name `as`. */
  const drop = async (file, as) => {
    const base64 = (await readFile(file)).toString("base64");
    await v.tab.evaluate(([name, text]) => {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      const dataTransfer = new DataTransfer();
      dataTransfer.items.add(new File([bytes], name));
      const options = { dataTransfer, bubbles: true, cancelable: true };
      document.getElementById("mandelight").dispatchEvent(new DragEvent("drop", options));
    }, [as, base64]);
  };
  const breakDecoder = (kind, secs) =>
    v.tab.evaluate(([fault, max]) => window.mandelight.breakDecoder(fault, max), [kind, secs]);
  const loaded = (name) => v.until(`the map ${name}`, () => v.tab.evaluate((wanted) => {
    const map = window.mandelight.environmentMap();
    return map?.name === wanted && { ...map, pixels: Array.from(map.pixels) };
  }, name));
  const hdr = join(GOOD, "sky.hdr");

  v.seen.maps = {};
  for (const name of ["sky.hdr", "sky.exr"]) {
    await drop(join(GOOD, name), name);
    v.seen.maps[name] = await v.timed(name, () => loaded(name));
  }
  v.seen.scenes = {};
  v.seen.scenes.dropped = await page.changed("a dropped picture", () => drop(join(GOOD, "scene.png"), "scene.png"));
  await drop(join(GOOD, "colors.map"), "colors.map");
  v.seen.colored = await page.says("colors.map now colours the surface");
  await page.settled();

  // Each of these costs its file only.
  v.seen.failures = [];
  const state = async () => ({ scene: await page.scene(), memory: (await page.report()).memoryBytes });
  const fails = async (file, name, reason, meanwhile) => {
    const before = await state();
    await drop(file, name);
    await meanwhile?.();
    await page.says(`${name} could not be opened: ${reason}`);
    const after = await state();
    v.seen.failures.push({ name, isSame: before.scene === after.scene, grown: after.memory - before.memory });
    const next = `after ${name}.hdr`;
    await drop(hdr, next);
    await loaded(next);
  };
  await breakDecoder("panic", 60);
  await fails(hdr, "panic.hdr", "reading it ended with an error of the program");
  await breakDecoder("memory", 60);
  await fails(hdr, "memory.hdr", "reading it takes more memory than a file may use");
  await breakDecoder("loop", LOOP_SECS);
  await fails(hdr, "loop.hdr", `reading it takes more than ${LOOP_SECS} seconds`, async () => {
    await page.says("Reading loop.hdr");
    await v.screenshot("reading-640x420");
  });
  for (const name of await readdir(DAMAGED)) await fails(join(DAMAGED, name), name, "");

  // A visitor stops a file that takes long; a newer file takes the place of an older one.
  await breakDecoder("loop", 60);
  await drop(hdr, "cancelled.hdr");
  await page.says("Reading cancelled.hdr");
  const { x, y, width, height } = await page.rested("the message", () => page.rect("reading"));
  await v.tab.mouse.click(x + width - 20, y + height / 2);
  v.seen.cancelled = await page.says("Reading the file was cancelled");
  v.seen.reading = (await page.report()).reading;
  await breakDecoder("loop", 60);
  await drop(hdr, "older.hdr");
  await page.says("Reading older.hdr");
  await drop(hdr, "newer.hdr");
  v.seen.newest = (await loaded("newer.hdr")).name;
  // The browser tells of a worker's end some time later.
  await v.until("the last worker to end", () => v.tab.workers().length === 0);
  v.seen.workers = v.tab.workers().length;
});
