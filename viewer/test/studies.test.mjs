// Studies with many states: each shows its own mechanism, and what is chosen is shown.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browser, opened } from "./chrome.mjs";
import { BENT, made, madeOf, model, settled, shown, text } from "./support.mjs";

let chrome;
let context;
before(async () => {
  chrome = await browser();
  context = await chrome.newContext({ viewport: { width: 1200, height: 760 }, colorScheme: "light", permissions: ["clipboard-read", "clipboard-write"] });
});
after(() => chrome.close());

/** The length of the strip at rest and now, as they are drawn. */
const lengths = (page) =>
  page.evaluate(() => {
    const { scene, lines } = window.flexura.app.seen();
    return [scene.beams.strip.s.at(-1), lines.get("strip").s.at(-1), scene.beams.strip.position.at(-1)[0]];
  });

test("a length that is swept changes the mechanism that is shown", async () => {
  const toml = BENT.replace('push = "0 N"', 'push = "1 N"\nlength = "200 mm"').replace('length = "200 mm"\nstart', "length = \"length\"\nstart");
  const { page: path, document } = madeOf("lengths", toml, "sweep", "--vary", "length=100 mm:300 mm:3");
  const { page } = await opened(context, path);
  for (const [point, wanted] of [[0, 0.1], [2, 0.3], [1, 0.2]]) {
    await page.evaluate((point) => window.flexura.go({ branch: 0, point }), point);
    for (const length of await lengths(page)) assert.ok(Math.abs(length - wanted) < 1e-6, `${length} ${wanted}`);
  }
  assert.ok(document.samples[1].scene && !document.samples[0].scene);
  await page.close();
});

test("lines across upright axes choose a sample", async () => {
  const { page: path } = made("parallel", "sweep", model("four_bar"), "--vary", "crank=0 deg:40 deg:5", "--vary", "lean=0:0.3:3");
  const { page } = await opened(context, path);
  await page.evaluate(() => document.querySelector("#parallel canvas").scrollIntoView());
  const box = await page.locator("#parallel canvas").boundingBox();
  const seen = new Set();
  // Across the first axis from its lower end to its upper one lie the samples in the order of the crank.
  for (const part of [0.04, 0.96]) {
    await page.mouse.click(box.x + 48, box.y + 34 + (1 - part) * (box.height - 56));
    await settled(page);
    const { point } = await page.evaluate(() => window.flexura.spot);
    seen.add(point);
    const crank = await page.evaluate((point) => window.flexura.app.study.branches[0].points[point].values[0], point);
    assert.ok(Math.abs(crank - (part < 0.5 ? 0 : (40 * Math.PI) / 180)) < 1e-9, `${crank}`);
  }
  assert.equal(seen.size, 2);
  await page.close();
});

test("a sample that did not converge can be chosen and says why", async () => {
  const { document } = made("failing", "sweep", model("lee_frame"), "--vary", "load=1:2.5:2");
  assert.notEqual(document.samples[1].status, "converged");
  const { page } = await opened(context, shown("failing", document));
  await page.evaluate(() => window.flexura.go({ branch: 0, point: 1 }));
  await settled(page);
  assert.match(await page.textContent("#said"), /NOT CONVERGED: stalled/);
  assert.ok((await page.textContent("#table")).includes(document.samples[1].reason));
  await page.evaluate(() => window.flexura.go({ branch: 0, point: 0 }));
  await settled(page);
  assert.doesNotMatch(await page.textContent("#said"), /stalled/);
  await page.close();
});

test("several equilibria under one load are chosen in the legend", async () => {
  const { page: path, document } = made("equilibria", "solve", model("bistable_beam"), "--guesses", "12");
  const { page } = await opened(context, path);
  const count = document.equilibria.length;
  assert.equal(await page.locator("#legend li").count(), count + 1);
  for (const i of [1, count]) {
    await page.click(`#go-branch-${i}`);
    await settled(page);
    const line = await page.evaluate(() => window.flexura.line("leaf"));
    assert.deepEqual(line, document.equilibria[i - 1].shape.beams.leaf.position);
    const table = await page.textContent("#table");
    assert.ok(table.includes(document.equilibria[i - 1].stable ? "stable" : "unstable"));
  }
  await page.close();
});

