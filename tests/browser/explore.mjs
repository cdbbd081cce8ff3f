// A visit with mouse and keyboard: look, turn, zoom, change the power, light it, save it, come back.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

/** A small window that still has the panel at its side: a software GPU has to draw all this. */
const SMALL = { width: 720, height: 420 };

const rest = (secs) => new Promise((resolve) => setTimeout(resolve, 1000 * secs));

await visit({ context: { viewport: { width: 1280, height: 720 } } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});

  // What a visitor sees first, once edges have become smooth.
  await v.timed("first_picture", () => page.open());
  await v.timed("first_sample", () => page.sampled(1));
  await v.timed("four_samples", () => page.sampled(4));
  scenes.opened = await page.scene();
  await v.screenshot("opening-1280x720");

  // From here on a small picture of few samples, each time to the last of them.
  await v.tab.setViewportSize(SMALL);
  const quick = JSON.parse(scenes.opened);
  quick.scene.quality.samples = 2;
  v.seen.quick = await v.timed("whole_picture", () => page.show(JSON.stringify(quick)));
  scenes.quick = await page.scene();

  // Idle means idle: no dispatch and no frame while nobody does anything. (Half a second after a
  // change the page writes its scene down, and a frame or two come of that; and what it may need
  // later is compiled at rest.)
  await rest(2);
  v.seen.idle = [await page.settled()];
  await rest(3);
  v.seen.idle.push(await page.report());

  const [x, y] = await page.middle("view");
  const aside = [x - 80, y + 30];
  scenes.turned = await page.changed("a drag", () => page.drag(aside, [90, -40]));
  v.seen.turned = await page.settled();
  scenes.approached = await page.changed("the wheel", async () => {
    await v.tab.mouse.move(...aside);
    await v.tab.mouse.wheel(0, -240);
  });
  await page.settled();

  scenes.powered = await page.changed("the power's slider", () => page.drag("power", [-30, 0]));
  await page.settled();
  await v.screenshot("another-power-720x420");

  await page.click("more");
  await page.click("lights section");
  scenes.lit = await page.changed("a new light", () => page.click("add point light"));
  await page.settled();
  await v.screenshot("added-light-720x420");
  const light = await page.newestLight();
  scenes.relit = await page.changed("dragging the light", () => page.drag(light, [60, 40]));
  v.seen.finished = await page.settled();
  await v.screenshot("dragged-light-720x420");

  v.seen.download = await page.keepDownload("download.png", "save picture");

  // Back again: from the address, from the browser's storage alone, and from a link.
  scenes.before_reload = await page.scene();
  await rest(2);
  v.seen.fragment = new URL(v.tab.url()).hash.slice(1);
  await v.tab.reload();
  await page.firstPicture();
  scenes.reloaded = await page.scene();
  await page.open();
  scenes.revisited = await page.scene();
  await page.open(process.env.MANDELIGHT_LINK);
  scenes.linked = await page.scene();
});
