// Pictures of a gallery, which may be on another host.

import { smallContext } from "./share.js";

/** Milliseconds until a host that does not answer is given up. */
const TIMEOUT_MS = 60_000;

const UNREACHABLE = "its host can't be reached, or lets no other page read it (CORS)";

/**
 * Reads a file's beginning, without cookies.
 * @param {string} address
 * @param {number} maxBytes how much to read at most
 * @param {boolean} isWhole whether a longer file is an error
 * @returns {Promise<Uint8Array>} rejects with a sentence for the visitor
 */
export async function read(address, maxBytes, isWhole) {
  const signal = AbortSignal.timeout(TIMEOUT_MS);
  const options = { credentials: "omit", referrerPolicy: "no-referrer", signal };
  const response = await fetch(address, options).catch(() => {
    throw new Error(UNREACHABLE);
  });
  if (!response.ok) throw new Error(`its host answers ${response.status}`);
  const parts = [];
  let length = 0;
  const reader = response.body.getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      parts.push(value);
      length += value.length;
      if (length > maxBytes) {
        if (isWhole) throw new Error(`it is larger than ${maxBytes} bytes, the most that is read`);
        break;
      }
    }
  } finally {
    reader.cancel().catch(() => {});
  }
  const bytes = new Uint8Array(Math.min(length, maxBytes));
  let at = 0;
  for (const part of parts) {
    bytes.set(part.subarray(0, maxBytes - at), at);
    at += Math.min(part.length, maxBytes - at);
  }
  return bytes;
}

/** The end of the queue of pictures that are made small: one at a time, for each may take 128 MiB. */
let queue = Promise.resolve();

/**
 * The middle of a picture, made small.
 * @param {Uint8Array} file a picture that the browser can decode
 * @param {number} width
 * @param {number} height
 * @returns {Promise<Uint8ClampedArray>} sRGB and alpha, row by row
 */
export function smallPixels(file, width, height) {
  const make = async () => {
    const context = await smallContext(new Blob([file]), width, height);
    return context.getImageData(0, 0, width, height).data;
  };
  const made = queue.then(make);
  queue = made.catch(() => {});
  return made;
}
