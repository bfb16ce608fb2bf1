// Pictures to look at: what the engines have drawn, as a PNG.

import { deflateSync } from "node:zlib";

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function chunk(type, data) {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const length = Buffer.alloc(4), check = Buffer.alloc(4);
  length.writeUInt32BE(data.length);
  check.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, check]);
}

// rgb: bytes, row by row.
export function png(width, height, rgb) {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 2, 0, 0, 0], 8);
  // Every byte less that of the texel above, PNG's filter 2, which suits smooth pictures.
  const bytes = 3 * width, rows = Buffer.alloc(height * (bytes + 1));
  for (let y = 0; y < height; ++y) {
    rows[y * (bytes + 1)] = 2;
    for (let i = 0; i < bytes; ++i) rows[y * (bytes + 1) + 1 + i] = rgb[y * bytes + i] - (y > 0 ? rgb[(y - 1) * bytes + i] : 0);
  }
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
}

const encoded = (x) => 255 * Math.min(1, x <= 0.0031308 ? 12.92 * Math.max(0, x) : 1.055 * x ** (1 / 2.4) - 0.055);

// rows: of pictures, linear floats, size × size each.
export function sheet(rows, size, brightness) {
  const width = rows[0].length * size, rgb = new Uint8Array(3 * width * rows.length * size);
  rows.forEach((row, r) => row.forEach(({ map, picture }, c) => {
    for (let y = 0; y < size; ++y) {
      for (let i = 0; i < 3 * size; ++i) rgb[3 * ((r * size + y) * width + c * size) + i] = encoded(brightness[map] * picture[3 * y * size + i]);
    }
  }));
  return png(width, rows.length * size, rgb);
}
