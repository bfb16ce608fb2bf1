// What every page shares: balls of facets, whose pixels are known exactly, and what the page was asked to draw.
//
// A ball is a flat mesh in a plane that faces the camera, one quad a pixel, with the normal of the sphere that would be seen there. So no
// pixel mixes normals, none is tessellated, and derivatives of normals are 0, which engines take for roughness. Pixel (column, row) of
// N×N is at x = (2 column + 1)/N − 1, y = 1 − (2 row + 1)/N of the plane through the world's origin.

export const EYE_DISTANCE = 10;
export const RADIUS_SEEN = 0.85;  // of the pixels that are compared; nearer the silhouette there is nothing

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => a.map((x) => x * s);
const sum = (...vectors) => vectors.reduce((a, b) => a.map((x, i) => x + b[i]));
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const normalized = (a) => scaled(a, 1 / Math.hypot(...a));

// The camera's axes: from the origin to the eye, to the right of the picture, up in it.
export function cameraAxes(towardEye) {
  const back = normalized(towardEye), right = normalized(cross([0, 1, 0], back));
  return { back, right, up: cross(back, right), eye: scaled(back, EYE_DISTANCE) };
}

// Of the field of view in which the plane fills the picture.
export const FIELD_OF_VIEW = 2 * Math.atan(1 / EYE_DISTANCE);

// The pixels of a ball: {index, position, normal, toEye}, row by row from the top.
export function ballPixels(size, towardEye) {
  const { back, right, up, eye } = cameraAxes(towardEye);
  const pixels = [];
  for (let row = 0; row < size; ++row) {
    for (let column = 0; column < size; ++column) {
      const x = (2 * column + 1) / size - 1, y = 1 - (2 * row + 1) / size, z2 = 1 - x * x - y * y;
      if (1 - z2 > RADIUS_SEEN * RADIUS_SEEN) continue;
      const position = sum(scaled(right, x), scaled(up, y));
      const normal = sum(position, scaled(back, Math.sqrt(z2)));
      pixels.push({ index: row * size + column, position, normal, toEye: normalized(sum(eye, scaled(position, -1))) });
    }
  }
  return pixels;
}

// The ball as triangles, counterclockwise as the camera sees them.
export function ballMesh(size, towardEye) {
  const { right, up } = cameraAxes(towardEye);
  const positions = [], normals = [], indices = [];
  for (const { position, normal } of ballPixels(size, towardEye)) {
    const first = positions.length / 3;
    for (const [x, y] of [[-1, -1], [1, -1], [1, 1], [-1, 1]]) {
      positions.push(...sum(position, scaled(right, x / size), scaled(up, y / size)));
      normals.push(...normal);
    }
    indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  return { positions: new Float32Array(positions), normals: new Float32Array(normals), indices: new Uint16Array(indices) };
}

// Rows from the bottom, four floats a pixel, as WebGL reads them → rows from the top, three floats a pixel.
export function upright(rgba, size) {
  const rgb = new Float32Array(size * size * 3);
  for (let row = 0; row < size; ++row) {
    for (let column = 0; column < size; ++column) {
      for (let k = 0; k < 3; ++k) rgb[(row * size + column) * 3 + k] = rgba[((size - 1 - row) * size + column) * 4 + k];
    }
  }
  return rgb;
}
