// A visit that compiles the shaders of formulas with the browser's own compiler.

import { readdir, readFile } from "node:fs/promises";
import { join } from "node:path";
import { visit } from "./visit.mjs";

await visit({ context: { viewport: { width: 640, height: 400 } } }, async (v) => {
  await v.tab.goto(v.address);
  v.seen.compiled = {};
  const folder = process.env.MANDELIGHT_SHADERS;
  for (const file of (await readdir(folder)).sort()) {
    const code = await readFile(join(folder, file), "utf8");
    // The first complaint of the compiler or of the pipeline, or an empty text.
    v.seen.compiled[file] = await v.timed(file, () =>
      v.tab.evaluate(async (code) => {
        window.testDevice ??= await (await navigator.gpu.requestAdapter()).requestDevice();
        const device = window.testDevice;
        device.pushErrorScope("validation");
        const module = device.createShaderModule({ code });
        const { messages } = await module.getCompilationInfo();
        const wrong = messages.find((message) => message.type === "error");
        if (!wrong) {
          const compute = { module, entryPoint: "main" };
          await device.createComputePipelineAsync({ layout: "auto", compute }).catch(() => {});
        }
        const error = await device.popErrorScope();
        return wrong ? `${wrong.lineNum}: ${wrong.message}` : (error?.message ?? "");
      }, code),
    );
  }
});
