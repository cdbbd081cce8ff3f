// A visit with a camera path: scrub it, play it, and save its frames, as videos and as pictures; first as
// downloads, then through the browser's save dialogue, for which a mock stands here. Last, a turntable.

import { readFile, writeFile } from "node:fs/promises";
import { join } from "node:path";
import { Mandelight } from "./mandelight.mjs";
import { unzipped } from "./unzip.mjs";
import { visit } from "./visit.mjs";

await visit({ context: { viewport: { width: 720, height: 420 } } }, async (v) => {
  const page = new Mandelight(v);
  const scenes = (v.seen.scenes = {});
  const document = process.env.MANDELIGHT_PATH;

  // Without the save dialogue, the zip is a download.
  await v.tab.addInitScript(() => {
    if (new URLSearchParams(location.search).has("dialogue")) return;
    window.showSaveFilePicker = undefined;
  });
  await page.open();
  await page.show(document);
  const press = async (name) => v.tab.mouse.click(...(await page.middle(name)));
  await press("panel toggle");
  await press("timeline toggle");
  const track = await page.rested("the track", () => page.rect("timeline track"));
  await v.screenshot("timeline-720x420");

  scenes.scrubbed = await page.changed("scrubbing", () =>
    page.drag([track.x + 20, track.y + 6], [track.width / 8, 0]),
  );
  await page.settled();
  const played = async () => (await page.scene()) !== scenes.scrubbed;
  await press("play");
  await v.until("the path to play", played);
  await press("play");
  await page.rested("the scene after playing", () => page.scene());

  // The three kinds of file, chosen from a menu.
  const choose = async (name) => {
    await press("kind of file");
    const entry = v.tab.getByRole("button", { name, exact: true });
    await entry.evaluate((button) => button.click());
    await v.until(`the choice of ${name}`, async () => (await entry.count()) === 0);
  };
  const muxers = () => v.server.requests.filter((name) => name.startsWith("mediabunny-")).length;
  v.seen.muxers = [muxers()];
  v.seen.video_names = [await page.keepDownload("video.mp4", "save sequence")];
  v.seen.muxers.push(muxers());
  await choose("WebM");
  v.seen.video_names.push(await page.keepDownload("video.webm", "save sequence"));
  await choose("PNGs");
  v.seen.name = await page.keepDownload("frames.zip", "save sequence");
  v.seen.frames = await keepFrames(v, "frames.zip", "frames");

  // An encoder that is taken away with two frames, once; the next one encodes them again.
  await v.tab.evaluate(() => {
    window.faultyEncoders = 1;
    window.VideoEncoder = class extends VideoEncoder {
      #error;
      #isFaulty = window.faultyEncoders-- > 0;
      #taken = 0;
      #rejects = [];
      constructor(callbacks) {
        super(callbacks);
        this.#error = callbacks.error;
      }
      encode(frame, options) {
        if (!this.#isFaulty) return super.encode(frame, options);
        if (++this.#taken === 2) setTimeout(() => this.#takeAway());
      }
      flush() {
        if (!this.#isFaulty) return super.flush();
        return new Promise((_, reject) => this.#rejects.push(reject));
      }
      #takeAway() {
        this.close();
        for (const reject of this.#rejects) reject(new DOMException("closed", "AbortError"));
        this.#error(new DOMException("taken away", "QuotaExceededError"));
      }
    };
  });
  await choose("MP4");
  v.seen.video_names.push(await page.keepDownload("resumed.mp4", "save sequence"));
  v.seen.faulty_left = await v.tab.evaluate(() => window.faultyEncoders);

  // If all encoders are taken away, the message says what to do.
  await v.tab.evaluate(() => (window.faultyEncoders = Infinity));
  await press("save sequence");
  v.seen.failed = await page.says(
    "The video could not be saved: the browser's video encoder stopped (taken away). " +
      "Save it again, in a smaller size or as PNGs, which need no encoder.");

  // Where the browser has no encoder, it is asked before the choice, and PNGs are all it offers.
  await v.tab.evaluate(() => (window.VideoEncoder = undefined));
  await v.tab.setViewportSize({ width: 700, height: 420 });
  v.seen.substitute = await page.says("Save frames");
  await press("kind of file");
  v.seen.reason = await page.says("This browser cannot encode videos.");
  await v.screenshot("no-encoder-700x420");
  v.seen.offered = await Promise.all(["MP4", "WebM", "PNGs"].map((name) =>
    v.tab.getByRole("button", { name, exact: true }).count()));
  await v.tab.keyboard.press("Escape");
  await choose("PNGs");
  await v.tab.setViewportSize({ width: 720, height: 420 });

  // With the save dialogue, the zip is written frame by frame.
  await v.tab.addInitScript(() => {
    window.written = [];
    window.fileIsClosed = false;
    if (!new URLSearchParams(location.search).has("dialogue")) return;
    window.showSaveFilePicker = async (options) => {
      window.suggested = options.suggestedName;
      return {
        createWritable: async () => ({
          write: async (chunk) => {
            // Videos are written in places, zips in a row.
            const { data = chunk, position } = chunk;
            window.written.push([Array.from(data), position, window.framesEncoded]);
          },
          close: async () => void (window.fileIsClosed = true),
          abort: async () => void (window.isAborted = true),
        }),
        remove: async () => void (window.isRemoved = true),
      };
    };
  });
  v.address = v.address.replace(/\/?$/, "/");
  await v.tab.goto("about:blank");
  await v.tab.goto(`${v.address}?test&dialogue`);
  await page.firstPicture();
  await page.settled();
  const written = async (name) => {
    await press("save sequence");
    await v.until("the file to be closed", () => v.tab.evaluate(() => window.fileIsClosed));
    const pieces = await v.tab.evaluate(() => {
      window.fileIsClosed = false;
      return window.written.splice(0);
    });
    v.seen.writes = pieces.map(([{ length: bytes }, , frames]) => ({ bytes, frames }));
    let file = Buffer.alloc(0);
    for (const [bytes, position] of pieces) {
      const at = position ?? file.length;
      const grown = Buffer.alloc(Math.max(file.length, at + bytes.length));
      file.copy(grown);
      Buffer.from(bytes).copy(grown, at);
      file = grown;
    }
    await writeFile(join(v.out, name), file);
    return v.tab.evaluate(() => window.suggested);
  };
  v.seen.suggested = await written("streamed.zip");
  v.seen.streamed = await keepFrames(v, "streamed.zip", "streamed");
  await choose("MP4");

  // A cancelled video leaves no file, and the next one is whole.
  await v.tab.evaluate(() => {
    window.encoders = [];
    window.framesEncoded = 0;
    window.VideoEncoder = class extends VideoEncoder {
      constructor(callbacks) {
        super(callbacks);
        window.encoders.push(this);
      }
      encode(frame, options) {
        window.framesEncoded++;
        super.encode(frame, options);
      }
    };
  });
  await press("save sequence");
  await v.until("an encoder", () => v.tab.evaluate(() => window.encoders.length > 0));
  await press("cancel export");
  await page.says("Saving was cancelled.");
  v.seen.cancelled = await v.until("the file to be removed", () => v.tab.evaluate(() =>
    window.isAborted && window.isRemoved && {
      isClosed: window.fileIsClosed,
      encoders: window.encoders.map((encoder) => encoder.state),
    }));
  await v.tab.evaluate(() => void window.written.splice(0));
  v.seen.video_names.push(await written("streamed.mp4"));

  // A turntable: the file grows while frames are rendered, and the interface says how long that takes.
  await page.changed("the frame rate", () => v.tab.evaluate(() => {
    const document = JSON.parse(window.mandelight.scene());
    document.path.frames_per_second = 1;
    window.mandelight.setScene(JSON.stringify(document));
  }));
  await page.changed("the turntable", () =>
    v.tab.getByRole("button", { name: "Turntable", exact: true }).evaluate((button) => button.click()));
  await v.tab.evaluate(() => {
    window.framesEncoded = 0;
    window.timesLeft = new Set();
    const texts = document.getElementById("accessible-page");
    new MutationObserver(() => {
      for (const { textContent } of texts.children) {
        if (/^Saving, .+ left$/.test(textContent)) window.timesLeft.add(textContent);
      }
    }).observe(texts, { childList: true, characterData: true, subtree: true });
  });
  scenes.turntable = await page.scene();
  await written("turntable.mp4");
  v.seen.frames_encoded = await v.tab.evaluate(() => window.framesEncoded);
  v.seen.times_left = await v.tab.evaluate(() => [...window.timesLeft]);
});

/** Unpacks a zip into files with `prefix`, and returns their names in the zip. */
async function keepFrames(v, zip, prefix) {
  const files = unzipped(await readFile(join(v.out, zip)));
  for (const [name, bytes] of files) await writeFile(join(v.out, `${prefix}-${name}`), bytes);
  return files.map(([name]) => name);
}
