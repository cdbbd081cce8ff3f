// How soon the page answers clicks while it draws the most expensive scene that a document may have.
//
// MANDELIGHT_DIST=dist MANDELIGHT_CHROMIUM=/usr/bin/chromium MANDELIGHT_OUT=target/clicks node benches/page/clicks.mjs
//
// Each click opens or closes the window for sharing; its answer is the first frame of the interface that shows it. Prints
// the times in milliseconds for the opening scene at rest and for the expensive one while it is drawn.

import { Mandelight } from "../../tests/browser/mandelight.mjs";
import { visit } from "../../tests/browser/visit.mjs";

const CLICKS = 20;
/** Pause between two clicks: the picture goes on meanwhile. */
const PAUSE_MS = 700;
const MAX_LIGHTS = 64;

/** Clicks the share button in the page itself, and returns the milliseconds until the widgets have changed. */
function answer() {
  const { x, y, width, height } = window.mandelight.uiRects().share;
  const canvas = document.querySelector("canvas");
  const isOpen = () => "share window" in window.mandelight.uiRects();
  const wasOpen = isOpen();
  const at = { clientX: x + width / 2, clientY: y + height / 2, bubbles: true, button: 0 };
  const began = performance.now();
  const pointer = { ...at, pointerId: 1, pointerType: "mouse", isPrimary: true };
  canvas.dispatchEvent(new PointerEvent("pointermove", pointer));
  canvas.dispatchEvent(new PointerEvent("pointerdown", { ...pointer, buttons: 1 }));
  document.dispatchEvent(new PointerEvent("pointerup", pointer));
  return new Promise((resolve) => {
    const look = () => {
      const isAnswered = isOpen() !== wasOpen;
      const waited = performance.now() - began;
      if (isAnswered || waited > 10_000) resolve(isAnswered ? waited : null);
      else setTimeout(look, 2);
    };
    look();
  });
}

await visit({ context: { viewport: { width: 1280, height: 720 } } }, async (v) => {
  const page = new Mandelight(v);
  await page.open();
  const measure = async (name) => {
    const times = [];
    for (let click = 0; click < CLICKS; click += 1) {
      await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
      times.push(await v.tab.evaluate(answer));
    }
    const unanswered = times.filter((time) => time === null).length;
    const sorted = times.filter((time) => time !== null).sort((a, b) => a - b);
    const at = (part) => sorted[Math.floor(part * (sorted.length - 1))]?.toFixed(0);
    console.log(`${name}: median ${at(0.5)} ms, longest ${at(1)} ms, ${unanswered} unanswered`);
  };
  await v.tab.evaluate(() => {
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = 1;
    window.mandelight.setScene(JSON.stringify(document));
  });
  await page.settled();
  await measure("the opening scene at rest");
  await v.tab.evaluate((count) => {
    const document = JSON.parse(window.mandelight.scene());
    const { scene } = document;
    scene.fractal.iterations = 100;
    scene.quality.detail = 0.1;
    scene.quality.samples = 64;
    const direction = (k) => {
      const z = (k + 0.5) / count;
      const rho = Math.sqrt(1 - z * z);
      return [rho * Math.cos(2.4 * k), rho * Math.sin(2.4 * k), z];
    };
    scene.lights.environment = Array.from({ length: count }, (_, k) => ({
      direction: direction(k),
      color: [1, 0.9, 0.8],
      intensity: 0.1,
    }));
    scene.lights.point = [];
    window.mandelight.setScene(JSON.stringify(document));
  }, MAX_LIGHTS);
  await measure("the most expensive scene, while it is drawn");
});
