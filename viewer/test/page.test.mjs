// What a person does with the page, in a real browser.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browser, opened } from "./chrome.mjs";
import { BENT, made, madeOf, model, pixels, settled, text, written } from "./support.mjs";

let chrome;
let context;
let bent;
let lee;

before(async () => {
  chrome = await browser();
  context = await chrome.newContext({ viewport: { width: 1200, height: 760 }, colorScheme: "light", acceptDownloads: true });
  bent = madeOf("bent", BENT, "trace", "--parameter", "push", "--range", "0 N:4 N");
  lee = made("lee", "run", model("lee_frame"), "path");
});
after(() => chrome.close());

const STUDIES = [
  ["a solve", () => made("solved", "solve", model("cantilever_strip"))],
  ["a path", () => lee],
  ["buckling", () => made("buckled", "run", model("euler_clamped_pinned"), "loads")],
  ["a motion in time", () => made("moved", "run", model("rigid_four_bar"), "turn")],
  ["a sweep", () => made("swept", "sweep", model("four_bar"), "--vary", "crank=0 deg:40 deg:4")],
  ["all studies of a file", () => made("all", "run", model("euler_clamped_pinned"))],
  ["surfaces in contact", () => made("dish", "solve", model("ellipsoid_in_dish"))],
  ["tendons", () => made("robot", "solve", model("tendon_robot"))],
  ["concentric tubes", () => made("tubes", "solve", model("concentric_tubes"))],
  ["a foundation", () => made("column", "solve", model("column_on_foundation"))],
];
for (const [what, make] of STUDIES) {
  test(`${what} opens without a complaint and shows something`, async () => {
    const { page, complaints } = await opened(context, make().page);
    assert.deepEqual(complaints, []);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.ready), "true");
    const { colours, drawn } = await pixels(page);
    assert.ok(colours > 20 && drawn > 300, `${colours} colours, ${drawn} pixels`);
    await page.close();
  });
}

test("every point of a path that was asked for as a document carries its shape", () => {
  const points = bent.document.branches.flatMap((branch) => branch.points);
  assert.ok(points.length > 10);
  assert.equal(points.filter((point) => point.beams || point.shape).length, points.length);
});

test("the slider moves the tip on the screen to where the data say", async () => {
  const { page } = await opened(context, bent.page);
  for (const option of ["loads", "names", "ghost"]) await page.evaluate((name) => window.flexura.app.set(name, false), option);
  await page.selectOption("#camera", { label: "parallel" });
  await page.click("#view-xz");
  const points = bent.document.branches[0].points;
  const seen = [];
  for (const part of [0.3, 0.65, 1]) {
    const index = Math.round(part * (points.length - 1));
    await page.locator("#slider").fill(String(index));
    await settled(page);
    const { across, down } = points[index].outputs;
    const [x, y] = await page.evaluate((p) => window.flexura.project(p), [across, 0, -down]);
    const { box } = await pixels(page);
    assert.ok(Math.abs(box.right - x) < 4, `the tip is drawn at x = ${box.right}, the data say ${x}`);
    assert.ok(Math.abs(box.bottom - y) < 4, `the tip is drawn at y = ${box.bottom}, the data say ${y}`);
    seen.push([x, y, across, down]);
  }
  // A second way: in a parallel view lengths on the screen are in proportion to those in space.
  const [a, , c] = seen;
  const perMetre = (await page.evaluate(() => 1 / window.flexura.app.viewport.metresPerPixel));
  assert.ok(Math.abs(c[0] - a[0] - perMetre * (c[2] - a[2])) < 0.5);
  assert.ok(Math.abs(c[1] - a[1] - perMetre * (c[3] - a[3])) < 0.5);
  await page.close();
});

