// A gallery beside the page: shown at the start, opened by a card, and told of where it fails. Then one on
// another host, which lets this page read it or doesn't.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

await visit({ context: { viewport: { width: 720, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  v.provoked = /404/;
  const open = async (gallery) => {
    await v.tab.goto("about:blank");
    await v.tab.goto(`${v.address}?test&gallery=${encodeURIComponent(gallery)}`);
    await page.firstPicture();
  };

  const warnings = [];
  v.tab.on("console", (message) => message.type() === "warning" && warnings.push(message.text()));
  await open("../../pictures/");
  const card = (index) => page.rested(`card ${index}`, () => page.rect(`gallery ${index}`));
  v.seen.cards = [await card(0), await card(1)];
  const bounds = { x: 0, y: 0, width: 1, height: 1 };
  await v.until("the pictures of the cards", async () => {
    const colors = await Promise.all(v.seen.cards.map(({ x, y, width, height }) =>
      v.tab.screenshot({ clip: { ...bounds, x: x + width / 2, y: y + height / 3 } })));
    return !colors[0].equals(colors[1]);
  });
  await v.screenshot("gallery-720x420");

  v.seen.scenes = {};
  v.seen.scenes.opened = await page.changed("a card", async () => v.tab.mouse.click(...(await page.middle("gallery 0"))));
  await v.tab.mouse.click(...(await page.middle("gallery 2")));
  v.seen.missing = await page.says("missing could not be opened: its host answers 404");

  v.seen.huge = await v.until("the refusal of a picture", async () =>
    warnings.find((text) => text.includes("huge.png")));

  await open("../../pictures/broken.json");
  v.seen.broken = await page.says("the list cannot be read");
  await open("../../pictures/none/");
  v.seen.nowhere = await page.says("its host answers 404");

  // The browser's network answers for this host, so that its address can be a secure one.
  const other = "https://pictures.example";
  v.otherHosts.add(other);
  v.provoked = /404|CORS|net::ERR_FAILED/;
  let headers = { "Access-Control-Allow-Origin": "*" };
  const asked = (v.seen.other_host = []);
  await v.context.route(`${other}/**`, async (route) => {
    const { pathname } = new URL(route.request().url());
    const sent = await route.request().allHeaders();
    asked.push({ pathname, cookie: sent.cookie ?? null, referer: sent.referer ?? null });
    const body = await readFile(join(process.env.MANDELIGHT_PICTURES, decodeURIComponent(pathname))).catch(() => null);
    await route.fulfill(body ? { status: 200, headers, body } : { status: 404, headers });
  });
  await open(`${other}/`);
  await card(1);
  v.seen.scenes.opened_elsewhere = await page.changed("a card of another host", async () =>
    v.tab.mouse.click(...(await page.middle("gallery 1"))));
  headers = { "Access-Control-Allow-Origin": "https://elsewhere.example" };
  await open(`${other}/`);
  v.seen.refused = await page.says("its host can't be reached, or lets no other page read it (CORS)");
});
