// Photographs pages: a list of lines "page, picture, part", with tabs between; the part is the window on the mechanism, the whole
// page, or a small picture for the gallery.

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";
import { browser, opened } from "./chrome.mjs";
import { settled } from "./support.mjs";

const SIZES = {
  window: { width: 1240, height: 700 },
  whole: { width: 1180, height: 720 },
  gallery: { width: 900, height: 520 },
};
const chrome = await browser();
for (const line of readFileSync(process.argv[2], "utf8").trim().split("\n")) {
  const [path, picture, part] = line.split("\t");
  const context = await chrome.newContext({ viewport: SIZES[part], colorScheme: "light" });
  const { page, complaints } = await opened(context, path);
  if (complaints.length > 0) throw new Error(`${path}: ${complaints.join("; ")}`);
  await settled(page);
  mkdirSync(dirname(picture), { recursive: true });
  if (part === "whole") {
    // Through a canvas, since the browser photographs itself as PNG or JPEG only.
    const png = (await page.screenshot()).toString("base64");
    writeFileSync(picture, await packed(context, png));
  } else {
    const url = await page.evaluate(() => window.flexura.picture("image/webp", 0.86));
    writeFileSync(picture, Buffer.from(url.split(",")[1], "base64"));
  }
  await context.close();
}
await chrome.close();

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
