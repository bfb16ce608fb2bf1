// Loads what Welkin bakes into the engines themselves, has them light a mirror, a rough and a diffuse ball, and compares every pixel with
// what Welkin says. Prints a table, and leaves what was drawn in FOLDER/work; fails if an error exceeds its limit, an engine sees the test
// card turned, or docs/engines.md shows something else.
//
//     node run.mjs WELKIN FOLDER [--all | NAME…]    the command; the folder with node_modules; sets of sets.json. By default those that Welkin
//                                                   bakes, with --all also those that engines filter themselves, which have no limit
//
// A set of sets.json:
//     module, page    the engine's name in modules.mjs, and the script of pages/ that draws with it
//     for             the engine of `bake --for`, which makes the files, and whose manifest has the snippet; or
//     commands        make the set's files of sky.exr, in the folder where both are
//     snippet         the module that a user writes to load them: loadLight({ folder, … }), where … is what the engine has
//     chain           what the files hold, as Welkin is asked for it: the levels
//     reads           how the engine reads them, in reads.mjs
//     leftHanded      the scene is left-handed
//     own             the engine filters the sky itself
//     limits, because others than the usual

import { mkdirSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { Browser } from "./browser.mjs";
import { bestOrientation, expected, relativeError, shown } from "./compare.mjs";
import { MODULES } from "./modules.mjs";
import { sheet } from "./picture.mjs";
import { READS } from "./reads.mjs";
import { Welkin } from "./welkin.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const sets = JSON.parse(readFileSync(join(here, "sets.json"), "utf8"));
const [program, folder, ...words] = process.argv.slice(2);
const names = Object.keys(sets).filter((name) => words.length === 0 ? !sets[name].own : words.includes(name) || words.includes("--all"));
for (const word of words) if (word !== "--all" && !sets[word]) throw new Error(`no set '${word}'; there are: ${Object.keys(sets).join(", ")}`);

const SIZE = 96;
const VIEWS = [[0.3, 0.25, 1], [-1, -0.45, -0.2], [0.25, 0.9, -0.6]];
const MAPS = ["axes", "room"];
const BRIGHTNESS = { axes: 1, room: 0.25 };  // of the pictures to look at
// Of the root of the mean square. The lights' own levels are half floats, which round by 0.03 %; GPUs interpolate with 8 bits.
const LIMITS = { mirror: 0.01, rough: 0.02, diffuse: 0.01 };
const SECONDS = 180, SECONDS_TO_FILTER = 900;  // on a busy machine without a graphics card

const work = join(folder, "work");
rmSync(work, { recursive: true, force: true });
mkdirSync(work, { recursive: true });
const welkin = new Welkin(resolve(program), work);
const browser = new Browser();
for (const signal of ["SIGINT", "SIGTERM"]) {
  process.once(signal, () => {
    browser.close();
    process.exit(1);
  });
}

const fileName = (name) => name.replace(/[^a-z0-9]+/g, "-");

// The set's files, by its own commands, in a folder for this map, which is called sky.exr there.
function bakeSet(name, map) {
  const set = join(work, fileName(name), map);
  mkdirSync(set, { recursive: true });
  symlinkSync(join("..", "..", `${map}.exr`), join(set, "sky.exr"));
  for (const line of commandsOf(name)) welkin.make(line, set);
}

function commandsOf(name) {
  return sets[name].for ? [`welkin bake sky.exr ./ --for ${sets[name].for}`] : sets[name].commands;
}

// Of a set of `bake --for`, as its manifest has it, which is there once it is baked.
function snippetOf(name) {
  if (!sets[name].for) return sets[name].snippet.join("\n");
  return JSON.parse(readFileSync(join(work, fileName(name), MAPS[0], "manifest.json"), "utf8")).snippet.trimEnd();
}

// The page for users shows what is tested.
const page = readFileSync(join(here, "..", "..", "docs", "engines.md"), "utf8");
function checkPage(name) {
  for (const text of [...commandsOf(name).map((line) => `    ${line}`), snippetOf(name)]) {
    if (!page.includes(`${text}\n`)) wrong.push(`docs/engines.md does not show this of ${name}:\n${text}`);
  }
}

function draw(name) {
  const { module, page, leftHanded, own } = sets[name], { head, imports } = MODULES[module];
  const html = `<!doctype html><meta charset="utf-8"><link rel="icon" href="data:,">${head ?? ""}
<script type="importmap">${JSON.stringify({ imports: imports ?? {} })}</script>
<body><script type="module" src="/pages/page.js"></script>`;
  return browser.show({
    folders: { "/pages/": join(here, "pages"), "/node_modules/": join(folder, "node_modules"), "/set/": join(work, fileName(name)) },
    texts: {
      "/": { type: "text/html", text: html },
      "/task": { type: "application/json", text: JSON.stringify({ page, leftHanded, size: SIZE, views: VIEWS, maps: MAPS }) },
      "/snippet.js": { type: "text/javascript", text: snippetOf(name) },
    },
    seconds: own ? SECONDS_TO_FILTER : SECONDS,
  });
}

// The chain that Welkin itself reads: native, in floats.
function bakeChain(levels, map) {
  const file = `${map}-${fileName(levels)}.ktx2`;
  welkin.makeOnce(file, `welkin bake ${map}.exr ${file} ${levels} --format rgba32f`);
  return { file, levels: Number(levels.match(/--levels (\d+)/)[1]) };
}

const percent = (x) => (x === null ? "–" : (100 * x).toFixed(2));
const wrong = [], rows = [];

function compare(name, map, pictures) {
  const set = sets[name], chain = bakeChain(set.chain, map);
  for (const ball of Object.keys(LIMITS)) {
    const { pixels, r, read, exact } = expected({ welkin, map, chain, engine: set.reads, ball, size: SIZE, views: VIEWS });
    const values = shown(pictures, map, ball, pixels);
    const error = relativeError(values, read), exactError = exact && relativeError(values, exact);
    console.log(`${name.padEnd(32)} ${map.padEnd(8)} ${ball.padEnd(8)} ${percent(error).padStart(7)} ${percent(exactError).padStart(12)}`);
    const limit = set.limits?.[ball] ?? LIMITS[ball];
    if (!set.own && !(error <= limit)) wrong.push(`${name}, ${map}: the ${ball} ball is off by ${percent(error)} %, more than ${100 * limit} %`);
    // The test card tells every direction from every other.
    if (map !== "axes" || ball !== "mirror") continue;
    const best = bestOrientation({ welkin, chain: chain.file, pixels, values, level: READS[set.reads].level(r, chain.levels - 1) });
    if (best.axes !== "x y z") wrong.push(`${name}: it fits best, within ${percent(best.error)} %, where (x, y, z) is seen along (${best.axes})`);
  }
}

try {
  for (const map of MAPS) welkin.make(`welkin synth ${map} ${map}.exr --size 1024`);
  console.log(`relative RMSE, %                 map      ball     as read   exact lobe`);
  for (const name of names) {
    try {
      for (const map of MAPS) bakeSet(name, map);
      checkPage(name);
      const { pictures, said } = await draw(name), before = wrong.length;
      for (const map of MAPS) compare(name, map, pictures);
      if (wrong.length > before) wrong.push(...said.map((line) => `  the page said: ${line}`));
      const picture = (map, ball, view) => ({ map, picture: pictures.get(`${map}-${ball}-${view}`) });
      const all = MAPS.map((map) => Object.keys(LIMITS).flatMap((ball) => VIEWS.map((_, view) => picture(map, ball, view))));
      writeFileSync(join(work, `${fileName(name)}.png`), sheet(all, SIZE, BRIGHTNESS));
      if (!name.includes(",")) rows.push([picture("axes", "mirror", 2), ...Object.keys(LIMITS).map((ball) => picture("room", ball, 2))]);
    } catch (error) {
      wrong.push(`${name}: ${error.message}`);
    }
  }
  if (rows.length) writeFileSync(join(work, "balls.png"), sheet(rows, SIZE, BRIGHTNESS));
} finally {
  browser.close();
}
for (const line of wrong) console.error(line);
process.exit(wrong.length ? 1 : 0);
