// Each main state of the interface in three windows, two of them a phone's: pictures to look at.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const DEVICES = [
  { sizes: [[1280, 720]], context: {} },
  // A phone is turned, as a hand does it: a page for each side would load and compile once more.
  { sizes: [[390, 844], [844, 390]], context: { hasTouch: true, isMobile: true, deviceScaleFactor: 1 } },
];

/** Pixels of the view for each of its samples: a software GPU takes most of a minute for a whole sample, in each state. */
const MOST_PIXELS = 8;
/** As MOST_PIXELS, for the opening picture, which is shown sharper. */
const MOST_PIXELS_AT_FIRST = 2;

/** Small pictures that a state waits for: a software GPU takes minutes for those of all variations. */
const SMALL_PICTURES = 2;

/**
 * The states of keys: a name, the key that opens it, what is there then, whether the key ends it, too, whether it
 * shows small pictures of its own, a box that is ticked first, and a second key that is pressed there.
 * (Variations keep the shape: software GPUs compile the kernels of others for long.)
 */
const STATES = [
  { name: "timeline", key: "t", rect: "timeline", isToggle: true, secondKey: "k" },
  { name: "share", key: "j", rect: "share window" },
  { name: "mutate", key: "m", rect: "variations", hasPictures: true, ticked: "Keep: Shape" },
  { name: "find", key: "Control+k", rect: "find window", words: "light" },
  { name: "help", key: "Shift+?", rect: "help window" },
  { name: "compare", key: "Shift+C", rect: "compare" },
  { name: "pins", key: "n", rect: "first place", hasPictures: true },
  { name: "fly", key: "f", rect: "fly keys" },
];

await visit({ context: windowOf(DEVICES[0]) }, async (v) => {
  v.seen.states = [];
  await photograph(v, DEVICES[0]);
  for (const device of DEVICES.slice(1)) {
    await v.openAnew(windowOf(device));
    await photograph(v, device);
  }
});

/** The context of a device's first window. */
function windowOf({ sizes: [[width, height]], context }) {
  return { viewport: { width, height }, ...context };
}

