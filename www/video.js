// Videos: frames to an MP4 or WebM file, by the browser's encoder (WebCodecs) and Mediabunny's muxer.
//
// Loaded when first used. A video goes to a file on the disk while it is made, where the browser can
// write one, else to memory.

import {
  BufferTarget,
  EncodedPacket,
  EncodedVideoPacketSource,
  Mp4OutputFormat,
  Output,
  StreamTarget,
  WebMOutputFormat,
} from "./mediabunny.js";
import { chooseCodec } from "./codecs.js";

/** Frames in the encoder, and packets on their way to the file, above which `add` waits. */
const MAX_FRAMES_WAITING = 4;
const MAX_PACKETS_WAITING = 8;

/** Seconds between key frames, to which players can jump. */
const KEY_FRAME_SECS = 2;

/** Bytes that are written to the disk at once. */
const CHUNK_BYTES = 4 << 20;

/** The colours of HDTV, ITU-R BT.709: what players assume that do not read what a file says. */
const BT709 = { primaries: "bt709", transfer: "bt709", matrix: "bt709", fullRange: false };

/**
 * Converts sRGB to I420 in BT.709's limited range: planes of luma, and of two colour differences at half
 * the resolution. (A browser that is given RGB encodes full range, which many players show too dark.)
 * @param {Uint8Array} rgb rows of `width` pixels of three bytes
 * @param {Uint8Array} planes of an even size; last rows and columns are repeated up to it
 */
function toI420(rgb, [width, height], planes, [evenWidth, evenHeight]) {
  const half = evenWidth / 2;
  const blueAt = evenWidth * evenHeight;
  const redAt = blueAt + half * (evenHeight / 2);
  const lumaAt = (from, to) => {
    const [red, green, blue] = [rgb[from], rgb[from + 1], rgb[from + 2]];
    // 65536 × 219/255 × (0.2126, 0.7152, 0.0722), and 16.5.
    planes[to] = (11966 * red + 40254 * green + 4064 * blue + 1081344) >> 16;
  };
  for (let y = 0; y < evenHeight; y += 2) {
    const rows = [y, Math.min(y + 1, height - 1)].map((row) => 3 * width * row);
    for (let x = 0; x < evenWidth; x += 2) {
      const [left, right] = [3 * x, 3 * Math.min(x + 1, width - 1)];
      const [a, b, c, d] = [rows[0] + left, rows[0] + right, rows[1] + left, rows[1] + right];
      const at = y * evenWidth + x;
      lumaAt(a, at);
      lumaAt(b, at + 1);
      lumaAt(c, at + evenWidth);
      lumaAt(d, at + evenWidth + 1);
      const red = rgb[a] + rgb[b] + rgb[c] + rgb[d];
      const green = rgb[a + 1] + rgb[b + 1] + rgb[c + 1] + rgb[d + 1];
      const blue = rgb[a + 2] + rgb[b + 2] + rgb[c + 2] + rgb[d + 2];
      // Of sums of four pixels: 65536 × 224/255 × the differences, and 128.5.
      const chroma = (y / 2) * half + x / 2;
      planes[blueAt + chroma] = (-6596 * red - 22189 * green + 28784 * blue + 33685504) >> 18;
      planes[redAt + chroma] = (28784 * red - 26145 * green - 2639 * blue + 33685504) >> 18;
    }
  }
}

/** A video that is being made. */
class Video {
  /** The first failure; everything that waits ends by it. */
  #failure;
  #frames = 0;
  #packets = 0;
  #packetsWaiting = 0;
  /** The packets on their way to the file, in order. */
  #written = Promise.resolve();
  #isCancelled = false;
  #wakes = [];
  #encoder;
  /** Whether the browser took the encoder back, which it does with idle ones. */
  #isReclaimed = false;

