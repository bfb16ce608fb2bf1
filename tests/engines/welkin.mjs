// What Welkin says: its command, called for maps, chains, tables, and radiance along directions.

import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";

export class Welkin {
  constructor(program, folder) {
    this.program = program;
    this.folder = folder;
    this.tables = new Map();
  }

  run(words, { input, folder = this.folder } = {}) {
    return execFileSync(this.program, words, { cwd: folder, input, encoding: "utf8", maxBuffer: 1 << 30,
      stdio: ["pipe", "pipe", "inherit"] });
  }

  // Makes files of a folder, by a command as a user types it: `welkin bake sky.exr out.ktx2 --size 64`.
  make(line, folder = this.folder) {
    const [name, ...words] = line.split(" ");
    if (name !== "welkin") throw new Error(`not a command of welkin: ${line}`);
    this.run(words, { folder });
  }

  makeOnce(file, line) {
    if (!existsSync(`${this.folder}/${file}`)) this.make(line);
  }

  // Radiance along directions, three numbers each.
  sample(map, directions, level = 0) {
    const input = directions.map((d) => d.join(" ")).join("\n") + "\n";
    const text = this.run(["sample", map, "--level", String(level)], { input });
    const values = Float64Array.from(text.trim().split(/\s+/), Number);
    if (values.length !== 3 * directions.length) throw new Error(`${map}: ${values.length} numbers for ${directions.length} directions`);
    return values;
  }

  // A renderer's table of the split sum, as a function (n·v, roughness) → albedo of a white surface that scatters once.
  whiteAlbedo(renderer) {
    if (this.tables.has(renderer)) return this.tables.get(renderer);
    this.makeOnce(`${renderer}.h`, `welkin lut ${renderer}.h --for ${renderer} --channels one --type float`);
    const text = readFileSync(`${this.folder}/${renderer}.h`, "utf8");
    const [, width, height] = text.match(/_WIDTH (\d+)[^]*_HEIGHT (\d+)/).map(Number);
    const values = text.slice(text.indexOf("{", text.indexOf("static"))).match(/[-+.\de]+(?=f)/g).map(Number);
    const cosineDown = text.includes('"x":"roughness"');
    const texel = (x, y) => values[Math.min(Math.max(y, 0), height - 1) * width + Math.min(Math.max(x, 0), width - 1)];
    const look = (cosine, roughness) => {
      const [u, v] = cosineDown ? [roughness, cosine] : [cosine, roughness];
      const x = u * width - 0.5, y = v * height - 0.5, i = Math.floor(x), j = Math.floor(y), s = x - i, t = y - j;
      return (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) + t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
    };
    this.tables.set(renderer, look);
    return look;
  }
}
