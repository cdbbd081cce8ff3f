// A visit with the mouse: turn, zoom, change the power, add a light, save, reload, open a link.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

/** A window small enough for a software GPU, and wide enough for the panel at its side. */
const SMALL = { width: 720, height: 420 };

const sleep = (secs) => new Promise((resolve) => setTimeout(resolve, 1000 * secs));

await visit({ context: { viewport: { width: 1280, height: 720 } } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});

  // A share sheet of this system, which keeps what it gets.
  await v.context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await v.tab.addInitScript(() => {
    navigator.canShare = ({ files }) => files.every((file) => file.type === "image/png");
    navigator.share = async (data) => void (window.shared = data);
  });

  // The opening view, until its edges are smooth.
  await v.timed("first_picture", () => page.open());
  await v.timed("first_sample", () => page.sampled(1));
  scenes.opened = await page.scene();
  await v.screenshot("opening-1280x720");

  // From here on, small pictures of two samples a pixel, each of them complete.
  await v.tab.setViewportSize(SMALL);
  const quick = JSON.parse(scenes.opened);
  quick.scene.quality.samples = 2;
  v.seen.quick = await v.timed("whole_picture", () => page.show(JSON.stringify(quick)));
  scenes.quick = await page.scene();

  // An idle page dispatches nothing and draws no frame. The autosave's last frames and the idle
  // compilation of pipelines come within the first two seconds.
  await sleep(2);
  v.seen.idle = [await page.settled()];
  await sleep(3);
  v.seen.idle.push(await page.report());

  // Without the panel, the finished picture stays on the screen while its sides are made.
  const beside = await page.rect("view");
  await v.screenshot("panel-720x420");
  const toggle = async () => v.tab.mouse.click(...(await page.middle("panel toggle")));
  await toggle();
  await v.until("the picture to have the window", async () => (await page.rect("view")).width > beside.width);
  await v.screenshot("no-panel-720x420");
  v.seen.views = [beside, await page.rect("view")];
  await page.settled();
  await v.screenshot("no-panel-finished-720x420");
  await toggle();
  await page.rested("the panel", () => page.rect("panel"));
  await page.settled();

  const [x, y] = await page.middle("view");
  const offCentre = [x - 80, y + 30];
  scenes.turned = await page.changed("a drag", () => page.drag(offCentre, [90, -40]));
  v.seen.turned = await page.settled();
  scenes.approached = await page.changed("the wheel", async () => {
    await v.tab.mouse.move(...offCentre);
    await v.tab.mouse.wheel(0, -240);
  });
  await page.settled();

  // The rail is the lower half of the power's row.
  const [railX, railY] = await page.scrollTo("power");
  scenes.powered = await page.changed("the power's slider", () => page.drag([railX, railY + 12], [-60, 0]));
  await page.settled();
  await v.screenshot("another-power-720x420");

  await page.click("more");
  await page.click("All lights");
  scenes.lit = await page.changed("a new light", () => page.click("Add point light"));
  await page.settled();
  await v.screenshot("added-light-720x420");
  const light = await page.newestLight();
  scenes.relit = await page.changed("dragging the light", () => page.drag(light, [60, 40]));
  v.seen.finished = await page.settled();
  await v.screenshot("dragged-light-720x420");

  const { dispatches } = await page.report();
  v.seen.download = await page.keepDownload("download.png", "save picture");
  v.seen.saved_dispatches = (await page.report()).dispatches - dispatches;

  // The picture on the screen, to the share sheet and to the clipboard.
  const share = async (button) => {
    await v.tab.keyboard.press("j");
    await v.tab.mouse.click(...(await page.middle(button)));
    await v.tab.keyboard.press("Escape");
  };
  await share("Send picture…");
  v.seen.shared = await v.until("the share sheet", () => v.tab.evaluate(async () => {
    const [file] = window.shared?.files ?? [];
    return file && { name: file.name, type: file.type, bytes: Array.from(new Uint8Array(await file.arrayBuffer())) };
  }));
  await writeFile(join(v.out, "shared.png"), Buffer.from(v.seen.shared.bytes));
  delete v.seen.shared.bytes;
  await share("Copy picture");
  await page.says("Picture copied");
  const copied = await v.tab.evaluate(async () => {
    const [item] = await navigator.clipboard.read();
    return Array.from(new Uint8Array(await (await item.getType("image/png")).arrayBuffer()));
  });
  await writeFile(join(v.out, "copied.png"), Buffer.from(copied));
  await v.tab.keyboard.press("j");
  v.seen.code = await page.rested("the code", () => page.rect("QR code"));
  await v.screenshot("shared-720x420");
  await v.tab.mouse.click(...(await page.middle("Copy link")));
  await page.says("Link copied");
  v.seen.link = await v.tab.evaluate(() => navigator.clipboard.readText());
  await v.tab.keyboard.press("Escape");
  v.seen.used_dispatches = (await page.report()).dispatches - dispatches;

  // A kept view has a picture, and is stored.
  // The lists stand at the upper end of the panel.
  const panel = await page.rect("panel");
  await v.tab.mouse.move(panel.x + panel.width / 2, panel.y + panel.height / 2);
  await v.tab.mouse.wheel(0, -20000);
  await v.tab.mouse.click(...(await page.middle("Mine")));
  await v.until("the list of kept views", () => page.rect("keep view"));
  await v.tab.mouse.click(...(await page.middle("keep view")));
  v.seen.kept = await v.until("the view to be kept", () => v.tab.evaluate(() => {
    const [kept] = JSON.parse(localStorage.getItem("mandelight.favourites") ?? "[]");
    return kept && { name: kept.name, picture: kept.picture };
  }));
  await v.screenshot("kept-720x420");

  // Three ways back: the address, the browser's storage alone, a link.
  scenes.before_reload = await page.scene();
  await sleep(2);
  v.seen.fragment = new URL(v.tab.url()).hash.slice(1);
  await v.tab.reload();
  await page.firstPicture();
  scenes.reloaded = await page.scene();
  scenes.undone = await page.changed("undo after a reload", () => v.tab.keyboard.press("Control+z"));
  await page.changed("redo", () => v.tab.keyboard.press("Control+Shift+z"));
  await sleep(2);
  await page.open();
  scenes.revisited = await page.scene();
  await page.open(process.env.MANDELIGHT_LINK);
  scenes.linked = await page.scene();
  await v.tab.goto("about:blank");
  await v.tab.goto(v.seen.link);
  await page.firstPicture();
  scenes.copied = await page.scene();
});
