// A visit that loses the GPU, as after a driver's reset.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

await visit({ context: { viewport: { width: 480, height: 480 } } }, async (v) => {
  const page = new Mandelight(v);
  await page.open();
  const quick = JSON.parse(await page.scene());
  quick.scene.quality.samples = 1;
  await page.show(JSON.stringify(quick));
  v.seen.before = await page.scene();
  await page.keepPixels("before");

  const { pictures } = await page.report();
  await v.tab.evaluate(() => window.mandelight.loseDevice());
  // The loss drops the picture: pixels() fails until the new device has drawn one.
  const hasNoPicture = () => v.tab.evaluate(() => window.mandelight.pixels().then(() => false, () => true));
  await v.until("the picture to be dropped", hasNoPicture, 60);
  await v.until("a picture on the new device", async () => !(await hasNoPicture()), 120);
  await v.until("the new device's picture count", async () => (await page.report()).pictures !== pictures);
  v.seen.report = await page.settled();
  v.seen.after = await page.scene();
  v.seen.notice = await v.notice();
  await page.keepPixels("after");
  await v.screenshot("after-a-loss-480x480");
});
