// Photographs pages: a list of lines "page, picture, part", with tabs between; the part is the window on the mechanism, the whole
// page, or a small picture for the gallery. With --check nothing is written, and pictures that are out of date are named.

import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { browser, opened } from "./chrome.mjs";
import { difference, urlOf } from "./compare.mjs";
import { settled } from "./support.mjs";

const SIZES = {
  window: { width: 1240, height: 700 },
  whole: { width: 1180, height: 720 },
  gallery: { width: 900, height: 520 },
};
/** Letters and edges are drawn a little differently by other versions of the browser: squares of pixels are compared. */
const SQUARE = 6;
const PART = 0.02;

const [list, ...flags] = process.argv.slice(2);
const checks = flags.includes("--check");
const stale = [];
const chrome = await browser();
for (const line of readFileSync(list, "utf8").trim().split("\n")) {
  const [path, picture, part] = line.split("\t");
  const context = await chrome.newContext({ viewport: SIZES[part], colorScheme: "light" });
  const { page, complaints } = await opened(context, path);
  if (complaints.length > 0) throw new Error(`${path}: ${complaints.join("; ")}`);
  await settled(page);
  const bytes = part === "whole" ? await packed(context, (await page.screenshot()).toString("base64")) : await seen(page);
  if (!checks) {
    mkdirSync(dirname(picture), { recursive: true });
    writeFileSync(picture, bytes);
  } else if (!existsSync(picture)) stale.push(`${picture}: there is none`);
  else {
    const part = await difference(page, urlOf(bytes, "webp"), urlOf(readFileSync(picture), "webp"), SQUARE);
    if (part > PART) stale.push(`${picture}: ${(100 * part).toFixed(1)} % of it differs`);
  }
  await context.close();
}
await chrome.close();
if (stale.length > 0) {
  console.error(`out of date:\n${stale.join("\n")}\nmend it with cargo xtask pictures`);
  process.exit(1);
}

async function seen(page) {
  const url = await page.evaluate(() => window.flexura.picture("image/webp", 0.86));
  return Buffer.from(url.split(",")[1], "base64");
}

/** Through a canvas, since the browser photographs itself as PNG or JPEG only. */
async function packed(context, png) {
  const page = await context.newPage();
  const url = await page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const sheet = new OffscreenCanvas(image.width, image.height);
    sheet.getContext("2d").drawImage(image, 0, 0);
    const blob = await sheet.convertToBlob({ type: "image/webp", quality: 0.9 });
    const bytes = new Uint8Array(await blob.arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  }, png);
  return Buffer.from(url, "base64");
}
