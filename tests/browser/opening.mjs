// The picture that the document contains: there before the module, and in the place of the view's first one.
// Then a visitor who asks for little motion, and one with a phone.

import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

const SIZE = { viewport: { width: 640, height: 400 } };
const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 };

await visit({ context: SIZE }, async (v) => {
  v.seen.normal = await watched(v, "normal");
  await v.openAnew({ ...SIZE, reducedMotion: "reduce" });
  v.seen.reduced = await watched(v, "reduced");

  // Another scene is there at once: no camera between the two is seen.
  const page = new Mandelight(v);
  await v.tab.evaluate(() => {
    window.cameras = new Set();
    const note = () => {
      window.cameras.add(JSON.stringify(JSON.parse(window.mandelight.scene()).scene.camera.position));
      requestAnimationFrame(note);
    };
    note();
  });
  await page.changed("another scene", () => v.tab.keyboard.press("2"));
  v.seen.cameras = await v.tab.evaluate(() => window.cameras.size);

  // A link has another picture than the document: words stand there until it is drawn.
  await v.openAnew(SIZE);
  const release = await holdModule(v);
  await v.tab.goto(`${v.address}?test#${process.env.MANDELIGHT_LINK}`);
  v.seen.linked = await loadingNotice(v);
  await v.screenshot("linked-640x400");
  release();
  const linked = new Mandelight(v);
  await linked.firstPicture();
  v.seen.scenes = { linked: await linked.scene() };

  // So has the next visit, which goes on with that scene; only a changed scene is stored.
  await v.tab.evaluate(() => {
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = 2;
    window.mandelight.setScene(JSON.stringify(document));
  });
  await v.until("the scene to be stored", () => v.tab.evaluate(() => localStorage.getItem("mandelight.scene")));
  await v.tab.goto("about:blank");
  const releaseAgain = await holdModule(v);
  await v.tab.goto(`${v.address}?test`);
  v.seen.stored = await loadingNotice(v);
  releaseAgain();
  await linked.firstPicture();
  v.seen.scenes.stored = await linked.scene();

  await v.openAnew(PHONE);
  v.seen.phone = await watched(v, "phone");
});

/** The notice of a page that is loading, and whether the opening picture stands behind it. */
async function loadingNotice(v) {
  const notice = await v.until("the notice", async () => {
    const notice = await v.notice();
    return notice?.detail && notice;
  });
  return { ...notice, isCovered: await v.tab.evaluate(() => !document.getElementById("opening").hidden) };
}

/** Holds the module back until the returned function is called. */
async function holdModule(v) {
  let release;
  const released = new Promise((resolve) => (release = resolve));
  await v.context.route(/\.wasm$/, async (route) => {
    await released;
    await route.continue();
  });
  return release;
}

/** Loads the page as at a first visit, the module only once the opening picture has been photographed. */
async function watched(v, name) {
  const page = new Mandelight(v);
  const release = await holdModule(v);
  await v.tab.goto(`${v.address}?test`);
  const motion = await v.until("the opening picture", () => v.tab.evaluate(async () => {
    const [frame, picture] = ["opening", "opening-picture"].map((id) => document.getElementById(id));
    if (frame.hidden || !picture.complete) return null;
    const animation = getComputedStyle(picture).animationName;
    // What the hand-over does, and back.
    frame.className = "leaving";
    const fade = getComputedStyle(frame).transitionDuration;
    frame.className = "";
    await Promise.allSettled(document.getAnimations().map((it) => it.finished));
    return { animation, fade, width: frame.clientWidth, height: frame.clientHeight };
  }));
  await v.screenshot(`${name}-inlined`);
  const isModuleThere = await v.tab.evaluate(() => Boolean(window.mandelight?.report));

  release();
  await v.until("the hand-over", () => v.tab.evaluate(() => {
    const frame = document.getElementById("opening");
    return frame.hidden || (frame.className === "leaving" && getComputedStyle(frame).opacity === "0");
  }));
  await v.screenshot(`${name}-handed-over`);
  const { samplesDone } = await page.report();
  await page.sampled(2);
  await v.until("the view's own picture", () => v.tab.evaluate(() => document.getElementById("opening").hidden));
  await v.screenshot(`${name}-drawn`);
  return { ...motion, isModuleThere, samplesDone, view: await page.rect("view") };
}
