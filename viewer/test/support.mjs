// Pages to test: made by the command from models, and by hand where a document is wanted that no model gives.

import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "../..");
const program = process.env.FLEXURA ?? join(root, "target/debug/flexura");
const folder = mkdtempSync(join(tmpdir(), "flexura-page-"));

export const model = (name) => join(root, "models", `${name}.toml`);

function flexura(...words) {
  try {
    return execFileSync(program, words, { encoding: "utf8", maxBuffer: 1 << 30, stdio: ["ignore", "pipe", "pipe"] });
  } catch (error) {
    // Not converged is an answer too.
    if (error.status === 1) return error.stdout;
    throw new Error(`flexura ${words.join(" ")}: ${error.stderr ?? error}`);
  }
}

/** The page and the document of a study. */
export function made(name, ...words) {
  const into = join(folder, name);
  mkdirSync(into, { recursive: true });
  const page = join(into, "report.html");
  const text = flexura(...words, "--json", "--quiet", "--report", page);
  return { page, document: JSON.parse(text) };
}

/** The page of a model that is given as text. */
export function madeOf(name, toml, ...words) {
  const file = join(folder, `${name}.toml`);
  writeFileSync(file, toml);
  const [verb, ...rest] = words.length > 0 ? words : ["solve"];
  return made(name, verb, file, ...rest);
}

/** The page of a document. */
export function shown(name, document) {
  const [file, page] = [join(folder, `${name}.json`), join(folder, `${name}.html`)];
  writeFileSync(file, JSON.stringify(document));
  flexura("view", file, "--no-open", "-o", page);
  return page;
}

export const text = (path) => readFileSync(path, "utf8");

export function written(name, content) {
  const path = join(folder, name);
  writeFileSync(path, content);
  return path;
}

/** A strip that a force at its tip bends down, followed as the force grows. */
export const BENT = `
format = 1
name = "bent strip"
[parameter]
push = "0 N"
[material.steel]
young = "207 GPa"
poisson = 0.3
[section.strip]
shape = "rectangle"
width = "20 mm"
height = "0.5 mm"
[beam.strip]
material = "steel"
section = "strip"
length = "200 mm"
start = { body = "ground", hold = "clamp" }
[load.tip]
beam = "strip"
at = 1.0
force = [0, 0, "-push"]
[output]
down = "-beam.strip.end.position.z"
across = "beam.strip.end.position.x"
`;

/** Pixels of the window, without what is written on it. */
export const pixels = (page) =>
  page.evaluate(async () => {
    window.flexura.app.viewport.draw();
    const canvas = document.querySelector("canvas.window");
    const sheet = new OffscreenCanvas(canvas.width, canvas.height);
    const context = sheet.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const { data, width, height } = context.getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Map();
    const box = { left: width, right: -1, top: height, bottom: -1 };
    const ground = data.slice(0, 3).join();
    for (let i = 0; i < data.length; i += 4) {
      const colour = `${data[i]},${data[i + 1]},${data[i + 2]}`;
      colours.set(colour, (colours.get(colour) ?? 0) + 1);
      if (colour === ground) continue;
      const [x, y] = [(i / 4) % width, Math.floor(i / 4 / width)];
      box.left = Math.min(box.left, x);
      box.right = Math.max(box.right, x);
      box.top = Math.min(box.top, y);
      box.bottom = Math.max(box.bottom, y);
    }
    const ratio = canvas.width / canvas.getBoundingClientRect().width;
    for (const side of Object.keys(box)) box[side] /= ratio;
    return { colours: colours.size, ground, drawn: data.length / 4 - (colours.get(ground) ?? 0), box };
  });

/** Waits until what was asked for is drawn. */
export const settled = (page) =>
  page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