test("the curve of a critical point in two parameters is a plot of its own", async () => {
  const { page: path, document } = made("critical", "run", model("shallow_arch"));
  const [name] = Object.keys(document.studies ?? { "": 0 });
  const study = document.studies ? Object.entries(document.studies).find(([, own]) => own.critical) : [name, document];
  const { page } = await opened(context, path);
  await page.selectOption("#study", { label: `${study[0]}, critical curve` });
  await settled(page);
  const points = study[1].critical.points;
  const values = await page.evaluate(() => window.flexura.app.study.branches[0].points.map((point) => point.values.slice(0, 2)));
  assert.deepEqual(values, points.map((point) => [point.second_parameter, point.parameter]));
  assert.ok(await page.isVisible("#plot"));
  // Every point of it is drawn, with the thickness that it has there.
  for (const point of [0, points.length - 1]) {
    await page.evaluate((point) => window.flexura.go({ branch: 0, point }), point);
    const height = await page.evaluate(() => Object.values(window.flexura.app.seen().scene.beams)[0].width[0]);
    assert.ok(Math.abs(height - points[point].second_parameter) < 1e-9, `${height} ${points[point].second_parameter}`);
  }
  await page.close();
});

test("a path opens where it ends stable, else where it was stable last", async () => {
  const { page: path, document } = made("opening", "run", model("euler_clamped_pinned"), "path");
  const { page } = await opened(context, path);
  const { branch, point } = await page.evaluate(() => window.flexura.spot);
  assert.equal(document.branches[branch].points[point].stable, true);
  await page.close();
});

test("displacements that are only rounded numbers get no factor", async () => {
  const { page: path } = made("rounded", "sweep", model("euler_clamped_pinned"), "--vary", "push=1:30:6", "--vary", "length=100 mm:300 mm:4");
  const { page } = await opened(context, path);
  assert.equal(await page.evaluate(() => window.flexura.app.proposal), 1);
  await page.close();
});

test("a path that could not be followed to its end says where and why", async () => {
  const { document } = made("broken", "run", model("lee_frame"), "path");
  const [branch] = document.branches;
  const broken = { ...document, status: "stalled", reason: "no way on", branches: [{ ...branch, ends: ["start", "stalled"], end_reasons: [null, "the steps became too short"] }] };
  const { page } = await opened(context, shown("broken", broken));
  assert.ok((await page.textContent("#table")).includes("stalled: the steps became too short"));
  assert.match(await page.textContent(".marks"), /— stable +- - unstable +○ fold +× not followed further/);
  const red = await page.evaluate((point) => {
    const canvas = document.querySelector("#plot canvas");
    const [x, y] = window.flexura.locate({ branch: 0, point });
    const box = canvas.getBoundingClientRect();
    window.flexura.go({ branch: 0, point: 0 });
    const scale = canvas.width / box.width;
    const { data } = canvas.getContext("2d").getImageData(Math.round((x - box.left) * scale) - 1, Math.round((y - box.top) * scale) - 1, 3, 3);
    return [...data].filter((_, i) => i % 4 === 0 && data[i] > 150 && data[i + 1] < 80).length;
  }, branch.points.length - 1);
  assert.ok(red > 0);
  await page.close();
});

