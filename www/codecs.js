// The video codecs of the browser: which of them encode a video, and their configurations.
//
// Small, because the page loads it before it offers videos; video.js and the muxer come with the first video.

/** Longest side in pixels. (Chromium's page crashes when it is asked about sides of 20,000.) */
const MAX_SIDE_PX = 8192;

/** Bits for each pixel of a frame: fractals are full of detail, on which sparing shows. */
const BITS_PER_PIXEL = 0.25;

// The levels of each codec: its code, the largest frame, the most per second, and the most kbit/s.
// ITU-T H.264, table A-1: in macroblocks of 16×16 pixels.
const H264_LEVELS = [
  [10, 99, 1485, 64],
  [11, 396, 3000, 192],
  [12, 396, 6000, 384],
  [13, 396, 11880, 768],
  [20, 396, 11880, 2000],
  [21, 792, 19800, 4000],
  [22, 1620, 20250, 4000],
  [30, 1620, 40500, 10000],
  [31, 3600, 108000, 14000],
  [32, 5120, 216000, 20000],
  [40, 8192, 245760, 20000],
  [41, 8192, 245760, 50000],
  [42, 8704, 522240, 50000],
  [50, 22080, 589824, 135000],
  [51, 36864, 983040, 240000],
  [52, 36864, 2073600, 240000],
  [60, 139264, 4177920, 240000],
  [61, 139264, 8355840, 480000],
  [62, 139264, 16711680, 800000],
];
// WebM's list of VP9 levels: in pixels.
const VP9_LEVELS = [
  [10, 36864, 829440, 200],
  [11, 73728, 2764800, 800],
  [20, 122880, 4608000, 1800],
  [21, 245760, 9216000, 3600],
  [30, 552960, 20736000, 7200],
  [31, 983040, 36864000, 12000],
  [40, 2228224, 83558400, 18000],
  [41, 2228224, 160432128, 30000],
  [50, 8912896, 311951360, 60000],
  [51, 8912896, 588251136, 120000],
  [52, 8912896, 1176502272, 180000],
  [60, 35651584, 1176502272, 180000],
  [61, 35651584, 2353004544, 240000],
  [62, 35651584, 4706009088, 480000],
];
// AV1 specification, annex A.3: in pixels.
const AV1_LEVELS = [
  [0, 147456, 4423680, 1500],
  [1, 278784, 8363520, 3000],
  [4, 665856, 19975680, 6000],
  [5, 1065024, 31950720, 10000],
  [8, 2359296, 70778880, 12000],
  [9, 2359296, 141557760, 20000],
  [12, 8912896, 267386880, 30000],
  [13, 8912896, 534773760, 40000],
  [14, 8912896, 1069547520, 60000],
  [16, 35651584, 1069547520, 60000],
  [17, 35651584, 2139095040, 100000],
  [18, 35651584, 4278190080, 160000],
];

/** The lowest level that is enough; undefined where none is. */
function levelOf(levels, frame, rate, bitrate) {
  const level = levels.find(
    ([, maxFrame, perSecond, kbits]) =>
      frame <= maxFrame && frame * rate <= perSecond && bitrate <= 1000 * kbits,
  );
  return level?.[0];
}

const twoDigits = (number, radix) => number.toString(radix).toUpperCase().padStart(2, "0");

/** The codecs to try for a file, the most playable first: Mediabunny's name and the browser's. */
function codecsOf({ container, width, height, framesPerSecond, bitrate }) {
  const codecs = [];
  const pixels = width * height;
  if (container === "mp4") {
    const [across, down] = [width, height].map((side) => Math.ceil(side / 16));
    // No side may be longer than the square root of eight times the largest frame.
    const levels = H264_LEVELS.filter(([, maxFrame]) => Math.max(across, down) ** 2 <= 8 * maxFrame);
    const h264 = levelOf(levels, across * down, framesPerSecond, bitrate);
    if (h264) {
      // The profiles High, Main and Constrained Baseline.
      for (const profile of ["6400", "4D00", "42E0"]) {
        codecs.push(["avc", `avc1.${profile}${twoDigits(h264, 16)}`]);
      }
    }
    const av1 = levelOf(AV1_LEVELS, pixels, framesPerSecond, bitrate);
    if (av1 !== undefined) codecs.push(["av1", `av01.0.${twoDigits(av1, 10)}M.08`]);
  }
  const vp9 = levelOf(VP9_LEVELS, pixels, framesPerSecond, bitrate);
  // 8 bits, 4:2:0, BT.709, limited range.
  if (vp9) codecs.push(["vp9", `vp09.00.${twoDigits(vp9, 10)}.08.01.01.01.01.00`]);
  if (container === "webm") codecs.push(["vp8", "vp8"]);
  return codecs;
}

/**
 * The first codec of a container that the browser encodes: its name and the encoder's configuration.
 * @param {"mp4" | "webm"} container
 * @param {number} frameWidth in pixels; the video's size is rounded up to even numbers
 * @param {number} frameHeight
 * @param {number} framesPerSecond
 */
export async function chooseCodec(container, frameWidth, frameHeight, framesPerSecond) {
  if (!isSupported()) throw new Error("this browser does not encode videos");
  if (Math.max(frameWidth, frameHeight) > MAX_SIDE_PX) {
    throw new Error(`videos have at most ${MAX_SIDE_PX} pixels a side`);
  }
  const [width, height] = [frameWidth, frameHeight].map((side) => side + (side % 2));
  const bitrate = Math.round(BITS_PER_PIXEL * width * height * framesPerSecond);
  for (const [name, codec] of codecsOf({ container, width, height, framesPerSecond, bitrate })) {
    const configuration = {
      codec,
      width,
      height,
      framerate: framesPerSecond,
      bitrate,
      bitrateMode: "variable",
      latencyMode: "quality",
      alpha: "discard",
      // The form that MP4 stores.
      ...(name === "avc" ? { avc: { format: "avc" } } : {}),
    };
    try {
      const { supported } = await VideoEncoder.isConfigSupported(configuration);
      if (supported) return { name, configuration };
    } catch {
      // A browser that does not know the codec's name.
    }
  }
  throw new Error(`this browser encodes no ${container} videos of ${frameWidth} × ${frameHeight} pixels`);
}

/** Whether this browser encodes videos of any kind. */
export function isSupported() {
  return typeof VideoEncoder !== "undefined" && typeof VideoFrame !== "undefined";
}

/**
 * Whether the browser encodes videos of a container.
 * @param {"mp4" | "webm"} container
 * @param {number} width of the frames in pixels
 * @param {number} height
 * @param {number} framesPerSecond
 */
export function canEncode(container, width, height, framesPerSecond) {
  return chooseCodec(container, width, height, framesPerSecond).then(() => true, () => false);
}