  constructor({ name, configuration }, { container, size, framesPerSecond, stream }) {
    this.size = size;
    this.evenSize = [configuration.width, configuration.height];
    this.planes = new Uint8Array((configuration.width * configuration.height * 3) / 2);
    this.framesPerSecond = framesPerSecond;
    this.configuration = configuration;
    this.stream = stream;
    this.mediaType = `video/${container}`;
    this.target = stream ? new StreamTarget(this.#sink(), { chunked: true, chunkSize: CHUNK_BYTES }) : new BufferTarget();
    const fastStart = stream ? false : "in-memory";
    const format = container === "mp4" ? new Mp4OutputFormat({ fastStart }) : new WebMOutputFormat();
    this.output = new Output({ format, target: this.target });
    this.source = new EncodedVideoPacketSource(name);
    this.output.addVideoTrack(this.source, { frameRate: framesPerSecond });
  }

  async start() {
    await this.output.start();
    this.#startEncoder();
    return this;
  }

  /** The file's stream. A cancelled output closes it, which would keep half a video. */
  #sink() {
    return new WritableStream({
      write: (chunk) => this.stream.write(chunk),
      close: () => (this.#isCancelled ? undefined : this.stream.close()),
    });
  }

  #startEncoder() {
    this.#isReclaimed = false;
    this.#encoder = new VideoEncoder({
      output: (chunk, metadata) => this.#addPacket(chunk, metadata),
      error: (error) => {
        if (error.name === "QuotaExceededError" && this.#packets === this.#frames) {
          this.#isReclaimed = true;
          this.#wake();
        } else {
          this.#fail(error);
        }
      },
    });
    this.#encoder.configure(this.configuration);
    this.#encoder.addEventListener("dequeue", () => this.#wake());
  }

  #wake() {
    const wakes = this.#wakes;
    this.#wakes = [];
    for (const wake of wakes) wake();
  }

  #fail(error) {
    this.#failure ??= error instanceof Error ? error : new Error(String(error));
    this.#wake();
  }

  #addPacket(chunk, metadata) {
    this.#packets++;
    this.#packetsWaiting++;
    const bytes = new Uint8Array(chunk.byteLength);
    chunk.copyTo(bytes);
    // The encoder's times are whole microseconds; the frame's number gives the exact time.
    const frame = Math.round((chunk.timestamp * this.framesPerSecond) / 1e6);
    const [secs, duration] = [frame / this.framesPerSecond, 1 / this.framesPerSecond];
    const packet = new EncodedPacket(bytes, chunk.type, secs, duration);
    const { decoderConfig } = metadata ?? {};
    // Some browsers leave out what the frames said of their colours.
    const described = decoderConfig && { decoderConfig: { ...decoderConfig, colorSpace: BT709 } };
    this.#written = this.#written
      .then(() => (this.#failure ? undefined : this.source.add(packet, described)))
      .catch((error) => this.#fail(error))
      .finally(() => {
        this.#packetsWaiting--;
        this.#wake();
      });
  }

  /**
   * Adds a frame, and waits while the encoder or the disk is behind. One call at a time.
   * @param {Uint8Array} rgb rows of pixels of three bytes
   */
  async add(rgb) {
    if (this.#failure) throw this.#failure;
    const isRestarted = this.#isReclaimed;
    if (isRestarted) this.#startEncoder();
    toI420(rgb, this.size, this.planes, this.evenSize);
    const [codedWidth, codedHeight] = this.evenSize;
    const micros = (frame) => Math.round((frame * 1e6) / this.framesPerSecond);
    const frame = new VideoFrame(this.planes, {
      format: "I420",
      colorSpace: BT709,
      codedWidth,
      codedHeight,
      timestamp: micros(this.#frames),
      duration: micros(1),
    });
    const keyFrames = Math.max(1, Math.round(this.framesPerSecond * KEY_FRAME_SECS));
    try {
      this.#encoder.encode(frame, { keyFrame: isRestarted || this.#frames % keyFrames === 0 });
    } finally {
      // A frame holds memory that no garbage collector knows of.
      frame.close();
    }
    this.#frames++;
    const isBehind = () =>
      this.#encoder.encodeQueueSize >= MAX_FRAMES_WAITING || this.#packetsWaiting >= MAX_PACKETS_WAITING;
    while (!this.#failure && !this.#isCancelled && !this.#isReclaimed && isBehind()) {
      await new Promise((resolve) => this.#wakes.push(resolve));
    }
    if (this.#failure) throw this.#failure;
  }

  /** Ends the file. @returns {Promise<Blob | undefined>} the video, unless it is on the disk */
  async finish() {
    try {
      if (!this.#isReclaimed) {
        await this.#encoder.flush();
        this.#encoder.close();
      }
      await this.#written;
      if (this.#failure) throw this.#failure;
      this.source.close();
      await this.output.finalize();
    } catch (error) {
      await this.cancel();
      throw this.#failure ?? error;
    }
    return this.stream ? undefined : new Blob([this.target.buffer], { type: this.mediaType });
  }

  /** Stops, and leaves nothing on the disk. */
  async cancel() {
    if (this.#isCancelled) return;
    this.#isCancelled = true;
    this.#wake();
    if (this.#encoder.state !== "closed") this.#encoder.close();
    await this.#written;
    await this.output.cancel().catch(() => {});
    await this.stream?.abort().catch(() => {});
  }
}

/**
 * Starts a video.
 * @param {"mp4" | "webm"} container
 * @param {number} width of the frames in pixels; the video's size is rounded up to even numbers
 * @param {number} height
 * @param {number} framesPerSecond
 * @param {FileSystemWritableFileStream} [stream] the file to write; without it, to memory
 * @returns {Promise<Video>}
 */
export async function open(container, width, height, framesPerSecond, stream) {
  const codec = await chooseCodec(container, width, height, framesPerSecond);
  return new Video(codec, { container, size: [width, height], framesPerSecond, stream }).start();
}
