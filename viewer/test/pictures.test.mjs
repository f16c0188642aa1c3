// Pictures of the window against kept ones. A renewed one is written with FLEXURA_RENEW=1.

import assert from "node:assert/strict";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { browser, opened } from "./chrome.mjs";
import { difference, urlOf } from "./compare.mjs";
import { made, model, settled } from "./support.mjs";

let chrome;
let context;
before(async () => {
  chrome = await browser();
  context = await chrome.newContext({ viewport: { width: 900, height: 560 }, colorScheme: "light" });
});
after(() => chrome.close());

/** So small a part of the pixels may be of another colour. */
const PART = 0.01;

const KEPT = [
  ["cantilever_strip", ["solve", model("cantilever_strip")]],
  ["four_bar", ["solve", model("four_bar")]],
  ["ellipsoid_in_dish", ["solve", model("ellipsoid_in_dish")]],
  ["tendon_robot", ["solve", model("tendon_robot")]],
  ["condyle_tendon", ["solve", model("condyle_tendon")]],
  ["column_on_foundation", ["solve", model("column_on_foundation")]],
];

for (const [name, words] of KEPT) {
  test(`the picture of ${name} is the one that was kept`, async () => {
    const { page } = await opened(context, made(`kept-${name}`, ...words).page);
    // Letters are drawn with the fonts that a machine has.
    await page.evaluate(() => window.flexura.app.set("names", false));
    await settled(page);
    const picture = await page.evaluate(() => window.flexura.app.viewport.canvas.toDataURL("image/png"));
    const path = fileURLToPath(new URL(`goldens/${name}.png`, import.meta.url));
    if (process.env.FLEXURA_RENEW === "1" || !existsSync(path)) {
      assert.equal(process.env.FLEXURA_RENEW, "1", `there is no kept picture ${path}`);
      writeFileSync(path, Buffer.from(picture.split(",")[1], "base64"));
      return;
    }
    const part = await difference(page, picture, urlOf(readFileSync(path)));
    assert.ok(part < PART, `${(100 * part).toFixed(2)} % of the pixels differ from ${path}`);
    await page.close();
  });
}

test("a picture of another mechanism is not taken for the kept one", async () => {
  const { page } = await opened(context, made("kept-four_bar", "solve", model("four_bar")).page);
  const kept = (name) => urlOf(readFileSync(fileURLToPath(new URL(`goldens/${name}.png`, import.meta.url))));
  assert.ok((await difference(page, kept("four_bar"), kept("cantilever_strip"))) > 2 * PART);
  await page.close();
});
