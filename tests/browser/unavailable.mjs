// Visits where the page cannot draw: it must show a notice and load no module.

import { visit } from "./visit.mjs";

await visit({ gpu: false, context: { viewport: { width: 1280, height: 720 } } }, async (v) => {
  // A browser with WebGPU and without a GPU.
  await v.tab.goto(v.address);
  v.seen.without_gpu = await v.finalNotice();

  // A browser without WebGPU.
  await v.tab.addInitScript(() => {
    Object.defineProperty(navigator, "gpu", { value: undefined, configurable: true });
  });
  await v.tab.reload();
  v.seen.without_webgpu = await v.finalNotice();
  await v.screenshot("without-webgpu-1280x720");
  await v.tab.setViewportSize({ width: 390, height: 844 });
  await v.screenshot("without-webgpu-390x844");

  // The notice's button loads the page again.
  const loaded = v.tab.waitForEvent("load");
  await v.tab.click("#notice-again");
  await loaded;
  v.seen.again = await v.finalNotice();
});
