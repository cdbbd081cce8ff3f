// Visits with a storage that is damaged, another version's, full, blocked, or shared by two tabs.

import { Mandelight } from "./mandelight.mjs";
import { Visit, visit } from "./visit.mjs";

/** Damaged texts: bytes that are no JSON, JSON of other kinds, and halves of what was stored. */
const DAMAGED = [
  () => "\u0000\ufffd}{\u202e",
  (_, index) => ["7", "null", "[[]]", '{"mandelight":[]}', '"text"'][index % 5],
  (text) => text.slice(0, text.length / 2),
];

const PERMANENT = [
  "mandelight.scene",
  "mandelight.settings",
  "mandelight.favourites",
  "mandelight.losses",
  "mandelight.unfinished",
];
const OF_TAB = ["mandelight.tab", "mandelight.steps"];

await visit({ context: { viewport: { width: 800, height: 480 } } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});
  v.seen.notices = {};

  /** A page of the same origin, on which nothing of the program runs. */
  const leave = (tab = v.tab) => tab.goto(`${v.address}licenses.txt`);
  /** Opens the page without waiting for a picture. */
  const open = async (that = page, fragment = "") => {
    await leave(that.tab);
    await that.tab.goto(`${v.address}?test${fragment}`);
    await v.until("the page to start", () => that.report());
  };
  const read = (key, tab = v.tab) => tab.evaluate((name) => localStorage.getItem(name), key);
  const says = async (name, text) => (v.seen.notices[name] = await page.says(text));
  /** Sets the exposure, and waits until a text in the storage has it. */
  const edit = async (that, exposure) => {
    await that.tab.evaluate((value) => {
      const document = JSON.parse(window.mandelight.scene());
      document.scene.quality.samples = 1;
      document.scene.tone.exposure = value;
      window.mandelight.setScene(JSON.stringify(document));
    }, exposure);
  };
  const stored = (that, key, part) =>
    v.until(`${part} in ${key}`, async () => (await read(key, that.tab))?.includes(part));

  await page.open();
  await edit(page, 0.25);
  await stored(page, "mandelight.scene", '"exposure":0.25');
  scenes.opening = await page.scene();
  // What the program itself stored, to be damaged below.
  const own = {};
  await leave();
  for (const key of PERMANENT) own[key] = (await read(key)) ?? "[]";
  for (const key of OF_TAB) own[key] = (await v.tab.evaluate((name) => sessionStorage.getItem(name), key)) ?? "{}";

  for (const [index, damage] of DAMAGED.entries()) {
    await leave();
    const texts = Object.fromEntries(Object.entries(own).map(([key, text], i) => [key, damage(text, i)]));
    await v.tab.evaluate(([texts, permanent]) => {
      for (const [key, text] of Object.entries(texts)) {
        (permanent.includes(key) ? localStorage : sessionStorage).setItem(key, text);
      }
    }, [texts, PERMANENT]);
    await open();
    scenes[`damaged-${index}`] = await page.scene();
    await says(`damaged-${index}`, "The scene of the last visit is damaged");
    await edit(page, 0.5 + index / 8);
    await stored(page, "mandelight.scene", `"exposure":${0.5 + index / 8}`);
  }

  // A newer version's scene, settings and views stay; this version's scene is stored beside them.
  await leave();
  const newer = own["mandelight.scene"].replace(/"version":(\d+)/, (_, n) => `"version":${Number(n) + 1},"more":{}`);
  await v.tab.evaluate((newer) => {
    sessionStorage.clear();
    localStorage.clear();
    localStorage.setItem("mandelight.scene", newer);
    localStorage.setItem("mandelight.settings", JSON.stringify({ palette: "of tomorrow", sheet: "floating", formulas: ["f"] }));
    localStorage.setItem("mandelight.favourites", JSON.stringify([{ title: "of tomorrow" }]));
  }, newer);
  await open();
  await says("newer", "stored by a newer Mandelight");
  await edit(page, -0.75);
  await stored(page, "mandelight.scene.older", '"exposure":-0.75');
  await leave();
  v.seen.newer = {
    is_kept: (await read("mandelight.scene")) === newer,
    settings: JSON.parse(await read("mandelight.settings")),
    favourites: JSON.parse(await read("mandelight.favourites")),
  };
  await v.tab.evaluate(() => sessionStorage.clear());
  await open();
  scenes.older = await page.scene();

  // An older version's scene and settings.
  await leave();
  await v.tab.evaluate(() => {
    sessionStorage.clear();
    localStorage.clear();
    localStorage.setItem("mandelight.scene", '{"mandelight":"scene","version":1,"scene":{"fractal":{"power":5}}}');
    localStorage.setItem("mandelight.settings", '{"panel_open":false}');
  });
  await open();
  scenes.version_1 = await page.scene();
  // The interface is drawn once its button is there.
  await v.until("the button of the panel", () => page.rect("panel toggle"));
  v.seen.older_panel = await page.rect("panel");

  // Two tabs: each keeps a view, each comes back to its own scene.
  await leave();
  await v.tab.evaluate(() => {
    sessionStorage.clear();
    localStorage.clear();
  });
  const second = Object.assign(new Visit(v.out, v.server, v.context), { seen: v.seen });
  await second.open();
  const tabs = [page, new Mandelight(second)];
  for (const that of tabs) {
    await that.visit.tab.bringToFront();
    await open(that);
    await that.firstPicture();
  }
  for (const [index, that] of tabs.entries()) {
    await that.visit.tab.bringToFront();
    await edit(that, index + 1);
    await stored(that, "mandelight.scene", `"exposure":${index + 1}`);
    await that.tab.mouse.click(...(await that.middle("Mine")));
    await v.until("the list of kept views", () => that.rect("keep view"));
    await that.tab.mouse.click(...(await that.middle("keep view")));
    const count = async () => JSON.parse((await read("mandelight.favourites", that.tab)) ?? "[]").length;
    await v.until(`${index + 1} kept views`, async () => (await count()) >= index + 1);
  }
  v.seen.kept = JSON.parse(await read("mandelight.favourites")).map(({ document }) => document);
  for (const [index, that] of tabs.entries()) {
    await that.visit.tab.bringToFront();
    await that.tab.reload();
    await v.until("the page to start", () => that.report());
    scenes[`tab-${index}`] = await that.scene();
  }
  await second.tab.close();
  await v.tab.bringToFront();

  // Full: the address brings the scene back, and the visitor knows.
  await leave();
  await v.tab.evaluate(() => {
    for (const storage of [localStorage, sessionStorage]) {
      storage.clear();
      for (let size = 1 << 23; size >= 1; size /= 2) {
        for (let i = 0; ; i++) {
          try {
            storage.setItem(`${size}-${i}`, "x".repeat(size));
          } catch {
            break;
          }
        }
      }
    }
  });
  await open();
  await edit(page, 1.5);
  await says("full", "does not store your scene");
  await v.tab.reload();
  await v.until("the page to start", () => page.report());
  scenes.full = await page.scene();
  await v.screenshot("full-480x320");

  // Blocked, as where cookies are refused: each access throws.
  await v.tab.addInitScript(() => {
    for (const name of ["localStorage", "sessionStorage"]) {
      Object.defineProperty(window, name, {
        get() {
          throw new DOMException("Access is denied for this document.", "SecurityError");
        },
      });
    }
  });
  await open(page);
  scenes.blocked_first = await page.scene();
  await edit(page, -1.5);
  await says("blocked", "does not store your scene");
  await v.tab.reload();
  await v.until("the page to start", () => page.report());
  scenes.blocked = await page.scene();
  v.seen.panics = await v.tab.evaluate(() => window.mandelight.errors());
});
