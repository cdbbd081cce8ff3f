// A static host for a built folder, on a free port of 127.0.0.1. It sends the headers of the folder's `_headers`.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join, normalize, sep } from "node:path";

const MIME = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".png": "image/png",
  ".txt": "text/plain; charset=utf-8",
  ".webmanifest": "application/manifest+json",
};

/** A folder below the root: the page's own URLs must be relative. */
const BASE = "/shared/page/";

/** A folder of pictures on the same host. */
const PICTURES = "/pictures/";

/**
 * The headers that a static host sends.
 * @param {string} folder a built folder with its `_headers`
 * @returns {Promise<(name: string) => Object<string, string>>} the headers of a file, by its path in the folder
 */
async function headersOf(folder) {
  const rules = {};
  let rule;
  for (const line of (await readFile(join(folder, "_headers"), "utf8")).trimEnd().split("\n")) {
    const [, header, value] = /^ +([^:]+): (.+)$/.exec(line) ?? [];
    if (line.startsWith("/")) rule = rules[line] = {};
    else if (header && rule) rule[header] = value;
    else throw new Error(`_headers: "${line}" is neither a path nor a header`);
  }
  return (name) => ({ ...rules["/*"], ...rules[`/${name}`] });
}

/**
 * Serves `folder`, and `pictures` beside it.
 * @param {string} folder
 * @param {string} [pictures]
 * @returns {Promise<{address: string, requests: string[], isDown: boolean, moved: Object<string, string?>, edits: Object<string, (text: string) => string>, close: () => Promise<void>}>}
 *   the page's address; the files requested so far; whether it refuses connections; the files that stand for
 *   others, by the requested names, null for none; edits of files, by the requested names; a function that stops
 *   the host
 */
export async function host(folder, pictures) {
  const headers = await headersOf(folder);
  const requests = [];
  const state = { isDown: false, moved: {}, edits: {} };
  const server = createServer(async (request, response) => {
    if (state.isDown) return request.socket.destroy();
    const { pathname } = new URL(request.url, "http://127.0.0.1");
    const name = pathname.startsWith(BASE) ? pathname.slice(BASE.length) || "index.html" : undefined;
    requests.push(name ?? pathname);
    const isPicture = pictures && pathname.startsWith(PICTURES);
    const root = isPicture ? pictures : folder;
    const below = isPicture ? decodeURIComponent(pathname.slice(PICTURES.length)) : name in state.moved ? state.moved[name] : name;
    const file = below && normalize(join(root, below));
    try {
      if (!file?.startsWith(root + sep)) throw new Error("outside the folder");
      const body = await readFile(file);
      response.writeHead(200, {
        "Content-Type": MIME[extname(file)] ?? "application/octet-stream",
        ...(isPicture ? {} : headers(name)),
      });
      response.end(state.edits[name]?.(body.toString()) ?? body);
    } catch {
      response.writeHead(404).end("no such file\n");
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return Object.assign(state, {
    address: `http://127.0.0.1:${server.address().port}${BASE}`,
    requests,
    close: () => new Promise((resolve) => server.close(resolve)),
  });
}
