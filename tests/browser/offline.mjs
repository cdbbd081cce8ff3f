// A visit without a connection after one with, and a new version that is offered.

import { readdir } from "node:fs/promises";
import { Mandelight } from "./mandelight.mjs";
import { COARSE, visit } from "./visit.mjs";

/** What the build puts into the names of files that browsers keep. */
const HASH = /-[0-9a-f]{12}\./;

await visit({ context: { ...COARSE, viewport: { width: 480, height: 320 } } }, async (v) => {
  const page = new Mandelight(v);
  await v.tab.goto(`${v.address}?test&offline`);
  await page.firstPicture();
  const cached = () => v.tab.evaluate(async () => {
    const names = (await caches.keys()).filter((name) => name.startsWith("mandelight-"));
    const counts = names.map(async (name) => (await (await caches.open(name)).keys()).length);
    return { names, files: (await Promise.all(counts))[0] ?? 0 };
  });
  v.seen.kept = await v.until("the page to be kept", async () => {
    const seen = await cached();
    const isControlled = await v.tab.evaluate(() => navigator.serviceWorker.controller !== null);
    return isControlled && seen.files > 5 && seen;
  });

  // The browser keeps the module's compiled code only if the module does not come from the worker.
  const module = v.tab.waitForResponse(/\.wasm$/);
  await v.tab.reload();
  v.seen.module_by_worker = (await module).fromServiceWorker();
  await page.firstPicture();
  const devtools = await v.context.newCDPSession(v.tab);
  const { installabilityErrors } = await devtools.send("Page.getInstallabilityErrors");
  // The test's own profile is a private window.
  v.seen.uninstallable = installabilityErrors.filter(({ errorId }) => errorId !== "in-incognito");

  // Without the host and without the browser's own cache, the page opens and draws.
  await devtools.send("Network.clearBrowserCache");
  v.server.isDown = true;
  await v.tab.reload();
  await page.firstPicture();
  await page.sampled(1);
  v.seen.offline = { pictures: (await page.report()).pictures, scene: await page.scene() };
  await v.screenshot("offline-480x320");

  // The licences are a page of their own; any other address shows the program.
  const other = await v.tab.context().newPage();
  await other.goto(new URL("licenses.txt", v.address).href);
  v.seen.licenses = await other.evaluate(() => document.body.innerText.slice(0, 100));
  await other.goto(`${v.address}?gallery=elsewhere`);
  v.seen.other = await other.evaluate(() => document.title);
  await other.close();
  v.server.isDown = false;

  // Another version, under other names; the host has the old files no more. It waits until the visitor takes it.
  v.provoked = /404/;
  const names = (await readdir(process.env.MANDELIGHT_DIST)).filter((name) => HASH.test(name));
  const next = (name) => name.replace(HASH, "-next.");
  const renamed = (text) => names.reduce((all, name) => all.replaceAll(name, next(name)), text);
  for (const name of names) {
    v.server.moved[name] = null;
    v.server.moved[next(name)] = name;
    if (/\.(js|css|webmanifest)$/.test(name)) v.server.edits[next(name)] = renamed;
  }
  v.server.edits["index.html"] = renamed;
  const declared = /^const VERSION = ".*";$/m;
  const publish = (version) => {
    v.server.edits["service-worker.js"] = (text) => renamed(text).replace(declared, `const VERSION = "${version}";`);
  };
  publish("another");
  await v.tab.reload();
  await page.firstPicture();
  const script = () => v.tab.evaluate(() => document.querySelector("script").src);
  const offered = () => v.tab.evaluate(() => !document.getElementById("update").hidden);
  v.seen.offered = await v.until("the offer of a new version", offered);
  await v.screenshot("update-480x320");
  v.seen.texts = await v.texts("#update");
  // By keys alone: one leads from the interface to the offer, and the answer leads back.
  const focused = () => v.tab.evaluate(() => document.activeElement?.id);
  await v.tab.keyboard.press("Tab");
  await v.tab.keyboard.press("F6");
  v.seen.by_keys = [await focused()];
  await v.tab.keyboard.press("F6");
  v.seen.by_keys.push(await focused());
  await v.tab.keyboard.press("F6");
  await v.tab.keyboard.press("Tab");
  v.seen.by_keys.push(await focused());
  await v.tab.keyboard.press("Enter");
  v.seen.by_keys.push(await focused());
  v.seen.put_off = !(await offered()) && !(await script()).includes("-next.");

  // A version after that takes its place.
  publish("third");
  await v.tab.reload();
  await page.firstPicture();
  await v.until("the third version", () => v.tab.evaluate(async () => {
    const { waiting, installing } = await navigator.serviceWorker.getRegistration();
    return waiting && !installing && (await caches.keys()).some((name) => name.endsWith("-third"));
  }));
  await v.until("the offer to come again", offered);

  // Another tab stays with the version that it shows, and still loads parts of it.
  const second = await v.context.newPage();
  await second.goto(v.address);
  await v.until("the second tab", () => second.evaluate(() => document.getElementById("notice").hidden));
  await v.tab.bringToFront();
  await v.tab.evaluate(() => (window.isOldPage = true));
  await v.tab.click("#update-now");
  v.seen.reloaded = await v.until("the new version", () =>
    v.tab.evaluate(() => window.isOldPage === undefined).catch(() => false));
  await page.firstPicture();
  v.seen.renewed = (await script()).includes("-next.");
  v.seen.second = await second.evaluate(() => window.mandelightCodecs().then(() => true, String));
  v.seen.purged = await cached();
});
