// A visit by screen reader: the page's accessible elements name everything, follow the keyboard, open a
// scene, change the power and save.

import { join } from "node:path";
import { Mandelight } from "./mandelight.mjs";
import { COARSE, visit } from "./visit.mjs";

await visit({ context: { ...COARSE, viewport: { width: 720, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});
  await page.open();
  await v.tab.evaluate(() => {
    // Quick pictures: this visit is about what is said.
    const document = JSON.parse(window.mandelight.scene());
    document.scene.quality.samples = 1;
    window.mandelight.setScene(JSON.stringify(document));
  });
  await page.settled();
  scenes.opened = await page.scene();

  // The browser's own accessibility tree, as screen readers get it.
  const protocol = await v.context.newCDPSession(v.tab);
  const tree = async () => {
    const { nodes } = await protocol.send("Accessibility.getFullAXTree");
    return nodes
      .filter((node) => !node.ignored)
      .map((node) => {
        const properties = Object.fromEntries(node.properties?.map((it) => [it.name, it.value]) ?? []);
        return {
          role: node.role?.value,
          name: node.name?.value,
          value: node.value?.value,
          id: node.backendDOMNodeId,
          active: properties.activedescendant?.relatedNodes?.[0]?.backendDOMNodeId,
        };
      });
  };
  v.seen.tree = await tree();

  const element = (role, name) => v.tab.getByRole(role, { name, exact: true });
  scenes.powered = await page.changed("a slider", () =>
    element("slider", "Power").evaluate((slider) => {
      slider.value = 5;
      slider.dispatchEvent(new Event("input"));
    }),
  );
  const powerIs = async (value) => (await element("slider", "Power").inputValue()) === value;
  await v.until("the slider to say so", () => powerIs("5"));

  // What a screen reader reaches gets the keyboard; the Tab key goes on from there.
  await element("slider", "Power").focus();
  /** The name of the element that the canvas, or the input beside it, says has the keyboard. */
  const focused = async () => {
    const nodes = await tree();
    const active = nodes.find((node) => node.active)?.active;
    return nodes.find((node) => node.id === active)?.name;
  };
  await v.until("the keyboard at the slider", async () => (await focused()) === "Power");
  await v.tab.keyboard.press("Tab");
  v.seen.after_tab = await v.until("the keyboard at the next control", async () => {
    const name = await focused();
    return name !== "Power" && name;
  });
  await v.tab.keyboard.press("Shift+Tab");
  await v.until("the Tab key to go back", async () => (await focused()) === "Power");
  scenes.stepped = await page.changed("an arrow key", () => v.tab.keyboard.press("ArrowRight"));

  const more = element("button", "More");
  await more.evaluate((button) => button.click());
  await v.until("the section to open", async () => (await more.getAttribute("aria-expanded")) === "true");

  scenes.chosen = await page.changed("a scene's button", () =>
    element("button", "Coral reef").evaluate((button) => button.click()),
  );
  await page.settled();
  const download = v.tab.waitForEvent("download");
  await element("button", "Save picture").evaluate((button) => button.click());
  const file = await download;
  await file.saveAs(join(v.out, "saved.png"));
  v.seen.saved = file.suggestedFilename();
});
