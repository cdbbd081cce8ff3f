// Drives the page of a visit: sends pointer events to widgets that the page's test hook (`?test`)
// locates, and reads scene, progress and pixels from the hook.

import { writeFile } from "node:fs/promises";
import { join } from "node:path";

/** Pointer events of one drag. */
const MOVE_STEPS = 8;

/** Heights of the panel's top and bottom parts that do not scroll, in CSS pixels. */
const PANEL_HEADING = 60;
const PANEL_FOOT = 80;

/** Equal polls, 50 ms apart, after which a value is at rest: frames can be that slow. */
const REST_POLLS = 10;

export class Mandelight {
  /** @param {import("./visit.mjs").Visit} visit */
  constructor(visit) {
    this.visit = visit;
    this.tab = visit.tab;
  }

  /** Opens the page with its test hook and waits for the first picture. */
  async open(fragment = "") {
    // A change of the fragment alone does not reload the page.
    await this.tab.goto("about:blank");
    await this.tab.goto(`${this.visit.address}?test${fragment && `#${fragment}`}`);
    await this.firstPicture();
  }

  /** Waits for the first picture of a page that is loading. */
  firstPicture() {
    return this.visit.until("a first picture", async () => {
      const notice = await this.visit.notice();
      if (notice?.again) throw new Error(`the page shows the notice: ${notice.text}: ${notice.detail}`);
      return (await this.report())?.pictures > 0;
    });
  }

  /** The renderer's report, or null before the page has started. (Until then `window.mandelight`
   * is the canvas, by its id.) */
  report() {
    return this.tab.evaluate(() => window.mandelight?.report?.() ?? null);
  }

  /** The scene in view, as a document. */
  scene() {
    return this.tab.evaluate(() => window.mandelight.scene());
  }

  /** Shows the scene of `document` and waits for its complete picture. */
  show(document) {
    return this.redrawn(() => this.tab.evaluate((json) => window.mandelight.setScene(json), document));
  }

  /** Waits until each pixel holds `samples` samples. */
  sampled(samples) {
    const isThere = async () => {
      const report = await this.report();
      return report?.samplesDone >= samples && report;
    };
    return this.visit.until(`${samples} samples a pixel`, isThere);
  }

  /** Waits until the picture is complete and the renderer idle. */
  settled() {
    return this.visit.until("the picture to be complete", async () => {
      const report = await this.report();
      return report?.idle && report.samplesDone >= report.samplesWanted && report;
    });
  }

  /** Waits until the picture has a sample for so many pixels, or is complete. */
  refined(mostPixels) {
    const isThere = async () => {
      const { idle, pixelsPerSample } = await this.report();
      return idle || pixelsPerSample <= mostPixels;
    };
    return this.visit.until(`a sample for ${mostPixels} pixels`, isThere);
  }

  /** Runs `change` and waits for the complete picture after it. */
  async redrawn(change) {
    const { pictures } = await this.report();
    await change();
    await this.visit.until("another picture", async () => (await this.report()).pictures > pictures);
    return this.settled();
  }

  /** Runs `change`, waits until the scene has changed and is at rest, and returns the scene. */
  async changed(what, change) {
    const before = await this.scene();
    await change();
    const after = async () => {
      const scene = await this.scene();
      return scene !== before && scene;
    };
    await this.visit.until(`${what} to change the scene`, after);
    return this.rested(`the scene after ${what}`, after);
  }

  /** The result of `look`, once it is truthy and has stayed the same for `REST_POLLS` polls. */
  async rested(what, look) {
    let [last, times] = [null, 0];
    return this.visit.until(what, async () => {
      const now = await look();
      const isSame = now && JSON.stringify(now) === JSON.stringify(last);
      [last, times] = [now, isSame ? times + 1 : 0];
      return times >= REST_POLLS && now;
    });
  }

  /** Whether the interface shows `text`, as a screen reader reads it. */
  isSaid(text) {
    return this.tab.evaluate((part) => {
      const page = document.getElementById("accessible-page");
      const labels = [...page.querySelectorAll("[aria-label]")].map((it) => it.getAttribute("aria-label"));
      return [page.textContent, ...labels].some((said) => said.includes(part));
    }, text);
  }

  /** Waits until the interface shows `text`. */
  says(text) {
    return this.visit.until(`the text ${text}`, () => this.isSaid(text));
  }

  /** Waits until `count` of the small pictures that the interface shows are there, or all. */
  smallPictures(count) {
    return this.visit.until("small pictures", async () => {
      const { smallPictures, smallPicturesLeft } = await this.report();
      const areAll = smallPictures > 0 && !smallPicturesLeft && !(await this.isSaid("Looking for places"));
      return smallPictures >= count || areAll;
    });
  }

  /** Opens the scene that a notice offers. */
  async openOffered() {
    const button = this.tab.getByRole("button", { name: "Open the scene anyway", exact: true });
    await button.evaluate((it) => it.click());
    await this.visit.until("the offer to be taken", async () => (await button.count()) === 0);
  }

  /** A widget's rectangle in CSS pixels, or null while the widget is not shown. */
  rect(name) {
    return this.tab.evaluate((widget) => window.mandelight.uiRects()[widget] ?? null, name);
  }

  /** The middle of a widget at rest, in CSS pixels. A row that has it partly aside of the window scrolls to it first. */
  async middle(name) {
    for (;;) {
      const { x, y, width, height } = await this.rested(`the widget ${name}`, () => this.rect(name));
      const middle = [x + width / 2, y + height / 2];
      const window = this.tab.viewportSize();
      if (x > -1 && x + width < window.width + 1) return middle;
      await this.tab.mouse.move(window.width / 2, middle[1]);
      await this.tab.mouse.wheel(0, middle[0] - window.width / 2);
      await this.visit.until("the row to scroll", async () => (await this.rect(name)).x !== x);
    }
  }

  /** Scrolls the panel until a widget is visible, and returns the widget's middle. */
  scrollTo(name) {
    return this.scrollUntilSeen(() => this.middle(name));
  }

  /** Scrolls the panel until the point that `find` returns, at rest, is visible in it, and returns the point. */
  async scrollUntilSeen(find) {
    for (;;) {
      const panel = await this.rect("panel");
      const [x, y] = await find();
      const [top, bottom] = [panel.y + PANEL_HEADING, panel.y + panel.height - PANEL_FOOT];
      if (y > top && y < bottom) return [x, y];
      await this.tab.mouse.move(panel.x + panel.width / 2, (top + bottom) / 2);
      await this.tab.mouse.wheel(0, y - (top + bottom) / 2);
      await this.visit.until("the panel to scroll", async () => (await find())[1] !== y);
    }
  }

  /** Clicks a widget of the panel, scrolling to it first. */
  async click(name) {
    await this.tab.mouse.click(...(await this.scrollTo(name)));
  }

  /** The newest point light's position in the window, in CSS pixels. */
  async newestLight() {
    const { scene } = JSON.parse(await this.scene());
    const { position, orientation, vertical_fov_deg } = scene.camera;
    const [qx, qy, qz, qw] = orientation;
    const offset = scene.lights.point.at(-1).position.map((at, i) => Number(at) - Number(position[i]));
    // The offset in camera space: rotated by the conjugate of the orientation.
    const cross = (a, b) => [0, 1, 2].map((i) => {
      const [j, k] = [(i + 1) % 3, (i + 2) % 3];
      return a[j] * b[k] - a[k] * b[j];
    });
    const t = cross([-qx, -qy, -qz], offset).map((value) => 2 * value);
    const u = cross([-qx, -qy, -qz], t);
    const [x, y, z] = offset.map((value, i) => value + qw * t[i] + u[i]);
    const view = await this.rect("view");
    // The field of view spans the shorter side.
    const half = Math.min(view.width, view.height) / 2;
    const scale = half / (Math.tan((vertical_fov_deg * Math.PI) / 360) * -z);
    return [view.x + view.width / 2 + x * scale, view.y + view.height / 2 - y * scale];
  }

  /** Drags from the middle of a widget, or from a point, by `[dx, dy]` CSS pixels. */
  async drag(from, [dx, dy]) {
    const [x, y] = typeof from === "string" ? await this.middle(from) : from;
    const { mouse } = this.tab;
    await mouse.move(x, y);
    await mouse.down();
    // Slow frames would take the whole drag at once.
    await this.frameDrawn();
    await mouse.move(x + dx, y + dy, { steps: MOVE_STEPS });
    await this.frameDrawn();
    await mouse.up();
  }

  /** Waits until the page has drawn a frame with all events so far. */
  frameDrawn() {
    return this.tab.evaluate(() => new Promise((resolve) => {
      requestAnimationFrame(() => requestAnimationFrame(resolve));
    }));
  }

  /** Writes the picture's pixels, read from the GPU, to `<name>.rgba`, and records their size. */
  async keepPixels(name) {
    const { width, height, base64 } = await this.tab.evaluate(async () => {
      const { width, height, data } = await window.mandelight.pixels();
      let text = "";
      for (let at = 0; at < data.length; at += 0x8000) {
        text += String.fromCharCode(...data.subarray(at, at + 0x8000));
      }
      return { width, height, base64: btoa(text) };
    });
    await writeFile(join(this.visit.out, `${name}.rgba`), Buffer.from(base64, "base64"));
    this.visit.seen.pixels ??= {};
    this.visit.seen.pixels[name] = { width, height };
  }

  /** Clicks a button that saves a file, stores the file as `name`, and returns the suggested name. */
  async keepDownload(name, button) {
    const download = this.tab.waitForEvent("download");
    await this.tab.mouse.click(...(await this.middle(button)));
    const file = await download;
    await file.saveAs(join(this.visit.out, name));
    return file.suggestedFilename();
  }
}
