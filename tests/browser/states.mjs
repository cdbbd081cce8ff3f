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
 * how many small pictures it shows.
 */
const STATES = [
  { name: "timeline", key: "t", rect: "timeline", isToggle: true },
  { name: "share", key: "j", rect: "share window" },
  { name: "mutate", key: "m", rect: "variations", small: 8 },
  { name: "find", key: "Control+k", rect: "find window", words: "light" },
  { name: "help", key: "Shift+?", rect: "help window" },
  { name: "compare", key: "Shift+C", rect: "compare" },
  { name: "pins", key: "n", rect: "first place", small: 1 },
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
  await page.click("more");
  await shootSettled("panel");
  await page.click("All lights");
  await page.settled();
  await page.scrollTo("All lights");
  await shootSettled("lights");
  await page.click("All lights");
  await page.click("more");

  // The opening scene's formula has no text.
  const opening = await page.scene();
  await page.show(process.env.MANDELIGHT_FORMULA);
  const press = (name) => v.tab.getByRole("button", { name, exact: true }).evaluate((it) => it.click());
  await press("Edit the formula…");
  await page.rested("the editor", () => page.rect("formula text"));
  await shootSettled("formula");
  await press("Edit the formula…");
  await v.until("the editor to close", async () => !(await page.rect("formula text")), 60);
  await page.show(opening);

  await page.click("Mine");
  await page.click("keep view");
  await v.until("the view to be kept", () => v.tab.evaluate(() => localStorage.getItem("mandelight.favourites")));
  await page.scrollTo("Mine");
  await shootSettled("mine");
  await page.click("Scenes");

  // A pointer over a swatch; fingers hover nowhere.
  if (!hasTouch) {
    const swatch = v.tab.getByRole("button", { name: /^Look: / }).nth(2);
    const box = await swatch.boundingBox();
    await v.tab.mouse.move(box.x, box.y + box.height / 2);
    await v.tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.rested("the preview", () => page.rect("look preview"));
    await shootSettled("look");
    await v.tab.mouse.move(...(await page.middle("view")));
  }

  // A picture that is not finished is rendered again to save it.
  await sampled(256);
  await v.tab.keyboard.press("Control+s");
  await page.rested("the progress of saving", () => page.rect("cancel export"));
  await shoot("saving");
  await page.click("cancel export");
  await page.says("Saving was cancelled.");
  await page.rested("the notice", () => page.rect("notice"));
  await shoot("notice");
  await sampled(1);
  await drag(0.4);
  if (wasHidden) {
    await click("panel toggle");
    await v.until("the panel to be hidden", isHidden, 60);
  }

  for (const { name, key, rect, words, isToggle, small } of STATES) {
    await v.tab.keyboard.press(key);
    await page.rested(name, () => page.rect(rect));
    if (words) await v.tab.keyboard.type(words);
    if (small) await v.until(`${small} small pictures`, async () => (await page.report()).smallPictures >= small);
    await shootSettled(name);
    await v.tab.keyboard.press(isToggle ? key : "Escape");
    await v.until(`${name} to be gone`, async () => !(await page.rect(rect)), 60);
  }
}
