// Transcodes NAME.ktx2 of UASTC HDR with three.js's own transcoder, Basis Universal's in WebAssembly: to half floats, which must be
// NAME.values, what our decoder makes of it, bit for bit; and to BC6H, which becomes NAME.bc6h.ktx2 for our reader. Fails if a
// picture is refused or differs.
//
//     node uastc.mjs FOLDER TRANSCODER      the folder of basis_transcoder.js and .wasm

import { copyFileSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { read, write } from "ktx-parse";

const BC6H = 22, RGBA_HALF = 25;  // of KTX2Loader.js
const VK_BC6H_UFLOAT = 143, MODEL_BC6H = 133, MODEL_UASTC_HDR = 0xa7, VK_ASTC_4X4_SFLOAT = 1000066000, ONE = 0x3c00;

const [folder, transcoder] = process.argv.slice(2);
// It is no module, whatever the package around it says.
const script = join(process.cwd(), "basis_transcoder.cjs");
copyFileSync(join(transcoder, "basis_transcoder.js"), script);
const basis = await createRequire(import.meta.url)(script)({
  wasmBinary: readFileSync(join(transcoder, "basis_transcoder.wasm")) });
basis.initializeBasis();

let wrong = 0;
function fail(text) {
  wrong += 1;
  console.error(text);
}

function transcoded(file, level, layer, face, format) {
  const bytes = new Uint8Array(file.getImageTranscodedSizeInBytes(level, layer, face, format));
  return file.transcodeImage(bytes, level, layer, face, format, 0, -1, -1) ? bytes : null;
}

// Three halves of each texel as they are in NAME.values; alpha is 1.
function differs(bytes, values, at) {
  const halves = new Uint16Array(bytes.buffer);
  for (let i = 0; i < halves.length; ++i) {
    const wanted = i % 4 === 3 ? ONE : values[at + Math.floor(i / 4) * 3 + (i % 4)];
    if (halves[i] !== wanted) return `texel ${Math.floor(i / 4)} channel ${i % 4} is ${halves[i]}, not ${wanted}`;
  }
  return null;
}

function check(name) {
  const bytes = new Uint8Array(readFileSync(join(folder, `${name}.ktx2`)));
  const container = read(bytes), stored = readFileSync(join(folder, `${name}.values`));
  const values = new Uint16Array(stored.buffer.slice(stored.byteOffset, stored.byteOffset + stored.length));
  // What KTX2Loader recognises it by.
  if (container.vkFormat !== VK_ASTC_4X4_SFLOAT || container.dataFormatDescriptor[0].colorModel !== MODEL_UASTC_HDR)
    fail(`${name}: is not what KTX2Loader takes for UASTC HDR`);
  const file = new basis.KTX2File(bytes);
  if (!file.isValid() || !file.isHDR() || !file.startTranscoding()) return fail(`${name}: the transcoder refuses it`);
  const layers = Math.max(1, file.getLayers()), faces = file.getFaces();
  let at = 0;
  for (let level = 0; level < file.getLevels(); ++level) {
    const blocks = [];
    for (let layer = 0; layer < layers; ++layer) {
      for (let face = 0; face < faces; ++face) {
        const place = `${name}: level ${level} layer ${layer} face ${face}`;
        const halves = transcoded(file, level, layer, face, RGBA_HALF);
        const difference = halves === null ? "isn't transcoded to halves" : differs(halves, values, at);
        if (difference !== null) fail(`${place}: ${difference}`);
        at += 3 * Math.max(1, container.pixelWidth >> level) * Math.max(1, container.pixelHeight >> level);
        const bc6h = transcoded(file, level, layer, face, BC6H);
        if (bc6h === null) return fail(`${place}: isn't transcoded to BC6H`);
        blocks.push(bc6h);
      }
    }
    container.levels[level].levelData = Buffer.concat(blocks);
    container.levels[level].uncompressedByteLength = container.levels[level].levelData.length;
  }
  if (at !== values.length) fail(`${name}: has ${at} values, not ${values.length}`);
  container.vkFormat = VK_BC6H_UFLOAT;
  container.supercompressionScheme = 0;
  container.dataFormatDescriptor[0].colorModel = MODEL_BC6H;
  writeFileSync(join(folder, `${name}.bc6h.ktx2`), write(container, { keepWriter: true }));
  file.close();
  file.delete();
}

const names = readdirSync(folder).filter((file) => file.endsWith(".values")).map((file) => file.slice(0, -".values".length));
if (names.length === 0) throw new Error(`no samples in ${folder}`);
for (const name of names) check(name);
console.log(`${names.length} files of UASTC HDR transcoded by three.js's transcoder, ${wrong} differences`);
process.exit(wrong === 0 ? 0 : 1);
