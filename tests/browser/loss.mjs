// A visit during which the GPU goes away, as after a driver's reset.

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
  // The old picture went with the device; pixels can be read again once there is a new one.
  const isGone = () => v.tab.evaluate(() => window.mandelight.pixels().then(() => false, () => true));
  await v.until("the picture to be gone", isGone, 60);
  await v.until("a picture on the new device", async () => !(await isGone()), 120);
  await v.until("the new device's own count", async () => (await page.report()).pictures !== pictures);
  v.seen.report = await page.settled();
  v.seen.after = await page.scene();
  v.seen.notice = await v.notice();
  await page.keepPixels("after");
  await v.screenshot("after-a-loss-480x480");
});
