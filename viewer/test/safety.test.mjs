// Names and texts that would be something else if they were taken for markup, and the limits of what is drawn.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browser, opened } from "./chrome.mjs";
import { BENT, made, madeOf, model, pixels, settled, shown } from "./support.mjs";

let chrome;
let context;
before(async () => {
  chrome = await browser();
  context = await chrome.newContext({ viewport: { width: 1200, height: 760 } });
});
after(() => chrome.close());

const HOSTILE = [
  "</script><script>window.hacked = 1</script>",
  "\"><img src=x onerror=\"window.hacked = 1\">",
  "<!-- <script> ' \" & \\ ]]> \u2028 ${window.hacked = 1}",
  "x".repeat(10_000),
];
HOSTILE.forEach((name, i) => {
  test(`a name of a mechanism stays a name: ${name.slice(0, 30)}`, async () => {
    const toml = BENT.replace('name = "bent strip"', `name = ${JSON.stringify(name)}\n# ${name.replace(/\u2028/g, " ")}`);
    const { page, complaints } = await opened(context, madeOf(`hostile-${i}`, toml).page);
    assert.deepEqual(complaints, []);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.equal(await page.textContent("h1"), name);
    assert.ok((await page.textContent("#model")).includes(name.slice(0, 20)));
    assert.ok((await pixels(page)).drawn > 300);
    await page.close();
  });
});

test("names of everything in a document stay names", async () => {
  const name = "</script><img src=x onerror=window.hacked=1>";
  const { document } = madeOf("plain", BENT);
  const text = JSON.stringify(document).replaceAll('"strip"', JSON.stringify(name)).replaceAll('"tip"', JSON.stringify(name)).replaceAll('"down"', JSON.stringify(name));
  const hostile = { ...JSON.parse(text), warnings: [name], reason: name, status: name };
  const { page, complaints } = await opened(context, shown("hostile-names", hostile));
  assert.deepEqual(complaints, []);
  assert.equal(await page.evaluate(() => window.hacked), undefined);
  assert.ok((await page.textContent("#table")).includes(name));
  await page.close();
});

test("the page's policy refuses scripts that are not its own, and every connection", async () => {
  const { page } = await opened(context, madeOf("policy", BENT).page);
  const refused = await page.evaluate(async () => {
    const script = document.createElement("script");
    script.textContent = "window.hacked = 1";
    document.body.append(script);
    // In a task of its own: what the test itself runs may do more than the page.
    const evaluated = await new Promise((done) => {
      setTimeout(() => {
        try {
          done(new Function("return true")());
        } catch {
          done(false);
        }
      });
    });
    const fetched = await fetch("data:text/plain,x").then(() => true, () => false);
    return { hacked: window.hacked ?? null, evaluated, fetched };
  });
  assert.deepEqual(refused, { hacked: null, evaluated: false, fetched: false });
  await page.close();
});

test("a broken page says what is wrong", async () => {
  const { page } = await opened(context, shown("empty", { flexura: "0", study: "trace", status: "converged", model: "m" }));
  assert.equal(await page.evaluate(() => document.documentElement.dataset.ready), "true");
  assert.match(await page.evaluate(() => window.flexura.app.viewport.overlay.alarm), /no shapes/);
  await page.close();
});

test("a lattice of a thousand beams is drawn with few triangles and draw calls", async () => {
  const { page: path, document } = made("lattice", "solve", model("lattice"), "--set", "n=23");
  assert.ok(Object.keys(document.beams).length > 1000);
  const { page, complaints } = await opened(context, path);
  assert.deepEqual(complaints, []);
  for (const option of ["reactions", "frames", "names", "ghost"]) await page.evaluate((name) => window.flexura.app.set(name, true), option);
  await settled(page);
  const { triangles, calls } = await page.evaluate(() => window.flexura.counts);
  console.log(`lattice: ${triangles} triangles, ${calls} draw calls`);
  assert.ok(triangles < 200_000 && calls <= 20, `${triangles} triangles, ${calls} calls`);
  await page.close();
});

test("a path of ten thousand points is plotted, and a click finds a point on it", async () => {
  const { document } = madeOf("short", BENT, "trace", "--parameter", "push", "--range", "0 N:4 N");
  const [first, ...rest] = document.branches[0].points;
  const points = Array.from({ length: 10_000 }, (_, i) => ({
    ...(i % 1000 === 0 ? first : rest[0]),
    beams: i % 1000 === 0 ? first.beams : undefined,
    shape: i % 10 === 5 ? rest[0].shape : undefined,
    parameter: i / 1000,
    outputs: { down: 0.1 * Math.sin(i / 500), across: 0.2 - i / 1e5 },
    stable: i % 3000 < 2000,
  }));
  const long = { ...document, branches: [{ ...document.branches[0], points }] };
  const { page, complaints } = await opened(context, shown("long", long));
  assert.deepEqual(complaints, []);
  const spent = await page.evaluate(() => {
    const start = performance.now();
    window.flexura.app.plot.show(0, 1);
    return performance.now() - start;
  });
  console.log(`10 000 points plotted in ${spent.toFixed(1)} ms`);
  await settled(page);
  const [x, y] = await page.evaluate(() => window.flexura.locate({ branch: 0, point: 5005 }));
  await page.mouse.click(x, y);
  assert.equal(await page.evaluate(() => window.flexura.spot.point), 5005);
  await page.close();
});
