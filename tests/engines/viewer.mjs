// Opens the page of a set in a browser, from a file alone and from a server, and compares what its viewer draws with what Welkin says:
// the background along every pixel's ray, and a mirror ball along every reflected ray.
//
//     node viewer.mjs WELKIN FOLDER    the command; a folder to work in

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser, OPTIONS } from "./browser.mjs";
import { Welkin } from "./welkin.mjs";

const [program, folder] = process.argv.slice(2);
const work = join(folder, "viewer");
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
const welkin = new Welkin(resolve(program), work);

// What viewer.js begins with.
const YAW = 0.35, PITCH = -0.05, FIELD = 0.42, AWAY = 4;

// Added to the page: a mirror, and its pixels from the lower left, as soon as they are drawn.
const PROBE = `<script type="module">
const post = (path, body) => fetch(path, { method: "POST", body });
try {
  const canvas = document.getElementById("canvas"), set = (name, value) => (document.getElementById(name).value = value);
  if (document.getElementById("viewer").hidden) throw new Error("the viewer is hidden");
  set("roughness", 0);
  set("colour", "#ffffff");
  document.getElementById("metal").dispatchEvent(new Event("input"));
  for (let frame = 0; frame < 3; ++frame) await new Promise(requestAnimationFrame);
  const gl = canvas.getContext("webgl2"), { width, height } = canvas, bytes = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  await post("/picture/size", new Float32Array([width, height]));
  await post("/picture/pixels", new Float32Array(bytes));
  if (gl.getError()) throw new Error("WebGL has an error");
  await post("/done", "");
  location.reload();
} catch (error) {
  await post("/failed", String(error.stack ?? error));
}
</script>`;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const normalized = (v) => v.map((x) => x / Math.hypot(...v));

// Columns: right, up and forward in the world.
const [sy, cy, sp, cp] = [Math.sin(YAW), Math.cos(YAW), Math.sin(PITCH), Math.cos(PITCH)];
const CAMERA = [[-cy, 0, sy], [-sy * sp, cp, -cy * sp], [sy * cp, sp, cy * cp]];
const inWorld = (v) => [0, 1, 2].map((i) => v[0] * CAMERA[0][i] + v[1] * CAMERA[1][i] + v[2] * CAMERA[2][i]);

// Directions that pixels show: of the background, or of the ball away from its rim; null near that.
function seen(x, y, width, height) {
  const scale = FIELD / Math.min(width, height);
  const ray = inWorld(normalized([(2 * (x + 0.5) - width) * scale, (2 * (y + 0.5) - height) * scale, 1]));
  const eye = inWorld([0, 0, -AWAY]), along = dot(eye, ray), inside = along * along - dot(eye, eye) + 1;
  if (inside < -0.05) return { ball: false, direction: ray };
  if (inside < 0.2) return null;
  const normal = [0, 1, 2].map((i) => eye[i] + ray[i] * (-along - Math.sqrt(inside)));
  const cosine = dot(normal, ray);
  return { ball: true, direction: [0, 1, 2].map((i) => ray[i] - 2 * cosine * normal[i]) };
}

const encoded = (x) => 255 * Math.min(1, x <= 0.0031308 ? 12.92 * Math.max(0, x) : 1.055 * x ** (1 / 2.4) - 0.055);
const wrong = [];

function compare(set, page, pictures) {
  const [width, height] = pictures.get("size"), pixels = pictures.get("pixels"), exposure = Number(page.match(/"exposure":([-+.\de]+)/)[1]);
  for (const ball of [false, true]) {
    const chosen = [];
    for (let y = 3; y < height; y += 7) {
      for (let x = 3; x < width; x += 7) {
        const found = seen(x, y, width, height);
        if (found?.ball === ball) chosen.push({ at: 4 * (y * width + x), direction: found.direction });
      }
    }
    const light = welkin.sample(`${set}/specular.ktx2`, chosen.map((c) => c.direction));
    const errors = chosen.flatMap(({ at }, i) => [0, 1, 2].map((c) => Math.abs(pixels[at + c] - encoded(exposure * light[3 * i + c])))).sort((a, b) => a - b);
    const median = errors[errors.length >> 1], most = errors[Math.floor(0.98 * errors.length)];
    console.log(`viewer, ${set}: ${ball ? "mirror ball" : "background"}: ${chosen.length} pixels, off by ${median.toFixed(2)} of 255 (median), ${most.toFixed(2)} (of 98 %)`);
    // rgb9e5 and eight bits of filtering; blocks of BC6H are decoded exactly by both.
    if (!(chosen.length > 300 && median < 0.8 && most < 4)) wrong.push(`${set}: the ${ball ? "ball" : "background"} isn't what Welkin says`);
  }
}

const browser = new Browser();
try {
  welkin.make("welkin synth axes card.exr --size 512");
  for (const [set, words] of [["general", ""], ["filament", " --for filament"]]) {
    welkin.make(`welkin bake card.exr ${set}/${words}`);
    const page = readFileSync(join(work, set, "index.html"), "utf8");
    if (set === "filament") welkin.make("welkin convert filament/environment_ibl.ktx filament/specular.ktx2");
    const { pictures } = await browser.show({ folders: {}, texts: { "/": { type: "text/html", text: page.replace("</html>", `${PROBE}</html>`) } }, seconds: 180 });
    compare(set, page, pictures);
  }
  // From the file itself, where browsers allow less.
  const profile = mkdtempSync(join(tmpdir(), "welkin-viewer-"));
  const shown = execFileSync("chromium", [...OPTIONS, `--user-data-dir=${profile}`, "--virtual-time-budget=3000", "--dump-dom",
    pathToFileURL(join(resolve(work), "general", "index.html")).href], { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"], timeout: 180000 });
  rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
  if (!/<figure class="viewer" id="viewer">/.test(shown)) wrong.push("opened as a file, the page hides its viewer");
} finally {
  browser.close();
}
for (const line of wrong) console.error(line);
process.exit(wrong.length ? 1 : 0);
