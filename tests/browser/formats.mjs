// Pictures saved in each format of the menu: of a size that the view does not have, then of the finished view.

import { Mandelight } from "./mandelight.mjs";
import { COARSE, visit } from "./visit.mjs";

await visit({ context: { ...COARSE, viewport: { width: 720, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  await v.tab.goto(`${v.address}licenses.txt`);
  const settings = { more_open: true, sections: { export: true }, export: { times: 0, typed_px: [64, 40] } };
  await v.tab.evaluate((text) => localStorage.setItem("mandelight.settings", text), JSON.stringify(settings));
  await page.open();
  const quick = JSON.parse(await page.scene());
  quick.scene.quality.samples = 2;
  await page.show(JSON.stringify(quick));
  v.seen.scenes = { saved: await page.scene() };
  await page.scrollTo("picture format");
  await v.screenshot("menu-720x420");
  const choose = async (name) => {
    const button = v.tab.getByRole("button", { name, exact: true });
    await button.evaluate((it) => it.click());
    await v.until(name, async () => (await button.getAttribute("aria-pressed")) === "true");
  };
  v.seen.names = {};
  const save = async (file) => (v.seen.names[file] = await page.keepDownload(file, "save picture"));
  const kinds = { WebP: "webp", JPEG: "jpg", EXR: "exr" };
  await save("small.png");
  await choose("Bits per channel: 16");
  await save("deep.png");
  await choose("Bits per channel: 8");
  await choose("Background: Transparent");
  await save("cut_out.png");
  await choose("Background: As shown");
  for (const [kind, extension] of Object.entries(kinds)) {
    await choose(`File: ${kind}`);
    await save(`small.${extension}`);
  }
  await choose("Picture size: View");
  const { dispatches } = await page.settled();
  for (const kind of ["WebP", "JPEG"]) {
    await choose(`File: ${kind}`);
    await save(`view.${kinds[kind]}`);
  }
  v.seen.view_dispatches = (await page.report()).dispatches - dispatches;
});
