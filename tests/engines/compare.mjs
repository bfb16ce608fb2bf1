// What a ball's pixels should be by Welkin's own samples, and how far they are from it.

import { RADIUS_SEEN, ballPixels, dot, normalized } from "./pages/balls.js";
import { READS } from "./reads.mjs";

export const ROUGHNESS = { mirror: 0, rough: 0.5, diffuse: 1 };
export { RADIUS_SEEN };

const reflected = (toEye, normal) => normal.map((n, i) => 2 * dot(toEye, normal) * n - toEye[i]);
const mixed = (a, b, t) => normalized(a.map((x, i) => x + t * (b[i] - x)));

// The directions that an engine looks up for a ball.
function lookUps(reads, ball, size, views) {
  const r = Math.max(ROUGHNESS[ball], reads.least);
  const pixels = views.flatMap((view, number) => ballPixels(size, view).map((pixel) => ({ ...pixel, number })));
  for (const pixel of pixels) {
    pixel.looked = ball === "diffuse" ? pixel.normal : mixed(reflected(pixel.toEye, pixel.normal), pixel.normal, reads.toNormal(r));
    pixel.cosine = dot(pixel.toEye, pixel.normal);
  }
  return { pixels, r };
}

function shade(reads, ball, { pixels, r }, welkin, light, diffuse) {
  if (ball === "diffuse") return diffuse;
  if (!reads.metal) return light;
  const albedo = reads.albedo ? welkin.whiteAlbedo(reads.albedo) : () => 1;
  return light.map((L, i) => reads.metal(albedo(pixels[Math.floor(i / 3)].cosine, r), L, diffuse[i], r));
}

// One of the lat-longs that an engine looks up.
function latlong({ welkin, map, chain, reads, level }) {
  const size = `--to latlong --size ${reads.latlong(level)} --quiet`;
  const name = `${reads.ofSky ? map : chain.file}-latlong-${level}.exr`;
  if (!reads.ofSky) welkin.makeOnce(name, `welkin convert ${chain.file} ${name} --level ${level} --filter bilinear ${size}`);
  else if (level === 0) welkin.makeOnce(name, `welkin convert ${map}.exr ${name} ${size}`);
  else welkin.makeOnce(name, `welkin bake ${map}.exr ${name} --lobe ggx,roughness=${level / 5} ${size}`);
  return name;
}

// Radiance that an engine finds at a level, a fraction between two.
function readLevel({ welkin, map, chain, reads, directions, level }) {
  if (!reads.latlong) return welkin.sample(chain.file, directions, level);
  const low = Math.floor(level), t = level - low;
  const [a, b] = [low, Math.ceil(level)].map((k) => welkin.sample(latlong({ welkin, map, chain, reads, level: k }), directions));
  return a.map((x, i) => (1 - t) * x + t * b[i]);
}

// { read, exact }: what a ball shows if the engine reads `chain`, and if lobes are exact instead, three numbers a pixel.
export function expected({ welkin, map, chain, engine, ball, size, views }) {
  const reads = READS[engine];
  const look = lookUps(reads, ball, size, views);
  const normals = look.pixels.map(({ normal }) => normal), directions = look.pixels.map(({ looked }) => looked);
  const last = chain.levels - 1;
  const lobe = (name, lobe) => {
    welkin.makeOnce(name, `welkin bake ${map}.exr ${name} --lobe ${lobe} --size 128 --tolerance 0.01% --format rgba32f`);
    return name;
  };
  const exactDiffuse = () => welkin.sample(lobe(`${map}-lambert.ktx2`, "lambert"), normals);
  const readDiffuse = () => {
    if (reads.diffuseLevel) return welkin.sample(chain.file, normals, last);
    if (reads.diffuseDegree === undefined) return exactDiffuse();
    const name = `${map}-degree-${reads.diffuseDegree}.exr`;
    welkin.makeOnce(name, `welkin sh ${map}.exr ${name} --order ${reads.diffuseDegree} --of lambert --size 512x256 --quiet`);
    return welkin.sample(name, normals);
  };
  const readLight = () => (ball === "diffuse" ? [] : readLevel({ welkin, map, chain, reads, directions, level: reads.level(look.r, last) }));
  const exactLight = () => (ball === "diffuse" ? [] : welkin.sample(lobe(`${map}-${look.r}.ktx2`, `ggx,roughness=${look.r}`), directions));
  return {
    ...look,
    read: shade(reads, ball, look, welkin, readLight(), readDiffuse()),
    // Of a mirror, the level's own texels are what there is to compare with.
    exact: ball === "mirror" ? null : shade(reads, ball, look, welkin, exactLight(), exactDiffuse()),
  };
}

export function shown(pictures, map, ball, pixels) {
  const values = new Float64Array(3 * pixels.length);
  pixels.forEach(({ index, number }, i) => {
    const picture = pictures.get(`${map}-${ball}-${number}`);
    if (!picture) throw new Error(`the page has not shown ${map}-${ball}-${number}`);
    for (let k = 0; k < 3; ++k) values[3 * i + k] = picture[3 * index + k];
  });
  return values;
}

// The root of the mean square difference over that of the mean square of `b`; infinite where a value is not finite.
export function relativeError(a, b) {
  let difference = 0, square = 0;
  for (let i = 0; i < b.length; ++i) {
    difference += (a[i] - b[i]) ** 2;
    square += b[i] ** 2;
  }
  const error = Math.sqrt(difference / square);
  return Number.isFinite(error) ? error : Infinity;
}

// The reflection or rotation of axes under which a mirror's pixels fit best, for the message when they don't fit as they are:
// { error, axes: "−x z y" }.
export function bestOrientation({ welkin, chain, pixels, values, level }) {
  let best = { error: Infinity };
  const some = pixels.map((pixel, i) => ({ pixel, i })).filter(({ i }) => i % 16 === 0);
  const wanted = Float64Array.from(some.flatMap(({ i }) => [...values.slice(3 * i, 3 * i + 3)]));
  for (const order of [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]]) {
    for (let signs = 0; signs < 8; ++signs) {
      const turned = some.map(({ pixel }) => order.map((from, k) => (signs & (1 << k) ? -1 : 1) * pixel.looked[from]));
      const error = relativeError(wanted, welkin.sample(chain, turned, level));
      const axes = order.map((from, k) => (signs & (1 << k) ? "−" : "") + "xyz"[from]).join(" ");
      if (error < best.error) best = { error, axes };
    }
  }
  return best;
}
