// A worker that decodes one file, with an instance and a memory of its own.

import start, { decodeFile } from "./mandelight.js";

/** Sorts what the module throws: a text is about the file, anything else about the program. */
function describe(error) {
  if (typeof error === "string") return { reason: error, kind: "file" };
  // Panics throw their message, so a trap is a refused allocation or a stack without room.
  const isTrap = error instanceof WebAssembly.RuntimeError || error instanceof RangeError;
  return { reason: String(error?.message ?? error), kind: isTrap ? "memory" : "program" };
}

self.addEventListener("message", async ({ data: { module, name, file, fault } }) => {
  try {
    await start({ module_or_path: module });
    const content = decodeFile(name, file, fault);
    self.postMessage({ content }, content.buffers);
  } catch (error) {
    self.postMessage(describe(error));
  }
});
