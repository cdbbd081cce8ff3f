// Each main state of the interface in three windows, two of them a phone's: pictures to look at.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const PHONE = { hasTouch: true, isMobile: true, deviceScaleFactor: 1 };
const WINDOWS = [
  { viewport: { width: 1280, height: 720 } },
  { viewport: { width: 390, height: 844 }, ...PHONE },
  { viewport: { width: 844, height: 390 }, ...PHONE },
];

/**
 * The states of keys: a name, the key that opens it, what is there then, whether the key ends it, too, and
 * whether it shows small pictures of its own.
 */
const STATES = [
  { name: "timeline", key: "t", rect: "timeline", isToggle: true },
  { name: "share", key: "j", rect: "share window" },
  { name: "mutate", key: "m", rect: "variations", hasPictures: true },
  { name: "find", key: "Control+k", rect: "find window", words: "light" },
  { name: "help", key: "Shift+?", rect: "help window" },
  { name: "compare", key: "Shift+C", rect: "compare" },
  { name: "pins", key: "n", rect: "first place", hasPictures: true },
  { name: "fly", key: "f", rect: "fly keys" },
];

await visit({ context: WINDOWS[0] }, async (v) => {
  v.seen.states = [];
  await photograph(v, WINDOWS[0]);
  for (const window of WINDOWS.slice(1)) {
    await v.openAnew(window);
    await photograph(v, window);
  }
});

async function photograph(v, { viewport: { width, height }, hasTouch }) {
  const page = new Mandelight(v);
  await page.open();
  const shoot = async (state) => {
    const name = `${state}-${width}x${height}`;
    await v.screenshot(name);
    const rects = await v.tab.evaluate(() => window.mandelight.uiRects());
    v.seen.states.push({ name, state, size: [width, height], rects });
  };
  const shootSettled = async (state) => {
    await page.settled();
    await shoot(state);
  };
  const click = async (name) => v.tab.mouse.click(...(await page.middle(name)));
  const sampled = (samples) => v.tab.evaluate((count) => {
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = count;
    window.mandelight.setScene(JSON.stringify(document));
  }, samples);
  // The states of the panel at the side. A phone's sheet shows its upper end alone: this script scrolls by a wheel.
  const lights = async () => {
    await page.click("All lights");
    await page.settled();
    await page.scrollTo("All lights");
    await shootSettled("lights");
    await page.click("All lights");
  };
  const ofThePanel = async () => {
    // The lists are at the upper end of the panel.
    const scroll = async (distance) => {
      const panel = await page.rect("panel");
      await v.tab.mouse.move(panel.x + panel.width / 2, panel.y + panel.height / 2);
      await v.tab.mouse.wheel(0, distance);
    };
    await scroll(-20000);
    await click("Mine");
    await click("keep view");
    await v.until("the view to be kept", () => v.tab.evaluate(() => localStorage.getItem("mandelight.favourites")));
    await shootSettled("mine");
    await click("Scenes");

    // A pointer over a swatch.
    const place = async () => {
      const box = await v.tab.getByRole("button", { name: /^Look: / }).nth(2).boundingBox();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    await scroll((await place())[1] - height / 2);
    const [x, y] = await page.rested("the swatch", place);
    await v.tab.mouse.move(x, y - 9);
    await v.tab.mouse.move(x, y);
    await page.rested("the preview", () => page.rect("look preview"));
    await shootSettled("look");
    await v.tab.mouse.move(...(await page.middle("view")));

    // A picture that is not finished is rendered again to save it.
    await sampled(256);
    await v.tab.keyboard.press("Control+s");
    await page.rested("the progress of saving", () => page.rect("cancel export"));
    await shoot("saving");
    await click("cancel export");
    await page.says("Saving was cancelled.");
    await page.rested("the notice", () => page.rect("notice"));
    await shoot("notice");
    await sampled(1);
  };
  const formula = async () => {
    // The opening scene's formula has no text.
    await page.show(process.env.MANDELIGHT_FORMULA);
    await page.click("more");
    await page.click("Fractal");
    await v.tab.getByRole("button", { name: "Edit the formula…", exact: true }).evaluate((it) => it.click());
    await page.rested("the editor", () => page.rect("formula text"));
    await shootSettled("formula");
  };

  await sampled(1);
  // The page knows of fingers by the first touch.
  if (hasTouch) await v.tab.touchscreen.tap(...(await page.middle("status")));

  // A sheet is shown at half its height; the panel of a low window is hidden until it is asked for.
  const isHidden = async () => !(await page.rect("panel"));
  const drag = async (part) => {
    if (await page.rect("sheet handle")) await page.drag("sheet handle", [0, part * height]);
  };
  await shootSettled("opening");
  await drag(-0.4);
  const wasHidden = await isHidden();
  if (wasHidden) await click("panel toggle");
  await page.rested("the panel", () => page.rect("panel"));
  if (!hasTouch) await page.click("more");
  await shootSettled("panel");
  if (!hasTouch) {
    await lights();
    await page.click("more");
    await ofThePanel();
  }
  await drag(0.4);
  if (wasHidden) {
    await click("panel toggle");
    await v.until("the panel to be hidden", isHidden, 60);
  }

  for (const { name, key, rect, words, isToggle, hasPictures } of STATES) {
    await v.tab.keyboard.press(key);
    await page.rested(name, () => page.rect(rect));
    if (words) await v.tab.keyboard.type(words);
    if (hasPictures) await page.smallPictures();
    await shootSettled(name);
    await v.tab.keyboard.press(isToggle ? key : "Escape");
    await v.until(`${name} to be gone`, async () => !(await page.rect(rect)), 60);
  }

  if (!hasTouch) await formula();

  // What the document shows over the interface.
  await v.tab.evaluate(() => (document.getElementById("update").hidden = false));
  await shoot("update");
  await v.tab.evaluate(() => {
    document.getElementById("update").hidden = true;
    window.mandelightStop("a panic of the test");
  });
  await shoot("stopped");

  // One of its pictures is missing.
  v.provoked = /404/;
  await v.tab.goto("about:blank");
  await v.tab.goto(`${v.address}?test&gallery=${encodeURIComponent("../../pictures/")}`);
  await page.firstPicture();
  await sampled(1);
  await drag(-0.4);
  if (await isHidden()) await click("panel toggle");
  await page.rested("a card", () => page.rect("gallery 0"));
  await shootSettled("gallery");
  v.provoked = null;
}
