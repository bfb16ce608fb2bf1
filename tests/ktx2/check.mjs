// Reads NAME.ktx2 with ktx-parse and zstddec, and compares header, data format descriptor, keys and every value with NAME.json,
// which says what was written. Prints a line of facts for each file, then what is wrong; fails if anything is. Each file is written
// again by ktx-parse as NAME.again.ktx2, uncompressed, for our reader.
//
//     node check.mjs FOLDER

import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { read, write } from "ktx-parse";
import { ZSTDDecoder } from "zstddec";

// Numbers of the Khronos Data Format Specification 1.3 (khr_df.h) and of Vulkan.
const MODEL_RGBSDA = 1, PRIMARIES_BT709 = 1, TRANSFER_LINEAR = 1, PREMULTIPLIED = 1, VERSION_1_3 = 2;
const EXPONENT = 0x20, SIGNED = 0x40, FLOAT = 0x80, ALPHA = 15;
const ONE = 0x3f800000, MINUS_ONE = 0xbf800000 | 0;
const SCHEMES = { none: 0, zstd: 2 };

const sample = (bitOffset, bits, channelType, sampleLower, sampleUpper) =>
  ({ bitOffset, bitLength: bits - 1, channelType, samplePosition: [0, 0, 0, 0], sampleLower, sampleUpper });
const rgba = (bits) =>
  [0, 1, 2, ALPHA].map((channel, i) => sample(i * bits, bits, channel | FLOAT | SIGNED, MINUS_ONE, ONE));
const sharedExponent = [0, 1, 2].flatMap((channel) =>
  [sample(9 * channel, 9, channel, 0, 8448), sample(27, 5, channel | EXPONENT, 15, 31)]);

// How far a stored value may be from x: half a step of the mantissa, or of the smallest step there is.
const near = (bits, least) => (x) => Math.max(Math.abs(x) * 2 ** -(bits + 1), 2 ** -(least + 1));

const TYPES = {
  float: {
    vkFormat: 109, typeSize: 4, bytes: 16, samples: rgba(32),
    decode: (view, at) => [0, 4, 8, 12].map((i) => view.getFloat32(at + i, true)),
    tolerance: () => () => 0,
  },
  half: {
    vkFormat: 97, typeSize: 2, bytes: 8, samples: rgba(16),
    decode: (view, at) => [0, 2, 4, 6].map((i) => smallFloat(view.getUint16(at + i, true), 10)),
    tolerance: () => near(10, 24),
  },
  rgb9e5: {
    vkFormat: 123, typeSize: 4, bytes: 4, samples: sharedExponent,
    decode: (view, at) => {
      const texel = view.getUint32(at, true);
      const scale = 2 ** ((texel >>> 27) - 15 - 9);
      return [0, 9, 18].map((shift) => ((texel >>> shift) & 511) * scale);
    },
    // Nine bits of the largest of the three.
    tolerance: (rgb) => () => near(8, 24)(Math.max(...rgb)),
  },
  r11g11b10: {
    vkFormat: 122, typeSize: 4, bytes: 4,
    samples: [sample(0, 11, FLOAT, 0, ONE), sample(11, 11, 1 | FLOAT, 0, ONE), sample(22, 10, 2 | FLOAT, 0, ONE)],
    decode: (view, at) => {
      const texel = view.getUint32(at, true);
      return [smallFloat(texel & 0x7ff, 6), smallFloat((texel >>> 11) & 0x7ff, 6), smallFloat(texel >>> 22, 5)];
    },
    tolerance: () => (x, channel) => (channel < 2 ? near(6, 20) : near(5, 19))(x),
  },
};

// A float of a 5-bit exponent and `bits` of mantissa, with a sign above if there is one.
function smallFloat(stored, bits) {
  const mantissa = (stored & (2 ** bits - 1)) / 2 ** bits, exponent = (stored >>> bits) & 31;
  const sign = stored >>> (bits + 5) ? -1 : 1;
  if (exponent === 31) return mantissa === 0 ? sign * Infinity : NaN;
  return sign * (exponent === 0 ? mantissa * 2 ** -14 : (1 + mantissa) * 2 ** (exponent - 15));
}

const decoder = new ZSTDDecoder();
await decoder.init();

let wrong = 0;
function expect(name, what, found, wanted) {
  const a = JSON.stringify(found), b = JSON.stringify(wanted);
  if (a === b) return;
  wrong += 1;
  console.error(`${name}: ${what} is ${a}, not ${b}`);
}

