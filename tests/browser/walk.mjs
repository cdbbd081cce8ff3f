// A random walk over the page by real pointer and key events: other sizes and pixel ratios, a canvas without a size, a
// hidden tab, exports that are cancelled. Rounds of it are compared: what the page and the GPU hold must not grow.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const SIZE = { width: 480, height: 320 };
const SIZES = [SIZE, { width: 320, height: 480 }, { width: 1, height: 1 }, { width: 844, height: 390 }, { width: 200, height: 60 }];
const PIXEL_RATIOS = [1, 1, 0.5, 1.25, 2];
const ACTIONS = 100;
/** The first round makes what is made once. */
const ROUNDS = 3;
const SEED = Number(process.env.MANDELIGHT_SEED || 1);

/** Keys of commands, but for those that open dialogues of the browser. */
const KEYS = [
  ..."12345678hadnrmflkjutpcoq,.? ", "+", "-", "Shift+C", "Shift+ArrowLeft", "ArrowLeft", "ArrowUp", "Escape", "Delete", "Tab",
  "Enter", "PageDown", "Control+z", "Control+y", "Control+Shift+z", "Control+s", "Control+k",
];

/** Random numbers that come out the same each time (mulberry32). */
function random(seed) {
  let state = seed | 0;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

await visit({ context: { viewport: SIZE, acceptDownloads: true } }, async (v) => {
  const page = new Mandelight(v);
  const unit = random(SEED);
  const below = (limit) => Math.floor(unit() * limit);
  const pick = (items) => items[below(items.length)];
  const { keyboard, mouse } = v.tab;
  const done = (v.seen.done = []);

  // WebGPU's textures and buffers that were created and neither destroyed nor collected.
  await v.tab.addInitScript(() => {
    // A blank page has no WebGPU.
    if (!window.GPUDevice) return;
    const held = (window.heldByGpu = { textures: [], buffers: [] });
    const watch = (method, list, bytesOf) => {
      const create = GPUDevice.prototype[method];
      GPUDevice.prototype[method] = function (descriptor) {
        const made = create.call(this, descriptor);
        list.push({ made: new WeakRef(made), bytes: bytesOf(made) });
        return made;
      };
    };
    const destroyed = new WeakSet();
    for (const kind of [GPUTexture, GPUBuffer]) {
      const { destroy } = kind.prototype;
      kind.prototype.destroy = function () {
        destroyed.add(this);
        return destroy.call(this);
      };
    }
    watch("createTexture", held.textures, (it) => 4 * it.width * it.height * it.depthOrArrayLayers);
    watch("createBuffer", held.buffers, (it) => it.size);
    window.countHeld = () => {
      const totals = {};
      for (const [name, list] of Object.entries(held)) {
        const live = list.filter(({ made }) => made.deref() && !destroyed.has(made.deref()));
        list.splice(0, list.length, ...live);
        totals[name] = { count: live.length, bytes: live.reduce((sum, { bytes }) => sum + bytes, 0) };
      }
      return totals;
    };
  });
  await page.open();
  const start = JSON.parse(await page.scene());
  start.scene.quality.samples = 1;
  const protocol = await v.context.newCDPSession(v.tab);

  const anywhere = () => {
    const { width, height } = v.tab.viewportSize();
    return [unit() * width, unit() * height];
  };
  /** A point of a random widget, or anywhere. */
  const target = async () => {
    const rects = await v.tab.evaluate(() => window.mandelight.uiRects());
    // A dialogue of the browser would wait for a person.
    const names = Object.keys(rects).filter((name) => !/choose|save sequence/.test(name));
    if (!names.length || unit() < 0.3) return ["anywhere", anywhere()];
    const name = pick(names);
    const { x, y, width, height } = rects[name];
    return [name, [x + unit() * width, y + unit() * height]];
  };
  const setHidden = (isHidden) => v.tab.evaluate((value) => {
    Object.defineProperty(document, "hidden", { value, configurable: true });
    Object.defineProperty(document, "visibilityState", { value: value ? "hidden" : "visible", configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, isHidden);

  const setSize = async (size, deviceScaleFactor) => {
    await v.tab.setViewportSize(size);
    await protocol.send("Emulation.setDeviceMetricsOverride", { ...size, deviceScaleFactor, mobile: false });
  };
  const setDisplay = (display) => v.tab.evaluate((value) => {
    document.querySelector("canvas").style.display = value;
  }, display);

  const act = async () => {
    const what = below(21);
    if (what < 7) {
      const [name, at] = await target();
      done.push(`click ${name} at ${at}`);
      await mouse.click(...at, { clickCount: pick([1, 1, 1, 2]), button: pick(["left", "left", "left", "right"]) });
    } else if (what < 10) {
      const [name, from] = await target();
      const to = anywhere();
      done.push(`drag ${name} from ${from} to ${to}`);
      await mouse.move(...from);
      await mouse.down();
      await mouse.move(...to, { steps: 3 });
      await mouse.up();
    } else if (what < 12) {
      const [name, at] = await target();
      const notches = pick([-1200, -120, 120, 1200]);
      done.push(`wheel ${notches} at ${name}`);
      await mouse.move(...at);
      await mouse.wheel(0, notches);
    } else if (what < 16) {
      const key = pick(KEYS);
      done.push(`key ${key}`);
      await keyboard.press(key === " " ? "Space" : key);
    } else if (what === 16) {
      const text = pick(["9", "-1e9", "nan", "power", "light", ".5"]);
      done.push(`type ${text}`);
      await keyboard.type(text);
    } else if (what === 17) {
      const [size, ratio] = [pick(SIZES), pick(PIXEL_RATIOS)];
      done.push(`resize to ${size.width}×${size.height} at ${ratio} pixels each`);
      await setSize(size, ratio);
      v.seen.ratios.push(await v.tab.evaluate(() => window.devicePixelRatio));
    } else if (what === 18) {
      done.push("hide and show");
      await setHidden(true);
      await new Promise((resolve) => setTimeout(resolve, 100));
      await setHidden(false);
    } else if (what === 19) {
      done.push("take the canvas away and bring it back");
      await setDisplay("none");
      await new Promise((resolve) => setTimeout(resolve, 100));
      await setDisplay("");
    } else {
      done.push("save, then cancel");
      await keyboard.press("Control+s");
      const cancel = await page.rect("cancel export");
      if (cancel) await mouse.click(cancel.x + cancel.width / 2, cancel.y + cancel.height / 2);
    }
  };

  v.seen.ratios = [];
  v.seen.rounds = [];
  for (let round = 0; round < ROUNDS; round++) {
    for (let i = 0; i < ACTIONS; i++) await act();
    // All is closed, and the first scene is back.
    await setSize(SIZE, 1);
    for (let i = 0; i < 8; i++) await keyboard.press("Escape");
    await v.until("the export to end", async () => {
      const cancel = await page.rect("cancel export");
      if (cancel) await mouse.click(cancel.x + cancel.width / 2, cancel.y + cancel.height / 2);
      return !(await page.report()).exporting;
    });
    await mouse.move(1, 1);
    await v.tab.evaluate((json) => window.mandelight.setScene(json), JSON.stringify(start));
    await v.until("the window's size", async () => {
      const { width, height } = await page.report();
      return width > 1 && width <= SIZE.width && height <= SIZE.height;
    });
    const report = await page.settled();
    await protocol.send("HeapProfiler.collectGarbage");
    const held = await v.tab.evaluate(() => window.countHeld());
    v.seen.rounds.push({ ...held, ...report, errors: await v.tab.evaluate(() => window.mandelight.errors()) });
  }
  await v.screenshot("walked-480x320");
});
