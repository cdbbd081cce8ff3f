// Decodes files apart from the page: each in a worker of its own, which ends with the file.

/** The worker at work, with the function that ends it; one at a time. */
let current = null;

/**
 * Decodes a file in a new worker. The file before it is given up, if it is still being decoded.
 * @param {WebAssembly.Module} module the page's compiled module
 * @param {string} name the file's name
 * @param {Blob} file
 * @param {{secs: number, mebibytes: number, fault?: string}} limits of time and, for the message, of
 *   memory; `fault`: how the worker fails, for tests
 * @returns {Promise<object>} what the module's `decodeFile` returns; rejects with a sentence for the visitor
 */
export function decode(module, name, file, { secs, mebibytes, fault }) {
  cancel();
  return new Promise((resolve, reject) => {
    const worker = new Worker(new URL("./decoder-worker.js", import.meta.url), { type: "module" });
    const end = (settle, result) => {
      clearTimeout(timer);
      // Its memory goes with it.
      worker.terminate();
      if (current?.worker === worker) current = null;
      settle(result);
    };
    const fail = (reason) => end(reject, new Error(reason));
    const timer = setTimeout(() => fail(`reading it takes more than ${secs} seconds`), 1000 * secs);
    worker.onmessage = ({ data: { content, reason, kind } }) => {
      if (content) end(resolve, content);
      else if (kind === "memory") {
        fail(`reading it takes more memory than a file may use (${mebibytes} MiB)`);
      } else if (kind === "program") {
        fail(`reading it ended with an error of the program; your scene is unchanged (${reason})`);
      } else fail(reason);
    };
    // The worker itself did not start, or the browser ended it.
    worker.onerror = (event) => {
      event.preventDefault();
      fail("the part of the page that reads files did not start; reload the page, then try again");
    };
    current = { worker, end: () => fail("it was cancelled") };
    worker.postMessage({ module, name, file, fault });
  });
}

/** Ends the worker at work. */
export function cancel() {
  current?.end();
}
