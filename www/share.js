// The clipboard, the share sheet and small copies, for pictures.

/**
 * Copies a picture to the clipboard. Called within a click, because browsers allow nothing later; the
 * picture itself may come later.
 * @param {Promise<Blob>} picture a PNG
 */
export async function copyPicture(picture) {
  if (!navigator.clipboard?.write || typeof ClipboardItem === "undefined") {
    throw new Error("this browser copies no pictures");
  }
  await navigator.clipboard.write([new ClipboardItem({ "image/png": picture })]);
}

const fileOf = (picture, name) => new File([picture], name, { type: "image/png" });

/** Whether the system has a share sheet that takes pictures. */
export function hasShareSheet() {
  try {
    return Boolean(navigator.canShare?.({ files: [fileOf(new Blob(), "picture.png")] }));
  } catch {
    return false;
  }
}

/**
 * Opens the system's share sheet with a picture. A visitor who closes it again has made no mistake.
 * @param {Promise<Blob>} picture a PNG
 * @param {string} name the file's name
 */
export async function sharePicture(picture, name) {
  try {
    await navigator.share({ files: [fileOf(await picture, name)], title: "Mandelight" });
  } catch (error) {
    if (error?.name !== "AbortError") throw error;
  }
}

/**
 * The middle of a picture as a small JPEG file.
 * @param {Promise<Blob>} picture a PNG
 * @param {number} width of the small picture, in pixels
 * @param {number} height
 * @returns {Promise<Uint8Array>}
 */
export async function smallCopy(picture, width, height) {
  const context = await smallContext(await picture, width, height);
  const file = await context.canvas.convertToBlob({ type: "image/jpeg", quality: 0.75 });
  return new Uint8Array(await file.arrayBuffer());
}

/**
 * A canvas with the middle of a picture, made small.
 * @param {Blob} picture in any format that the browser can decode
 * @param {number} width
 * @param {number} height
 * @returns {Promise<OffscreenCanvasRenderingContext2D>}
 */
export async function smallContext(picture, width, height) {
  const whole = await createImageBitmap(picture);
  const scale = Math.max(width / whole.width, height / whole.height);
  const [w, h] = [whole.width * scale, whole.height * scale];
  const context = new OffscreenCanvas(width, height).getContext("2d");
  context.imageSmoothingQuality = "high";
  context.drawImage(whole, (width - w) / 2, (height - h) / 2, w, h);
  whole.close();
  return context;
}
