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

/** Frames that wait for their packets, above which the encoder has to encode them all. */
const MAX_FRAMES_KEPT = 32;

/** New encoders in a row that encode nothing, after which a video fails. */
const MAX_RESTARTS = 3;

/** Seconds between key frames, to which players can jump. */
const KEY_FRAME_SECS = 2;

/** Bytes that are written to the disk at once: some frames of a small video, a part of one of a large video. */
const CHUNK_BYTES = 64 << 10;

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
  /** The frames without a packet so far, each with its number. A new encoder encodes them again. */
  #unencoded = [];
  #packetsWaiting = 0;
  /** The packets on their way to the file, in order. */
  #written = Promise.resolve();
  #isCancelled = false;
  #wakes = [];
  #encoder;
  /** Why the encoder stopped, if it did: browsers take idle encoders back, and hardware fails. */
  #stopReason;
  /** New encoders since the last packet. */
  #restarts = 0;
  #needsKeyFrame = true;
  /** What the packets' decoder has to know, from the first encoder. */
  #description;

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
      write: (chunk) =>
        this.stream.write(chunk).catch((error) => {
          throw new Error(`the file could not be written (${error.message}), so check the free space on the disk`);
        }),
      close: () => (this.#isCancelled ? undefined : this.stream.close()),
    });
  }

  #startEncoder() {
    this.#stopReason = undefined;
    this.#needsKeyFrame = true;
    const encoder = new VideoEncoder({
      output: (chunk, metadata) => {
        if (encoder === this.#encoder) this.#addPacket(chunk, metadata);
      },
      error: (error) => {
        if (encoder !== this.#encoder) return;
        this.#stopReason = error;
        this.#wake();
      },
    });
    this.#encoder = encoder;
    encoder.configure(this.configuration);
    encoder.addEventListener("dequeue", () => this.#wake());
  }

  /** Replaces an encoder that stopped, and encodes again what it left. */
  #restart() {
    if (++this.#restarts > MAX_RESTARTS) {
      throw new Error(`the browser's video encoder stopped (${this.#stopReason.message})`);
    }
    if (this.#encoder.state !== "closed") this.#encoder.close();
    this.#startEncoder();
    for (const kept of this.#unencoded) this.#encode(kept);
  }

  #encode({ frame, number }) {
    const keyFrames = Math.max(1, Math.round(this.framesPerSecond * KEY_FRAME_SECS));
    try {
      this.#encoder.encode(frame, { keyFrame: this.#needsKeyFrame || number % keyFrames === 0 });
      this.#needsKeyFrame = false;
    } catch (error) {
      this.#stopReason ??= error;
    }
  }

  /** Waits until the encoder has encoded all frames that it does not drop. */
  async #flush() {
    const encoder = this.#encoder;
    try {
      await encoder.flush();
      // Those that could not be handed over are encoded again.
      if (!this.#stopReason) this.#forgetFrames();
    } catch (error) {
      this.#stopReason ??= error;
    }
  }

  /** Frees the kept frames: no garbage collector knows how large they are. */
  #forgetFrames() {
    for (const { frame } of this.#unencoded.splice(0)) frame.close();
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
    const bytes = new Uint8Array(chunk.byteLength);
    chunk.copyTo(bytes);
    // The encoder's times are whole microseconds; the frame's number gives the exact time.
    const number = Math.round((chunk.timestamp * this.framesPerSecond) / 1e6);
    const at = this.#unencoded.findIndex((kept) => kept.number === number);
    if (at < 0) return;
    this.#unencoded.splice(at, 1)[0].frame.close();
    this.#restarts = 0;
    this.#packetsWaiting++;
    const [secs, duration] = [number / this.framesPerSecond, 1 / this.framesPerSecond];
    const packet = new EncodedPacket(bytes, chunk.type, secs, duration);
    const { decoderConfig } = metadata ?? {};
    if (decoderConfig) this.#checkDescription(decoderConfig.description);
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

  /** Fails if a new encoder's packets need another decoder than those that the file has. */
  #checkDescription(description) {
    const bytes = description
      ? new Uint8Array(description.buffer ?? description, description.byteOffset ?? 0, description.byteLength)
      : new Uint8Array();
    const text = bytes.join();
    this.#description ??= text;
    if (text !== this.#description) {
      this.#fail(new Error("the browser's video encoder stopped, and its next one writes another kind of video"));
    }
  }

  /**
   * Adds a frame, and waits while the encoder or the disk is behind. One call at a time.
   * @param {Uint8Array} rgb rows of pixels of three bytes
   */
  async add(rgb) {
    toI420(rgb, this.size, this.planes, this.evenSize);
    const [codedWidth, codedHeight] = this.evenSize;
    const micros = (frame) => Math.round((frame * 1e6) / this.framesPerSecond);
    const number = this.#frames++;
    const frame = new VideoFrame(this.planes, {
      format: "I420",
      colorSpace: BT709,
      codedWidth,
      codedHeight,
      timestamp: micros(number),
      duration: micros(1),
    });
    this.#unencoded.push({ frame, number });
    if (!this.#stopReason) this.#encode(this.#unencoded.at(-1));
    const isBehind = () =>
      this.#encoder.encodeQueueSize >= MAX_FRAMES_WAITING || this.#packetsWaiting >= MAX_PACKETS_WAITING;
    while (!this.#failure && !this.#isCancelled) {
      if (this.#stopReason) this.#restart();
      else if (this.#unencoded.length > MAX_FRAMES_KEPT) await this.#flush();
      else if (isBehind()) await new Promise((resolve) => this.#wakes.push(resolve));
      else break;
    }
    if (this.#failure) throw this.#failure;
  }

  /** Ends the file. @returns {Promise<Blob | undefined>} the video, unless it is on the disk */
  async finish() {
    try {
      while (this.#unencoded.length > 0 && !this.#failure) {
        if (this.#stopReason) this.#restart();
        await this.#flush();
      }
      if (this.#encoder.state !== "closed") this.#encoder.close();
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
    this.#forgetFrames();
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