// The values that reading should give for the `channels` that were written.
function wantedTexel(values, at, channels, stored) {
  const rgb = channels < 3 ? [values[at], values[at], values[at]] : values.slice(at, at + 3);
  return stored === 3 ? rgb : [...rgb, channels % 2 === 0 ? values[at + channels - 1] : 1];
}

function checkPicture(name, type, channels, picture, bytes) {
  const place = `${name}: level ${picture.level} layer ${picture.layer} face ${picture.face}`;
  expect(place, "size in bytes", bytes.byteLength, picture.width * picture.height * type.bytes);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let i = 0; i < picture.width * picture.height; ++i) {
    const found = type.decode(view, i * type.bytes);
    const wanted = wantedTexel(picture.values, i * channels, channels, found.length);
    const tolerance = type.tolerance(wanted);
    for (let k = 0; k < found.length; ++k) {
      if (Math.abs(found[k] - Math.fround(wanted[k])) <= tolerance(wanted[k], k)) continue;
      wrong += 1;
      console.error(`${place}: texel ${i} channel ${k} is ${found[k]}, not ${wanted[k]}`);
      return;
    }
  }
}

function checkFile(folder, name) {
  const wanted = JSON.parse(readFileSync(join(folder, `${name}.json`), "utf8"));
  const type = TYPES[wanted.type];
  const file = readFileSync(join(folder, `${name}.ktx2`));
  const ktx = read(new Uint8Array(file));
  const { pixelWidth, pixelHeight, pixelDepth, layerCount, faceCount, levelCount } = ktx;
  console.log(JSON.stringify({ name, bytes: file.length, vkFormat: ktx.vkFormat, pixelWidth, pixelHeight, layerCount, faceCount,
    levelCount, supercompressionScheme: ktx.supercompressionScheme }));

  expect(name, "vkFormat", ktx.vkFormat, type.vkFormat);
  expect(name, "typeSize", ktx.typeSize, type.typeSize);
  expect(name, "size", [pixelWidth, pixelHeight, pixelDepth], [wanted.width, wanted.height, 0]);
  expect(name, "layers, faces, levels", [layerCount, faceCount, levelCount], [wanted.layers, wanted.faces, wanted.levels]);
  expect(name, "supercompression", ktx.supercompressionScheme, SCHEMES[wanted.compression]);
  expect(name, "data format descriptor", ktx.dataFormatDescriptor, [{
    vendorId: 0, descriptorType: 0, versionNumber: VERSION_1_3, colorModel: MODEL_RGBSDA, colorPrimaries: PRIMARIES_BT709,
    transferFunction: TRANSFER_LINEAR, flags: wanted.channels % 2 === 0 ? PREMULTIPLIED : 0, texelBlockDimension: [0, 0, 0, 0], bytesPlane: [type.bytes, 0, 0, 0, 0, 0, 0, 0],
    samples: type.samples,
  }]);

  expect(name, "KTXorientation", ktx.keyValue.KTXorientation, "rd");
  expect(name, "KTXwriter", /^welkin \d/.test(ktx.keyValue.KTXwriter), true);
  for (const [key, value] of Object.entries(wanted.keys)) {
    const text = ktx.keyValue[key] && new TextDecoder().decode(ktx.keyValue[key]);
    expect(name, `key ${key}`, text, `${value}\0`);
  }

  const ofLevel = Math.max(1, wanted.layers) * wanted.faces;
  ktx.levels.forEach((level, l) => {
    if (ktx.supercompressionScheme === SCHEMES.zstd) {
      level.levelData = decoder.decode(level.levelData, level.uncompressedByteLength);
    }
    expect(name, `level ${l}'s bytes`, level.levelData.byteLength, level.uncompressedByteLength);
    const size = level.levelData.byteLength / ofLevel;
    for (let i = 0; i < ofLevel; ++i) {
      const picture = wanted.pictures[l * ofLevel + i];
      expect(name, "order of pictures", [picture.level, picture.layer * wanted.faces + picture.face], [l, i]);
      checkPicture(name, type, wanted.channels, picture, level.levelData.subarray(i * size, (i + 1) * size));
    }
  });

  ktx.supercompressionScheme = SCHEMES.none;
  writeFileSync(join(folder, `${name}.again.ktx2`), write(ktx, { keepWriter: true }));
}

const folder = process.argv[2];
const names = readdirSync(folder).filter((file) => file.endsWith(".json")).map((file) => file.slice(0, -".json".length));
if (names.length === 0) throw new Error(`no samples in ${folder}`);
for (const name of names) checkFile(folder, name);
console.log(`${names.length} files, ${wrong} differences`);
process.exit(wrong === 0 ? 0 : 1);
