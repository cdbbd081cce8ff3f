// Bundles the part of Mediabunny that the page uses: `node mediabunny.mjs OUTPUT`.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { buildSync } from "esbuild";

const NAMES = [
  "BufferTarget",
  "EncodedPacket",
  "EncodedVideoPacketSource",
  "Mp4OutputFormat",
  "Output",
  "StreamTarget",
  "WebMOutputFormat",
];

const modules = fileURLToPath(new URL("../node_modules", import.meta.url));
const { version, license } = JSON.parse(readFileSync(join(modules, "mediabunny/package.json")));
const source = `https://github.com/Vanilagy/mediabunny/tree/v${version}`;

buildSync({
  stdin: { contents: `export { ${NAMES.join(", ")} } from "mediabunny";`, resolveDir: modules },
  outfile: process.argv[2],
  bundle: true,
  format: "esm",
  platform: "browser",
  target: "es2022",
  minify: true,
  legalComments: "none",
  banner: { js: `/*! Parts of Mediabunny ${version}, ${license}; its source: ${source} */` },
});
