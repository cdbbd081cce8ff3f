// How long pieces of work keep the GPU of a browser, over the scenes of the benchmark `pieces`.
//
// cargo xtask bench --views pieces --keep-scenes target/scenes
// MANDELIGHT_DIST=dist MANDELIGHT_CHROMIUM=/usr/bin/chromium MANDELIGHT_OUT=target/pieces MANDELIGHT_SCENES=target/scenes \
//     node benches/page/pieces.mjs
//
// One view opens scene after scene, some seconds each, and times every piece from its submission, or the end of the piece
// before it, until the browser reports it done. Prints the times in motion budgets, as the native benchmark does.

import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "../../tests/browser/mandelight.mjs";
import { visit } from "../../tests/browser/visit.mjs";

/** How long each scene is drawn: a software GPU of few cores takes longer than the native program to begin. */
const SCENE_MS = Number(process.env.MANDELIGHT_SCENE_MS ?? 4000);

await visit({ context: { viewport: { width: 640, height: 384 } } }, async (v) => {
  const page = new Mandelight(v);
  await page.open();
  const { mouse } = v.tab;
  if (await page.rect("panel")) await mouse.click(...(await page.middle("panel toggle")));
  await page.settled();
  const { width, height } = await page.report();
  console.log(`pictures of ${width}x${height}`);
  const take = () => v.tab.evaluate(() => window.mandelight.takePieceTimes());
  await take();
  const folder = process.env.MANDELIGHT_SCENES;
  const [all, allDisplays] = [[], []];
  for (const set of ["gallery", "random", "expensive"]) {
    const files = (await readdir(join(folder, set))).sort();
    const pieces = [];
    const displays = [];
    for (const file of files) {
      const text = await readFile(join(folder, set, file), "utf8");
      const budget = JSON.parse(text).scene.quality.motion_budget_ms;
      await v.tab.evaluate((json) => window.mandelight.setScene(json), text);
      await new Promise((resolve) => setTimeout(resolve, SCENE_MS));
      for (const [ms, isDisplay] of await take()) {
        if (isDisplay) displays.push(ms);
        else pieces.push({ ms, budgets: ms / budget, name: `${set}/${file}` });
      }
    }
    print(`${files.length} of ${set}`, pieces, displays);
    all.push(...pieces);
    allDisplays.push(...displays);
  }
  print("all", all, allDisplays);
});

function print(name, pieces, displays) {
  const budgets = pieces.map((piece) => piece.budgets).sort((a, b) => a - b);
  const at = (part) => budgets[Math.floor(part * (budgets.length - 1))]?.toFixed(2);
  const over = (100 * budgets.filter((it) => it > 2).length) / budgets.length;
  const longest = pieces.reduce((most, piece) => (piece.ms > most.ms ? piece : most), { ms: 0, name: "" });
  console.log(
    `${name}: ${pieces.length} pieces, median ${at(0.5)} budgets, 99 % ${at(0.99)}, over two ${over.toFixed(1)} %, ` +
      `longest ${longest.ms.toFixed(0)} ms (${longest.name}), longest display ${Math.max(0, ...displays).toFixed(0)} ms`,
  );
}
