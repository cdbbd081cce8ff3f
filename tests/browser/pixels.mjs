// A visit that keeps the pixels of the scenes that the native program draws too.

import { readFile } from "node:fs/promises";
import { Mandelight } from "./mandelight.mjs";
import { visit } from "./visit.mjs";

await visit({ context: { viewport: { width: 720, height: 400 } } }, async (v) => {
  const page = new Mandelight(v);
  await page.open();
  for (const file of process.env.MANDELIGHT_SCENES.split("\n")) {
    const name = file.replace(/.*[/\\]/, "").replace(/\.json$/, "");
    await v.timed(name, async () => page.show(await readFile(file, "utf8")));
    await page.keepPixels(name);
  }
});