async function photograph(v, { sizes, context: { hasTouch } }) {
  const page = new Mandelight(v);
  let [width, height] = sizes[0];
  const shoot = async (state) => {
    const name = `${state}-${width}x${height}`;
    await v.screenshot(name);
    const rects = await v.tab.evaluate(() => window.mandelight.uiRects());
    v.seen.states.push({ name, state, size: [width, height], rects });
  };
  /** Keeps a picture of a state once the view has a sample for so many pixels. */
  const shootRefined = async (state, mostPixels = MOST_PIXELS) => {
    await v.timed(`${state} ${width}x${height}, refined`, () => page.refined(mostPixels));
    await shoot(state);
  };
  /** Whether the interface has the window's size: a panel at the side is beside the status line. */
  const isDrawn = async () => {
    const parts = (await Promise.all([page.rect("status"), page.rect("panel")])).filter(Boolean);
    const ends = [(it) => it.x + it.width, (it) => it.y + it.height].map((end) => Math.max(...parts.map(end)));
    return Math.abs(ends[0] - width) < 1 && Math.abs(ends[1] - height) < 1;
  };
  /** Runs steps in each of the device's windows. */
  const inEachWindow = async (steps) => {
    for (const size of sizes) {
      [width, height] = size;
      await v.tab.setViewportSize({ width, height });
      await v.until("the window's size", isDrawn);
      await v.timed(`${steps.name} ${width}x${height}`, steps);
    }
  };
  const click = async (name) => v.tab.mouse.click(...(await page.middle(name)));
  const button = (name) => v.tab.getByRole("button", { name, exact: true });
  const sampled = (samples) => v.tab.evaluate((count) => {
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = count;
    window.mandelight.setScene(JSON.stringify(document));
  }, samples);
  const begin = async () => {
    await page.firstPicture();
    await sampled(1);
    // The page knows of fingers by the first touch.
    if (hasTouch) await v.tab.touchscreen.tap(...(await page.middle("status")));
  };

  // A sheet is shown at half its height; the panel of a low window is hidden until it is asked for.
  const isHidden = async () => !(await page.rect("panel"));
  const openPanel = async () => {
    if (await page.rect("sheet handle")) await page.drag("sheet handle", [0, -0.4 * height]);
    else if (await isHidden()) await click("panel toggle");
    await page.rested("the panel", () => page.rect("panel"));
  };
  const closePanel = async () => {
    if (await page.rect("sheet handle")) return page.drag("sheet handle", [0, 0.4 * height]);
    if (!hasTouch) return;
    await click("panel toggle");
    await v.until("the panel to be hidden", isHidden);
  };

  const lights = async () => {
    await page.click("All lights");
    await page.scrollTo("All lights");
    await shootRefined("lights");
    await page.click("All lights");
  };
  const mine = async () => {
    const kept = () => v.tab.evaluate(() => localStorage.getItem("mandelight.favourites"));
    const before = await kept();
    // A list's heading scrolls to itself when it is pressed.
    const scrollToTop = async () => {
      await button("Mine").evaluate((it) => it.click());
      await page.rested("the list", () => page.rect("keep view"));
    };
    await scrollToTop();
    await page.click("keep view");
    await v.until("the view to be kept", async () => (await kept()) !== before);
    await scrollToTop();
    await shootRefined("mine");
    await button("Scenes").evaluate((it) => it.click());
  };
  const look = async () => {
    const swatch = v.tab.getByRole("button", { name: /^Look: / }).nth(2);
    const place = async () => {
      const box = await swatch.boundingBox();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    const [x, y] = await page.scrollUntilSeen(() => page.rested("the swatch", place));
    if (hasTouch) {
      // Fingers hover nowhere: a tap shows the look, and keeps it.
      await page.changed("a tap on a swatch", () => v.tab.touchscreen.tap(x, y));
      await shootRefined("look");
      await page.changed("undoing the look", () => v.tab.keyboard.press("Control+z"));
      return;
    }
    const { pictures } = await page.report();
    await v.tab.mouse.move(x, y - 9);
    await v.tab.mouse.move(x, y);
    await page.rested("the preview", () => page.rect("look preview"));
    await v.until("the look's picture", async () => (await page.report()).pictures > pictures);
    await shootRefined("look");
    await v.tab.mouse.move(...(await page.middle("view")));
  };
  const saving = async () => {
    // A picture that is not finished is rendered again to save it.
    await sampled(256);
    await v.tab.keyboard.press("Control+s");
    await page.rested("the progress of saving", () => page.rect("cancel export"));
    await shoot("saving");
    await (hasTouch ? closePanel() : v.tab.keyboard.press("p"));
    await page.rested("the progress without the panel", () => page.rect("saving"));
    await shoot("saving-without-panel");
    await click("cancel export");
    await page.says("Saving was cancelled.");
    // It goes after six seconds: slow frames may not show it at rest for long enough before.
    await v.until("the notice", () => page.rect("notice"));
    await shoot("notice");
    await v.until("the notice to go", async () => !(await page.rect("notice")));
    await openPanel();
    await sampled(1);
  };
  const opening = () => shootRefined("opening", MOST_PIXELS_AT_FIRST);
  const ofThePanel = async () => {
    await openPanel();
    await page.click("more");
    await shootRefined("panel");
    await lights();
    await page.click("more");
    await mine();
    await look();
    await saving();
    await closePanel();
  };

  const tick = async (name) => {
    const box = v.tab.getByRole("checkbox", { name, exact: true });
    if (await box.isChecked()) return;
    await box.evaluate((it) => it.click());
    await v.until(`${name} to be ticked`, () => box.isChecked());
  };

  const ofKeys = async () => {
    for (const { name, key, rect, words, isToggle, hasPictures, ticked, secondKey } of STATES) {
      await v.tab.keyboard.press(key);
      await page.rested(name, () => page.rect(rect));
      if (ticked) await tick(ticked);
      if (secondKey) await page.changed(secondKey, () => v.tab.keyboard.press(secondKey));
      if (words) await v.tab.keyboard.type(words);
      if (hasPictures) await page.smallPictures(SMALL_PICTURES);
      await shootRefined(name);
      await v.tab.keyboard.press(isToggle ? key : "Escape");
      await v.until(`${name} to be gone`, async () => !(await page.rect(rect)));
    }
  };

  const ofTheFormula = async () => {
    await openPanel();
    await page.click("more");
    await page.click("Fractal");
    await button("Edit the formula…").evaluate((it) => it.click());
    await page.rested("the editor", () => page.rect("formula text"));
    await shootRefined("formula");
    await v.tab.keyboard.press("Escape");
    await v.until("the editor to be gone", async () => !(await page.rect("formula text")));
    await page.click("Fractal");
    await page.click("more");
    await closePanel();
  };

  // What the document shows over the interface.
  const ofTheDocument = async () => {
    await v.tab.evaluate(() => (document.getElementById("update").hidden = false));
    await shoot("update");
    await v.tab.evaluate(() => {
      document.getElementById("update").hidden = true;
      window.mandelightStop("a panic of the test");
    });
    await shoot("stopped");
    await v.tab.evaluate(() => (document.getElementById("notice").hidden = true));
  };

  const ofTheGallery = async () => {
    await openPanel();
    await page.rested("a card", () => page.rect("gallery 0"));
    await shootRefined("gallery");
    await closePanel();
  };

  await v.tab.goto(`${v.address}?test`);
  await begin();
  await inEachWindow(opening);
  await inEachWindow(ofThePanel);
  await inEachWindow(ofKeys);
  // The opening scene's formula has no text.
  await page.changed("the scene of a formula", () =>
    v.tab.evaluate((json) => window.mandelight.setScene(json), process.env.MANDELIGHT_FORMULA));
  await inEachWindow(ofTheFormula);
  await inEachWindow(ofTheDocument);

  // One of its pictures is missing.
  v.provoked = /404/;
  await v.tab.goto("about:blank");
  await v.tab.goto(`${v.address}?test&gallery=${encodeURIComponent("../../pictures/")}`);
  await begin();
  await inEachWindow(ofTheGallery);
  v.provoked = null;
}