test("a click on the plot moves the mechanism to the nearest point", async () => {
  const { page } = await opened(context, lee.page);
  const fold = lee.document.branches[0].points.findIndex((point) => point.kind === "fold");
  const [x, y] = await page.evaluate((point) => window.flexura.locate({ branch: 0, point }), fold);
  await page.mouse.click(x + 3, y - 2);
  await settled(page);
  assert.deepEqual(await page.evaluate(() => window.flexura.spot), { branch: 0, point: fold });
  const caption = await page.evaluate(() => window.flexura.app.viewport.overlay.caption);
  assert.match(caption, /load = 1\.85\d.*fold/);
  const line = await page.evaluate(() => window.flexura.line("column"));
  const wanted = lee.document.branches[0].points[fold].beams.column.position;
  assert.deepEqual(line[line.length - 1], wanted[wanted.length - 1]);
  await page.close();
});

test("the legend hides a branch and goes to one", async () => {
  const { page: path } = made("branches", "run", model("euler_clamped_pinned"), "path");
  const { page } = await opened(context, path);
  const ink = () =>
    page.evaluate(() => {
      const canvas = document.querySelector("#plot canvas");
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 0 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60) count++;
      return count;
    });
  const all = await ink();
  await page.click("#branch-1");
  await settled(page);
  assert.ok((await ink()) < all);
  await page.click("#branch-1");
  await page.click("#go-branch-1");
  await settled(page);
  assert.equal(await page.evaluate(() => window.flexura.spot.branch), 1);
  await page.close();
});

test("dark and light follow the system and the button", async () => {
  const night = await chrome.newContext({ viewport: { width: 1000, height: 700 }, colorScheme: "dark" });
  const { page } = await opened(night, bent.page);
  const ground = async () => (await pixels(page)).ground.split(",").map(Number);
  assert.ok(Math.max(...(await ground())) < 60);
  await page.click("#theme");
  await settled(page);
  assert.ok(Math.min(...(await ground())) > 200);
  await night.close();
});

test("the page works inside a frame, as a notebook shows it", async () => {
  const escaped = text(bent.page).replace(/&/g, "&amp;").replace(/"/g, "&quot;");
  for (const sandbox of ["", 'sandbox="allow-scripts"']) {
    const host = written("host.html", `<!doctype html><iframe ${sandbox} width="1000" height="700" srcdoc="${escaped}"></iframe>`);
    const page = await context.newPage();
    const complaints = [];
    page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    await page.goto(`file://${host}`);
    const frame = page.frames()[1];
    await frame.waitForFunction(() => document.documentElement.dataset.ready !== undefined);
    assert.equal(await frame.evaluate(() => document.documentElement.dataset.ready), "true");
    const { drawn } = await pixels(frame);
    assert.ok(drawn > 300);
    assert.deepEqual(complaints, []);
    await page.close();
  }
});

test("the keyboard turns, zooms, fits and plays", async () => {
  const { page } = await opened(context, bent.page);
  const tip = () => page.evaluate(() => window.flexura.project([0.2, 0, 0]));
  await page.focus("canvas.overlay");
  const start = await tip();
  await page.keyboard.press("ArrowLeft");
  await settled(page);
  const turned = await tip();
  assert.ok(Math.abs(turned[0] - start[0]) > 3);
  await page.keyboard.press("+");
  await settled(page);
  assert.notDeepEqual(await tip(), turned);
  await page.keyboard.press("f");
  await settled(page);
  const fitted = await tip();
  assert.ok(Math.hypot(fitted[0] - start[0], fitted[1] - start[1]) < 0.5);
  await page.keyboard.press("Shift+ArrowRight");
  await settled(page);
  const shifted = await tip();
  // By thirty pixels in the middle of what is seen; the tip is a little nearer.
  const way = shifted[0] - fitted[0];
  assert.ok(way > 25 && way < 40 && Math.abs(shifted[1] - fitted[1]) < 1, `${shifted} ${fitted}`);
  await page.evaluate(() => window.flexura.go({ branch: 0, point: 0 }));
  await page.keyboard.press(" ");
  await page.waitForFunction(() => window.flexura.spot.point > 3);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => window.flexura.app.isPlaying), false);
  await page.close();
});

