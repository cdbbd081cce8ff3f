// Unpacks a zip of stored (uncompressed) files by PKWARE's APPNOTE 6.3.3, sharing no code with the
// program that writes it.

import { crc32 } from "node:zlib";

const END = 0x06054b50;
const CENTRAL = 0x02014b50;
const LOCAL = 0x04034b50;

/** The files of `zip`, a Buffer, as `[name, bytes]`, in the order of its central directory. */
export function unzipped(zip) {
  let end = zip.length - 22;
  while (end >= 0 && zip.readUInt32LE(end) !== END) end -= 1;
  if (end < 0) throw new Error("no end of the central directory");
  const count = zip.readUInt16LE(end + 10);
  let at = zip.readUInt32LE(end + 16);
  return Array.from({ length: count }, () => {
    if (zip.readUInt32LE(at) !== CENTRAL) throw new Error(`no central directory entry at byte ${at}`);
    const [method, sum] = [zip.readUInt16LE(at + 10), zip.readUInt32LE(at + 16)];
    const [packed, size] = [zip.readUInt32LE(at + 20), zip.readUInt32LE(at + 24)];
    const lengths = [28, 30, 32].map((field) => zip.readUInt16LE(at + field));
    const name = zip.toString("utf8", at + 46, at + 46 + lengths[0]);
    const local = zip.readUInt32LE(at + 42);
    at += 46 + lengths.reduce((sum, length) => sum + length);
    if (method !== 0 || packed !== size) throw new Error(`${name} is compressed (method ${method})`);
    if (zip.readUInt32LE(local) !== LOCAL) throw new Error(`${name} has no local header at byte ${local}`);
    // Readers that cannot seek need the length in the local header too.
    if (zip.readUInt32LE(local + 18) !== size) throw new Error(`${name} has a wrong length in its local header`);
    const start = local + 30 + zip.readUInt16LE(local + 26) + zip.readUInt16LE(local + 28);
    const bytes = zip.subarray(start, start + size);
    if (crc32(bytes) !== sum) throw new Error(`${name} has a wrong CRC-32`);
    return [name, bytes];
  });
}
