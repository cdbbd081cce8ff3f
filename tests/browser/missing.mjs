// Visits on which a part of the page is missing or damaged: the page says so, and "Try again" opens it once it is there.

import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const MODULE = /\/mandelight_bg-\w+\.wasm$/;
const GLUE = /\/mandelight-\w+\.js$/;
const BOOT = /\/boot-\w+\.js$/;

/** The module with a damaged first section: compiling fails long before the last byte arrives. */
const damaged = async (route) => {
  const dist = process.env.MANDELIGHT_DIST;
  const body = await readFile(join(dist, (await readdir(dist)).find((name) => name.endsWith(".wasm"))));
  body[8] = 0xff;
  await route.fulfill({ contentType: "application/wasm", body });
};

const FAULTS = {
  unreachable: [MODULE, (route) => route.abort()],
  gone: [MODULE, (route) => route.fulfill({ status: 404, body: "no such file\n" })],
  script: [GLUE, (route) => route.abort()],
  document_for_script: [GLUE, (route) => route.fulfill({ contentType: "text/html", body: "<!doctype html>" })],
  damaged: [MODULE, damaged],
};

await visit({ context: { viewport: { width: 480, height: 320 } } }, async (v) => {
  const page = new Mandelight(v);
  [v.seen.notices, v.seen.later, v.seen.texts] = [{}, {}, {}];
  // Each of these is an error of the browser's console.
  v.provoked = /./;
  const open = async () => {
    await v.tab.goto("about:blank");
    await v.tab.goto(`${v.address}?test`);
  };
  await v.context.route(BOOT, (route) => route.abort());
  await open();
  v.seen.alone = await v.until("the document's own words", () => v.tab.evaluate(() => {
    const late = document.getElementById("notice-late");
    return getComputedStyle(late).visibility === "visible" && late.textContent;
  }));
  await v.screenshot("alone-480x320");
  await v.context.unroute(BOOT);
  for (const [name, [file, fault]] of Object.entries(FAULTS)) {
    await v.context.route(file, fault);
    await open();
    v.seen.notices[name] = await v.finalNotice();
    // The rest of a download must not cover it.
    await new Promise((resolve) => setTimeout(resolve, 1000));
    v.seen.later[name] = await v.notice();
    v.seen.texts[name] = await v.texts("#notice");
    await v.screenshot(`${name}-480x320`);
    await v.context.unroute(file);
  }
  v.provoked = null;
  await v.tab.click("#notice-again");
  await page.firstPicture();
});
