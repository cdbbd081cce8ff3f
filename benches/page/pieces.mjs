// How long pieces of work keep the GPU of a browser, over the scenes of the benchmark `pieces`.
//
// cargo xtask bench --views pieces --keep-scenes target/scenes
// MANDELIGHT_DIST=dist MANDELIGHT_CHROMIUM=/usr/bin/chromium MANDELIGHT_OUT=target/pieces MANDELIGHT_SCENES=target/scenes \
//     node benches/page/pieces.mjs
//
// One view opens scene after scene, some seconds each, and the GPU's own timestamps measure every submit: pieces of pictures,
// displays, and frames of the interface. Prints the times in motion budgets, as the native benchmark does, and the scenes that most
// of the long ones are from.

import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "../../tests/browser/mandelight.mjs";
import { visit } from "../../tests/browser/visit.mjs";
import { takeSubmits, watchSubmits } from "./gpu_times.mjs";

/** How long each scene is drawn: a software GPU of few cores takes longer than the native program to begin. */
const SCENE_MS = Number(process.env.MANDELIGHT_SCENE_MS ?? 4000);

await visit({ context: { viewport: { width: 640, height: 384 } } }, async (v) => {
  await watchSubmits(v.context);
  const page = new Mandelight(v);
  await page.open();
  const { mouse } = v.tab;
  if (await page.rect("panel")) await mouse.click(...(await page.middle("panel toggle")));
  await finished(page, v.tab);
  const { width, height } = await page.report();
  console.log(`pictures of ${width}x${height}`);
  const folder = process.env.MANDELIGHT_SCENES;
  const all = [];
  for (const set of ["gallery", "random", "expensive"]) {
    const files = (await readdir(join(folder, set))).sort();
    const submits = [];
    for (const file of files) {
      const text = await readFile(join(folder, set, file), "utf8");
      const budget = JSON.parse(text).scene.quality.motion_budget_ms;
      await v.tab.evaluate((json) => window.mandelight.setScene(json), text);
      await new Promise((resolve) => setTimeout(resolve, SCENE_MS));
      for (const { name, ms } of await takeSubmits(v.tab)) {
        submits.push({ kind: name, ms, budget, budgets: ms / budget, scene: `${set}/${file}` });
      }
    }
    print(`${files.length} of ${set}`, submits);
    all.push(...submits);
  }
  print("all", all);
  printWorstScenes(all);
});

/** Waits for the opening picture. Its submits, more than one reading holds, are read meanwhile and left out. */
async function finished(page, tab) {
  let isFinished = false;
  const settled = page.settled().finally(() => (isFinished = true));
  while (!isFinished) {
    await takeSubmits(tab);
    await Promise.race([settled, new Promise((resolve) => setTimeout(resolve, 1000))]);
  }
  await settled;
  await takeSubmits(tab);
}

/** Prints the times of pieces, of displays and of frames of the interface. */
function print(name, submits) {
  const of = (kind) => submits.filter((submit) => submit.kind === kind);
  const longest = (some) => some.reduce((most, submit) => (submit.ms > most.ms ? submit : most), { ms: 0, scene: "" });
  const at = (part, values) => values.toSorted((a, b) => a - b)[Math.floor(part * (values.length - 1))] ?? 0;
  const pieces = of("trace");
  const budgets = pieces.map((piece) => piece.budgets);
  const over = (100 * budgets.filter((it) => it > 2).length) / budgets.length;
  const most = longest(pieces);
  const frames = submits.filter((submit) => submit.kind.startsWith("egui")).map((frame) => frame.ms);
  console.log(
    `${name}: ${pieces.length} pieces, median ${at(0.5, budgets).toFixed(2)} budgets, 99 % ${at(0.99, budgets).toFixed(2)}, ` +
      `over two ${over.toFixed(1)} %, longest ${most.ms.toFixed(0)} ms (${most.scene}); ` +
      `longest display ${longest(of("display")).ms.toFixed(0)} ms; ` +
      `${frames.length} frames of the interface, median ${at(0.5, frames).toFixed(1)} ms, 99 % ${at(0.99, frames).toFixed(1)} ms`,
  );
}

/** Prints the scenes with the most pieces over two budgets, and those with the longest displays. */
function printWorstScenes(submits) {
  const scenes = [...new Set(submits.map((submit) => submit.scene))].map((scene) => {
    const of = submits.filter((submit) => submit.scene === scene);
    const pieces = of.filter((submit) => submit.kind === "trace");
    const longest = (kind) => Math.max(0, ...of.filter((submit) => submit.kind === kind).map((submit) => submit.ms));
    return {
      scene,
      budget: of[0].budget,
      pieces: pieces.length,
      over: pieces.filter((piece) => piece.budgets > 2).length,
      longestPiece: longest("trace"),
      longestDisplay: longest("display"),
    };
  });
  const table = (title, rows) => {
    console.log(title);
    for (const row of rows) {
      console.log(
        `  ${row.scene}, ${row.budget} ms: ${row.over} of ${row.pieces} pieces over two budgets, longest ${row.longestPiece.toFixed(0)} ms; ` +
          `longest display ${row.longestDisplay.toFixed(0)} ms`,
      );
    }
  };
  const first = (key) => scenes.toSorted((a, b) => b[key] - a[key]).slice(0, 8);
  table("scenes with the most pieces over two budgets:", first("over").filter((row) => row.over > 0));
  table("scenes with the longest displays:", first("longestDisplay"));
}
