// Visits that end by an error: the next one offers their scene instead of opening it. After any other end, it opens
// theirs again.

import { Mandelight } from "./mandelight.mjs";
import { COARSE, Visit, visit } from "./visit.mjs";

await visit({ context: { ...COARSE, viewport: { width: 720, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});
  const stored = (key) => v.tab.evaluate((name) => localStorage.getItem(name) ?? "", key);
  /** How many scenes are on their way to a picture, or were when their visit ended. */
  const marks = async () => JSON.parse((await stored("mandelight.unfinished")) || "[]").length;
  const marked = (count) => v.until(`${count} marks`, async () => (await marks()) === count);
  await page.open();
  const quick = JSON.parse(await page.scene());
  quick.scene.quality.samples = 1;
  quick.scene.fractal.power = 5;
  await page.show(JSON.stringify(quick));
  await v.until("the scene to be stored", async () => (await stored("mandelight.scene")).includes('"power":5'));
  await marked(0);
  scenes.shown = await page.scene();

  // A panic, long after the first picture.
  v.provoked = /panic of the test|unreachable/;
  await v.tab.evaluate(() => window.mandelight.endProgram()).catch(() => {});
  v.seen.notice = await v.finalNotice();
  await marked(1);
  await v.tab.click("#notice-again");
  await page.firstPicture();
  v.provoked = null;
  await page.says("The page stopped");
  await page.settled();
  scenes.instead = await page.scene();
  await v.screenshot("offer-720x420");
  await page.openOffered();
  await page.settled();
  scenes.taken = await page.scene();
  // It has been drawn: from now on it opens by itself.
  await marked(0);
  await v.tab.reload();
  await page.firstPicture();
  scenes.again = await page.scene();

  // A first frame without end, in a tab that is then killed.
  await v.tab.goto(`${v.address}licenses.txt`);
  await v.tab.evaluate(() => sessionStorage.clear());
  const other = async (prevent) => {
    const tab = Object.assign(new Visit(v.out, v.server, v.context), { seen: v.seen });
    await tab.open();
    await tab.tab.addInitScript(prevent);
    return tab;
  };
  const hung = await other(() => {
    GPUQueue.prototype.submit = () => {
      for (;;);
    };
  });
  hung.provoked = /the tab crashed/;
  const browser = await v.context.newCDPSession(hung.tab);
  await hung.tab.goto(`${v.address}?test#${process.env.MANDELIGHT_LINK}`, { waitUntil: "commit" });
  await marked(1);
  const crashed = hung.tab.waitForEvent("crash");
  browser.send("Page.crash").catch(() => {});
  await crashed;
  await page.open(process.env.MANDELIGHT_LINK);
  await page.says("The page stopped");
  scenes.instead_of_link = await page.scene();
  await v.tab.goto(`${v.address}licenses.txt`);

  // A visit that is hidden, or loaded again, before its first sharp picture has not ended by an error. Its GPU never
  // finishes, until it is loaded again.
  const slow = await other(() => {
    if (!sessionStorage.getItem("finishes")) GPUQueue.prototype.onSubmittedWorkDone = () => new Promise(() => {});
  });
  const slowPage = new Mandelight(slow);
  await slow.tab.goto(`${v.address}?test#${process.env.MANDELIGHT_OTHER_LINK}`);
  await v.until("the page to start", () => slowPage.report());
  await marked(2);
  const hide = (isHidden) => slow.tab.evaluate((value) => {
    Object.defineProperty(document, "hidden", { value, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
    delete document.hidden;
  }, isHidden);
  // Storage takes a moment to reach another tab.
  await hide(true);
  await marked(1);
  await hide(false);
  await marked(2);
  v.seen.samples = (await slowPage.report()).samplesDone;
  await slow.tab.evaluate(() => sessionStorage.setItem("finishes", "yes"));
  await slow.tab.reload();
  await slowPage.firstPicture();
  scenes.reloaded = await slowPage.scene();
});
