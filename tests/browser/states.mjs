// Each main state of the interface at three window sizes: pictures to look at.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const SIZES = [[1280, 720], [390, 844], [844, 390]];

/** The states: a name, the key that opens it, what is there then, and whether the key ends it, too. */
const STATES = [
  { name: "timeline", key: "t", rect: "timeline", isToggle: true },
  { name: "share", key: "j", rect: "share window" },
  { name: "mutate", key: "m", rect: "variations" },
  { name: "find", key: "Control+k", rect: "find window", words: "light" },
  { name: "help", key: "Shift+?", rect: "help window" },
  { name: "compare", key: "Shift+C", rect: "compare" },
];

await visit({ context: { viewport: { width: 1280, height: 720 } } }, async (v) => {
  const page = new Mandelight(v);
  await page.open();
  await v.tab.evaluate(() => {
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = 1;
    window.mandelight.setScene(JSON.stringify(document));
  });
  v.seen.states = [];
  for (const [width, height] of SIZES) {
    const shoot = async (state) => {
      const name = `${state}-${width}x${height}`;
      await page.settled();
      await v.screenshot(name);
      const rects = await v.tab.evaluate(() => window.mandelight.uiRects());
      v.seen.states.push({ name, state, size: [width, height], rects });
    };
    const more = async () => v.tab.mouse.click(...(await page.scrollTo("more")));
    const toggle = async () => v.tab.mouse.click(...(await page.middle("panel toggle")));
    // A sheet is shown at half its height; the panel of a low window is hidden until it is asked for.
    const isHidden = async () => !(await page.rect("panel"));
    let wasHidden = false;
    const openMore = async () => {
      if (await page.rect("sheet handle")) await page.drag("sheet handle", [0, -0.4 * height]);
      wasHidden = await isHidden();
      if (wasHidden) await toggle();
      await page.rested("the panel", () => page.rect("panel"));
      await more();
    };
    const closeMore = async () => {
      await more();
      if (await page.rect("sheet handle")) await page.drag("sheet handle", [0, 0.4 * height]);
      if (wasHidden) {
        await toggle();
        await v.until("the panel to be hidden", isHidden, 60);
      }
    };
    await v.tab.setViewportSize({ width, height });
    const fits = async () => {
      const rects = [await page.rect("status"), await page.rect("panel")].filter(Boolean);
      const [right, bottom] = [
        Math.max(...rects.map((it) => it.x + it.width)),
        Math.max(...rects.map((it) => it.y + it.height)),
      ];
      return Math.abs(right - width) < 2 && Math.abs(bottom - height) < 2;
    };
    await v.until("the new size", fits, 60);
    await v.until("a picture of the new size", async () => {
      const [view, report] = [await page.rect("view"), await page.report()];
      return Math.abs(view.width - report.width) < 2 && Math.abs(view.height - report.height) < 2;
    });
    await shoot("opening");
    await openMore();
    await shoot("panel");
    await closeMore();
    for (const { name, key, rect, words, isToggle } of STATES) {
      await v.tab.keyboard.press(key);
      await page.rested(name, () => page.rect(rect));
      if (words) await v.tab.keyboard.type(words);
      await shoot(name);
      await v.tab.keyboard.press(isToggle ? key : "Escape");
      await v.until(`${name} to be gone`, async () => !(await page.rect(rect)), 60);
    }
  }
});