test("everything that can be used has a name for a screen reader", async () => {
  const { page } = await opened(context, lee.page);
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, canvas.overlay, aside, section, #plot")]
      .filter((element) => !(element.getAttribute("aria-label") || element.textContent.trim() || element.labels?.length))
      .map((element) => element.outerHTML.slice(0, 80)),
  );
  assert.deepEqual(nameless.filter((html) => !html.startsWith("<section")), []);
  await page.close();
});

test("displacements too small to be seen get a factor, which is written on the picture", async () => {
  const stiff = BENT.replace('push = "0 N"', 'push = "2 mN"');
  const { page } = await opened(context, madeOf("stiff", stiff).page);
  const tip = () => page.evaluate(() => window.flexura.line("strip").at(-1)[2]);
  const before = await tip();
  assert.equal(await page.evaluate(() => window.flexura.app.viewport.overlay.magnification), 1);
  assert.ok(await page.isVisible("#propose"));
  await page.click("#propose");
  await settled(page);
  const factor = await page.evaluate(() => window.flexura.app.viewport.overlay.magnification);
  assert.ok(factor > 10);
  assert.ok(Math.abs((await tip()) / before / factor - 1) < 1e-9);
  await page.close();
});

test("a result that did not converge says so on the picture and in the table", async () => {
  const { page: path, document } = made("stalled", "solve", model("lee_frame"), "--set", "load=2.5");
  assert.equal(document.status, "stalled");
  const { page } = await opened(context, path);
  assert.match(await page.evaluate(() => window.flexura.app.viewport.overlay.alarm), /^NOT CONVERGED: stalled at \d/);
  assert.equal(await page.textContent(".chip"), "stalled");
  assert.ok((await page.textContent("#table")).includes(document.reason));
  await page.close();
});

test("picture and table can be saved", async () => {
  const { page } = await opened(context, bent.page);
  const saved = async (button) => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
    return { name: download.suggestedFilename(), content: text(await download.path()), path: await download.path() };
  };
  const picture = await saved("#save-picture");
  assert.equal(picture.name, "bent_strip.png");
  assert.ok(picture.content.slice(1, 4) === "PNG");
  const table = await saved("#save-csv");
  const rows = table.content.trim().split("\n");
  assert.equal(rows[0], "branch,point,kind,push [N],down [m],across [m],arc,stable,note");
  assert.equal(rows.length - 1, bent.document.branches[0].points.length);
  assert.equal(Number(rows.at(-1).split(",")[4]), bent.document.branches[0].points.at(-1).outputs.down);
  await page.close();
});

test("the shape of a mode swings to both sides", async () => {
  const { page } = await opened(context, made("modes", "run", model("euler_clamped_pinned"), "loads").page);
  const middle = () =>
    page.evaluate(() => {
      const line = window.flexura.line("column");
      const ends = [line[0], line.at(-1)];
      return line.map((p) => Math.hypot(p[1] - ends[0][1], p[2] - ends[0][2])).reduce((a, b) => Math.max(a, b));
    });
  const sides = [];
  for (const phase of [-100, 0, 100]) {
    await page.locator("#slider").fill(String(phase));
    sides.push(await middle());
  }
  assert.ok(sides[0] > 0 && Math.abs(sides[0] - sides[2]) < 1e-9 && sides[1] < 1e-9, String(sides));
  await page.close();
});

test("a point of a sweep opens its shape", async () => {
  const { page: path, document } = made("swept", "sweep", model("four_bar"), "--vary", "crank=0 deg:40 deg:4");
  const { page } = await opened(context, path);
  const [x, y] = await page.evaluate(() => window.flexura.locate({ branch: 0, point: 3 }));
  await page.mouse.click(x, y);
  await settled(page);
  const line = await page.evaluate(() => window.flexura.line("coupler"));
  assert.deepEqual(line, document.samples[3].shape.beams.coupler.position);
  await page.close();
});
