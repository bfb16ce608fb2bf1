// Headless Chromium, with WebGL2 in software and without a network: it loads pages from a server on this machine, and posts to it what
// they have drawn.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const TYPES = { ".css": "text/css", ".js": "text/javascript", ".json": "application/json", ".mjs": "text/javascript",
  ".wasm": "application/wasm" };

export const OPTIONS = ["--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--disable-dev-shm-usage", "--no-first-run", "--disable-background-networking", "--disable-component-update",
  "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"];

async function bodyOf(request) {
  const parts = [];
  for await (const part of request) parts.push(part);
  return Buffer.concat(parts);
}

export class Browser {
  #page = null;      // what is being shown, with its pictures and messages
  #waiting = null;   // the browser's request for the next page, not yet answered
  #messages = "";

  // A page: { folders: path → folder, texts: path → { type, text } }, where "/" is the page itself. Its scripts post floats to
  // /picture/NAME, lines to /said, and at last to /done or /failed; then it loads "/" again.
  async show({ folders, texts, seconds }) {
    if (this.#page) throw new Error("a page is being shown");
    await this.#start();
    const page = { folders, texts, pictures: new Map(), said: [] };
    const ended = new Promise((resolve, reject) => Object.assign(page, { resolve, reject }));
    this.#page = page;
    this.#waiting?.();
    const clock = setTimeout(() => page.reject(new Error(`${seconds} s have passed`)), 1000 * seconds);
    try {
      await ended;
    } catch (error) {
      this.#kill();  // the next page gets a browser of its own
      const shown = [...page.pictures.keys()].join(" ") || "nothing";
      throw new Error([error.message, `shown so far: ${shown}`, ...page.said].join("\n  "));
    } finally {
      clearTimeout(clock);
      this.#page = null;
    }
    return page;
  }

  close() {
    this.#kill();
    this.server?.closeAllConnections();
    this.server?.close();
  }

  async #start() {
    if (!this.server) {
      this.server = createServer((request, response) => this.#answer(request, response).catch((error) => this.#page?.reject(error)));
      await new Promise((resolve) => this.server.listen(0, "127.0.0.1", resolve));
    }
    if (this.program) return;
    this.profile = mkdtempSync(join(tmpdir(), "welkin-engines-"));
    const address = `http://127.0.0.1:${this.server.address().port}/`;
    const program = spawn("chromium", [...OPTIONS, `--user-data-dir=${this.profile}`, address],
      { stdio: ["ignore", "ignore", "pipe"], detached: true });
    this.program = program;
    const fail = (why) => {
      if (program === this.program) this.#page?.reject(new Error(why));
    };
    program.stderr.on("data", (text) => (this.#messages = (this.#messages + text).slice(-2000)));
    program.on("error", (error) => fail(`chromium, of Debian's package chromium, does not start: ${error.message}`));
    program.on("exit", (code) => fail(`chromium has ended by itself with status ${code}: ${this.#messages}`));
  }

  #kill() {
    const program = this.program;
    this.program = this.#waiting = null;
    if (program?.pid && program.exitCode === null) process.kill(-program.pid, "SIGKILL");
    if (this.profile) rmSync(this.profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
    this.profile = null;
  }

  async #answer(request, response) {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://here").pathname));
    if (request.method === "POST") return this.#take(path, await bodyOf(request), response);
    if (path === "/" && !this.#page) await new Promise((resolve) => (this.#waiting = resolve));
    const page = this.#page;
    const text = page?.texts[path], start = page && Object.keys(page.folders).find((prefix) => path.startsWith(prefix));
    const body = text?.text ?? (start && (await readFile(join(page.folders[start], path.slice(start.length))).catch(() => null)));
    if (body === null || body === undefined) {
      page?.said.push(`there is no ${path}`);
      response.writeHead(404).end();
      return;
    }
    const type = text?.type ?? TYPES[extname(path)] ?? "application/octet-stream";
    response.writeHead(200, { "content-type": type, "cache-control": start === "/node_modules/" ? "max-age=3600" : "no-store" }).end(body);
  }

  #take(path, body, response) {
    const page = this.#page;
    response.end();
    if (!page) return;
    if (path.startsWith("/picture/")) page.pictures.set(path.slice("/picture/".length), new Float32Array(new Uint8Array(body).buffer));
    else if (path === "/said") page.said.push(String(body));
    else if (path === "/done") page.resolve();
    else if (path === "/failed") page.reject(new Error(`the page failed: ${body}`));
  }
}
