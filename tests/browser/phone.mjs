// A visit from a phone: a narrow window, touches instead of a mouse.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 };

await visit({ context: phone }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});
  await v.timed("first_picture", () => page.open());
  await v.timed("first_sample", () => page.sampled(1));
  await v.screenshot("opening-390x844");

  // One sample a pixel shows where the camera is.
  const quick = JSON.parse(await page.scene());
  quick.scene.quality.samples = 1;
  await page.show(JSON.stringify(quick));
  scenes.opened = await page.scene();

  // playwright's API has no moving touches, so the DevTools protocol sends them.
  const protocol = await v.context.newCDPSession(v.tab);
  const touch = (type, ...points) =>
    protocol.send("Input.dispatchTouchEvent", {
      type,
      touchPoints: points.map(([x, y], id) => ({ x, y, id })),
    });
  const STEPS = 8;
  const along = (from, to, i) => from.map((start, axis) => start + ((to[axis] - start) * i) / STEPS);
  const fingers = async (...paths) => {
    await touch("touchStart", ...paths.map(([from]) => from));
    for (let i = 1; i <= STEPS; i++) {
      await touch("touchMove", ...paths.map(([from, to]) => along(from, to, i)));
    }
    await touch("touchEnd");
  };

  const [x, y] = await page.middle("view");
  scenes.turned = await page.changed("a one-finger drag", () => fingers([[x - 40, y], [x + 60, y + 30]]));
  await page.settled();
  scenes.pinched = await page.changed("a pinch", () =>
    fingers([[x - 30, y], [x - 90, y]], [[x + 30, y], [x + 90, y]]),
  );
  await page.settled();

  // Two taps do what a double click does.
  const beside = [x + 40, y - 30];
  await page.show(scenes.opened);
  scenes.tapped = await page.changed("a double tap", () =>
    // Sent at once: a slow machine's answers would make two taps of it.
    Promise.all([touch("touchStart", beside), touch("touchEnd"), touch("touchStart", beside), touch("touchEnd")]));
  await page.show(scenes.opened);
  scenes.clicked = await page.changed("a double click", () => v.tab.mouse.dblclick(...beside));
  await page.show(scenes.opened);
  v.seen.scrolled = await v.tab.evaluate(() => [window.scrollX, window.scrollY, visualViewport.scale]);
  await v.screenshot("pinched-390x844");
});