test("any column can be plotted over any other", async () => {
  const { page: path, document } = made("columns", "run", model("lee_frame"), "path");
  const { page } = await opened(context, path);
  const spread = async (across, up) => {
    await page.selectOption("#plot-across", { label: across });
    await page.selectOption("#plot-up", { label: up });
    await settled(page);
    const points = document.branches[0].points;
    const value = (point, name) => (name === "load" ? point.parameter : point.outputs[name]);
    const most = (name) => points.reduce((best, point, i) => (value(point, name) > value(points[best], name) ? i : best), 0);
    const places = await page.evaluate((list) => list.map((point) => window.flexura.locate({ branch: 0, point })), [0, most(across), most(up)]);
    // The largest value lies farthest right, or highest.
    assert.ok(places[1][0] >= places[0][0] && places[2][1] <= places[0][1], `${across} ${up}: ${places}`);
  };
  await spread("load", "down");
  await spread("angle", "right");
  await page.close();
});

test("the whole table can be copied, and the model file", async () => {
  const { page } = await opened(context, madeOf("copied", BENT).page);
  const clipboard = () => page.evaluate(() => navigator.clipboard.readText());
  await page.click("#copy-table");
  await page.waitForFunction(() => navigator.clipboard.readText().then((text) => text.includes("Outputs\tdown\t")));
  assert.match(await clipboard(), /^Status\tstatus\tconverged\t$/m);
  await page.click(".model summary");
  await page.click("#copy-model");
  await page.waitForFunction((wanted) => navigator.clipboard.readText().then((text) => text === wanted), BENT);
  await page.close();
});

test("largest stress stands beside the safety factor, and warnings where they are read", async () => {
  const { page: path, document } = made("table", "solve", model("cantilever_strip"));
  const { page } = await opened(context, path);
  const [name, beam] = Object.entries(document.beams)[0];
  const safety = document.scene.beams[name].yield_strength / Math.max(...beam.stress);
  const table = await page.textContent("#table");
  assert.ok(table.includes(`safety ${safety.toPrecision(3)}`), table);
  const warned = await opened(context, shown("warned", { ...document, warnings: ["look twice"] }));
  assert.equal(await warned.page.textContent("#table .warning td:last-child"), "look twice");
  await page.close();
  await warned.page.close();
});

test("a motion in time plays in the order of its times, and starts again", async () => {
  const { page: path, document } = made("played", "run", model("rigid_four_bar"), "turn");
  const { page } = await opened(context, path);
  assert.deepEqual(await page.evaluate(() => window.flexura.spot), { branch: 0, point: 0 });
  await page.click("#play");
  const seen = [];
  for (let i = 0; i < 6; i++) {
    await page.waitForTimeout(100);
    seen.push(await page.evaluate(() => window.flexura.spot.point));
  }
  await page.click("#play");
  assert.ok(seen.at(-1) !== seen[0], String(seen));
  const last = document.times.length - 1;
  await page.evaluate((point) => window.flexura.go({ branch: 0, point }), last);
  const body = Object.keys(document.bodies)[0];
  const now = await page.evaluate((body) => window.flexura.app.seen().bodies.get(body).p, body);
  assert.deepEqual(now, document.bodies[body].position[last]);
  await page.close();
});

test("full screen is taken and left", async () => {
  const { page } = await opened(context, madeOf("whole", BENT).page);
  await page.click("#full-screen");
  await page.waitForFunction(() => document.fullscreenElement !== null);
  await page.click("#full-screen");
  await page.waitForFunction(() => document.fullscreenElement === null);
  await page.close();
});

test("numbers of every point go into the table file, and formulas stay text", async () => {
  const { document } = madeOf("formula", BENT);
  const hostile = { ...document, outputs: { "=1+1": 2, "-x": 3, 'a,"b"': [1, 2, 3] }, scene: { ...document.scene, units: { outputs: {}, parameters: {} } } };
  const { page } = await opened(context, shown("formula", hostile));
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-csv")]);
  const rows = text(await download.path()).split("\n");
  assert.ok(rows.includes("Outputs,'=1+1,2,") && rows.includes("Outputs,'-x,3,") && rows.includes('Outputs,"a,""b""",1 2 3,'), rows.join("\n"));
  await page.close();
});
