// Serves a built folder on a free port of 127.0.0.1, as any static host would.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize, sep } from "node:path";

const MIME = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
};

/** A host may put the page below its top; the page's own addresses have to stand that. */
const BASE = "/shared/page/";

/**
 * Serves `folder`.
 * @param {string} folder
 * @returns {Promise<{address: string, asked: string[], close: () => Promise<void>}>} the page's
 *   address, the files asked for so far, and a way to stop
 */
export async function host(folder) {
  const asked = [];
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://127.0.0.1");
    const name = pathname.startsWith(BASE) ? pathname.slice(BASE.length) || "index.html" : undefined;
    asked.push(name ?? pathname);
    const file = name && normalize(join(folder, name));
    try {
      if (!file?.startsWith(folder + sep)) throw new Error("outside the page");
      const body = await readFile(file);
      response.writeHead(200, { "Content-Type": MIME[extname(file)] ?? "application/octet-stream" });
      response.end(body);
    } catch {
      response.writeHead(404).end("no such file\n");
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return {
    address: `http://127.0.0.1:${server.address().port}${BASE}`,
    asked,
    close: () => new Promise((resolve) => server.close(resolve)),
  };
}
