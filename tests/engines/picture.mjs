// Pictures to look at: what the engines have drawn, as a PNG.

import { crc32 as zlibCrc, deflateSync } from "node:zlib";

function crc32(bytes) {
  if (zlibCrc) return zlibCrc(bytes);
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
  const rows = Buffer.alloc(height * (3 * width + 1));
  for (let y = 0; y < height; ++y) rows.set(rgb.subarray(y * 3 * width, (y + 1) * 3 * width), y * (3 * width + 1) + 1);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows, { level: 9 })), chunk("IEND", Buffer.alloc(0))]);
}

const encoded = (x) => 255 * Math.min(1, x <= 0.0031308 ? 12.92 * Math.max(0, x) : 1.055 * x ** (1 / 2.4) - 0.055);

const BRIGHTNESS = { axes: 1, room: 0.25 };

// A row for each map: every ball, in every view.
export function sheet(pictures, maps, balls, views, size) {
  const columns = balls.length * views, width = columns * size, height = maps.length * size;
  const rgb = new Uint8Array(3 * width * height);
  maps.forEach((map, row) => {
    for (let column = 0; column < columns; ++column) {
      const picture = pictures.get(`${map}-${balls[Math.floor(column / views)]}-${column % views}`);
      for (let y = 0; y < size; ++y) {
        for (let i = 0; i < 3 * size; ++i) {
          rgb[3 * ((row * size + y) * width + column * size) + i] = encoded(BRIGHTNESS[map] * picture[3 * y * size + i]);
        }
      }
    }
  });
  return png(width, height, rgb);
}
