// Visits that lose the GPU, as after a driver's reset: at rest, while the view moves, while pipelines are compiled,
// while files are saved, twice and ten times.

import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "./mandelight.mjs";
import { unzipped } from "./unzip.mjs";
import { COARSE, visit } from "./visit.mjs";

const LOSSES = "mandelight.losses";
const SETTINGS = "mandelight.settings";

/** Real seconds per second of the page's clock. */
const SLOWNESS = 4;

await visit({ context: { ...COARSE, viewport: { width: 720, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  const lose = () => v.tab.evaluate(() => window.mandelight.loseDevice());
  const forget = () => v.tab.evaluate((key) => localStorage.removeItem(key), LOSSES);
  const stored = (key) => v.tab.evaluate((name) => localStorage.getItem(name), key);
  /** Waits until a lost device has been noted, `count` times since the last complete picture. */
  const noted = (count) => v.until(`loss ${count} to be noted`, async () =>
    JSON.parse((await stored(LOSSES)) ?? "{}").since_picture >= count);
  const hasNoPicture = () => v.tab.evaluate(() => window.mandelight.pixels().then(() => false, () => true));
  const drawsAgain = () => v.until("a picture on the new device", async () => !(await hasNoPicture()));

  // The page counts the losses of its last two minutes. A software GPU may need longer, so the page's clock is slower.
  await v.tab.addInitScript((slowness) => {
    const { now } = Date;
    Date.now = () => now() / slowness;
  }, SLOWNESS);
  await page.open();
  const quick = JSON.parse(await page.scene());
  quick.scene.quality.samples = 1;
  await page.show(JSON.stringify(quick));
  /** Shows the quick scene in another light, so that its picture is not the one on the screen. */
  const showAnother = () => {
    quick.scene.tone.exposure += 0.125;
    return page.show(JSON.stringify(quick));
  };

  await v.timed("at_rest", async () => {
    v.seen.before = await page.scene();
    await page.keepPixels("before");
    await lose();
    await noted(1);
    await drawsAgain();
    v.seen.report = await page.settled();
    v.seen.after = await page.scene();
    v.seen.notice = await v.notice();
    await page.keepPixels("after");
    await v.screenshot("after-a-loss-720x420");
    v.seen.cleared = JSON.parse(await stored(LOSSES)).since_picture;
  });

  // The hand goes on where it was: the scene of the last movement is the one that comes back.
  await v.timed("moving", async () => {
    await forget();
    const [x, y] = await page.middle("view");
    const { mouse } = v.tab;
    await mouse.move(x, y);
    await mouse.down();
    await mouse.move(x + 30, y + 10, { steps: 4 });
    await v.until("the view to move", async () => (await page.scene()) !== v.seen.after);
    await lose();
    await noted(1);
    v.seen.moved = await page.scene();
    await mouse.up();
    await drawsAgain();
    await page.settled();
    v.seen.moved_after = await page.scene();
  });

  await v.timed("compiling", async () => {
    await forget();
    const other = JSON.parse(v.seen.before);
    other.scene.fractal.power = 5;
    const compiles = async () => (await page.report()).activity.startsWith("compiling");
    await v.tab.evaluate((json) => window.mandelight.setScene(json), JSON.stringify(other));
    v.seen.compiled = await v.until("the compilation to begin", compiles, 60).then(() => true);
    await lose();
    await noted(1);
    await drawsAgain();
    v.seen.compiled_report = await page.settled();
    v.seen.power = JSON.parse(await page.scene()).scene.fractal.power;
  });

  // A picture of six tiles, once without a loss and once with one in its middle.
  await v.timed("saving", async () => {
    await v.tab.evaluate(([key, losses]) => {
      localStorage.removeItem(losses);
      const settings = JSON.parse(localStorage.getItem(key) ?? "{}");
      settings.export = { times: 0, typed_px: [128, 1400], sequence: "pngs" };
      // The page writes its own settings at the same events, before.
      const write = () => localStorage.setItem(key, JSON.stringify(settings));
      window.addEventListener("pagehide", write);
      document.addEventListener("visibilitychange", write);
    }, [SETTINGS, LOSSES]);
    await v.tab.addInitScript(() => { window.showSaveFilePicker = undefined; });
    await v.tab.reload();
    await page.firstPicture();
    await page.show(JSON.stringify(quick));
    const underWay = () => v.until("saving to be under way", async () => {
      const { exporting, exported } = await page.report();
      return exporting && exported > 0.3;
    });
    const interrupted = async (name, button) => {
      const saved = page.keepDownload(name, button);
      await underWay();
      await forget();
      await lose();
      // The notice gives way to that of the saved file.
      const said = page.says("Saving goes on").then(() => true, () => false);
      // The loss counts against restarts; it says nothing of the scene in view.
      await v.until("the loss to be stored", async () => {
        const losses = JSON.parse((await stored(LOSSES)) ?? "{}");
        return losses.at_secs?.length === 1 && losses.since_picture === 0;
      });
      v.seen.still_saving = (v.seen.still_saving ?? 0) + 1;
      v.seen.offered_notice = (v.seen.offered_notice ?? true) && (await said);
      return saved;
    };
    await page.keepDownload("whole.png", "save picture");
    // What is edited meanwhile is of no account.
    const edited = page.keepDownload("edited.png", "save picture");
    await underWay();
    v.seen.edited_while_saving = await v.tab.evaluate(() => {
      const document = JSON.parse(window.mandelight.scene());
      document.scene.fractal.power = 5;
      window.mandelight.setScene(JSON.stringify(document));
      return window.mandelight.report().exporting;
    });
    await edited;
    await page.show(JSON.stringify(quick));
    await interrupted("resumed.png", "save picture");
    await page.settled();

    const path = JSON.parse(process.env.MANDELIGHT_PATH);
    // Its picture may be the one on the screen.
    await v.tab.evaluate((json) => window.mandelight.setScene(json), JSON.stringify(path));
    for (const toggle of ["panel toggle", "timeline toggle"]) {
      await v.tab.mouse.click(...(await page.middle(toggle)));
    }
    await page.keepDownload("whole.zip", "save sequence");
    await interrupted("resumed.zip", "save sequence");
    await page.settled();
    const [whole, resumed] = await Promise.all(["whole.zip", "resumed.zip"].map(async (name) =>
      unzipped(await readFile(join(v.out, name)))));
    v.seen.frames = resumed.map(([name]) => name);
    v.seen.same_frames = resumed.filter(([, bytes], i) => bytes.equals(whole[i][1])).length;
  });

  // Twice in a row: the page waits for the visitor, whose first movement goes on.
  await v.timed("twice", async () => {
    await forget();
    await showAnother();
    await lose();
    await noted(1);
    await v.until("the new device", () => v.tab.evaluate(() => window.mandelight.hasDevice()));
    await lose();
    await noted(2);
    await page.says("drawing is paused");
    v.seen.paused = (await page.report()).pictures;
    await page.changed("a drag", async () => page.drag(await page.middle("view"), [40, 10]));
    await drawsAgain();
    await page.settled();
    v.seen.cleared_again = JSON.parse(await stored(LOSSES)).since_picture;
  });

  // Ten times within two minutes or so: the page gives up at the third loss, and the visits after it do not open the
  // scene by themselves.
  await v.timed("ten_times", async () => {
    await forget();
    // A complete picture would clear the losses, so there must be none in between.
    quick.scene.quality.samples = 16;
    await showAnother();
    await new Promise((resolve) => setTimeout(resolve, 1500));
    v.seen.lost = await page.scene();
    v.seen.given_up = 0;
    for (let count = 1; count <= 10; count += 1) {
      await v.until("a device", () => v.tab.evaluate(() => window.mandelight.hasDevice()));
      await lose();
      await noted(count);
      const gaveUp = await v.until("the page to restart or give up", async () => {
        if ((await v.notice())?.again) return "gave up";
        return (await v.tab.evaluate(() => window.mandelight.hasDevice())) && "restarted";
      });
      if (gaveUp !== "gave up") continue;
      v.seen.given_up += 1;
      v.seen.last_notice = (await v.notice()).text;
      if (count === 10) break;
      await v.tab.reload();
      await page.says("several times");
      // Losses within a second of the page's clock count as one, as those of several tabs.
      await v.until("a second of the page's clock", () => v.tab.evaluate(
        (key) => Date.now() / 1000 - JSON.parse(localStorage.getItem(key)).at_secs.at(-1) > 1, LOSSES));
      // A visitor who wants the scene opens it, and it is lost again, before its picture is complete.
      await page.openOffered();
    }
    await v.tab.reload();
    await page.firstPicture();
    await page.says("several times");
    await page.settled();
    v.seen.opened_instead = await page.scene();
    v.seen.kept_losses = JSON.parse(await stored(LOSSES)).since_picture;
    await v.screenshot("offer-720x420");
    await page.openOffered();
    await page.settled();
    v.seen.taken = await page.scene();
    await v.until("the losses to be cleared", async () => JSON.parse(await stored(LOSSES)).since_picture === 0);
  });
});
