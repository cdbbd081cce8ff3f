// A visit that dives by the wheel, from the whole bulb to beyond single precision, flies home, and
// opens a link to a deeper place.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

/** The zoom at which the dive ends: the eye is 1e-12 scene units from the surface. */
const DEEP_ZOOM = 4e12;
/** Wheel notches after which the dive is stuck. */
const MAX_NOTCHES = 300;

await visit({ context: { viewport: { width: 560, height: 300 }, deviceScaleFactor: 1 } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});
  await page.open();
  // One sample a pixel shows that there is a picture.
  const quick = JSON.parse(await page.scene());
  quick.scene.quality.samples = 1;
  await page.show(JSON.stringify(quick));
  const view = await page.rect("view");
  await v.tab.mouse.move(view.x + view.width / 2, view.y + view.height / 2);

  v.seen.anchor_ms = [];
  v.seen.notches = 0;
  await v.timed("dive", async () => {
    while ((await page.report()).zoom < DEEP_ZOOM && v.seen.notches < MAX_NOTCHES) {
      await v.tab.mouse.wheel(0, -100);
      v.seen.notches++;
      await sleep(60);
      v.seen.anchor_ms.push((await page.report()).anchorMs);
    }
  });
  v.seen.zoom = (await page.report()).zoom;
  scenes.deep = await page.scene();
  await v.timed("settle", () => page.settled());
  await page.keepPixels("deep");
  await v.screenshot("deep-560x300");

  await v.tab.mouse.click(view.x + view.width / 2, view.y + view.height / 2);
  await v.tab.keyboard.press("h");
  await v.until("the flight home", async () => (await page.report()).zoom < 1.5);
  scenes.home = await page.rested("the scene at home", () => page.scene());

  await page.open(process.env.MANDELIGHT_LINK);
  await page.sampled(1);
  scenes.linked = await page.scene();
  v.seen.linked_zoom = (await page.report()).zoom;
  await page.keepPixels("linked");
  await v.screenshot("linked-560x300");
});

function sleep(ms) {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
