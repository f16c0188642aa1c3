// A headless Chromium that draws in software, so that pictures do not depend on the machine's graphics.

import { chromium } from "playwright-core";

const FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
];

export async function browser() {
  return chromium.launch({ executablePath: process.env.FLEXURA_CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });
}

/** Opens a page from the disk and waits until it shows its result; complaints on the console are kept. */
export async function opened(context, path) {
  const page = await context.newPage();
  const complaints = [];
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  await page.goto(`file://${path}`);
  await page.waitForFunction(() => document.documentElement.dataset.ready !== undefined);
  // Two frames: the one that is queued, and the one that shows it.
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return { page, complaints };
}
