// The live page in a real browser: what is moved, dragged or typed is solved there, and agrees with the command.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browser, opened } from "./chrome.mjs";
import { made, madeOf, model, settled, text, written } from "./support.mjs";

/** A cantilever under a force at its tip; length and bending stiffness are one. */
const ELASTICA = text(model("elastica"));
/** Pauses longer than this are taken for the end of typing, ms. */
const TYPED = 400;
let chrome;
let context;
let page;
let complaints;

before(async () => {
  chrome = await browser();
  context = await chrome.newContext({ viewport: { width: 1400, height: 800 }, colorScheme: "light" });
  await context.addInitScript(() => {
    window.violations = [];
    document.addEventListener("securitypolicyviolation", (event) => window.violations.push(`${event.violatedDirective} ${event.blockedURI}`));
  });
  ({ page, complaints } = await opened(context, madeOf("live", ELASTICA, "solve", "--live").page));
  page.setDefaultTimeout(15_000);
  await page.waitForFunction(() => document.documentElement.dataset.live !== undefined);
});
after(() => chrome.close());

/** Waits until nothing is being solved and what came of it is drawn. */
async function idle() {
  await page.waitForFunction(() => !window.live.isBusy);
  await settled(page);
}

const tip = () => page.evaluate(() => window.flexura.app.study.document.beams.rod.position.at(-1));
const shown = () => page.evaluate(() => window.flexura.line("rod").at(-1));
const force = () => page.evaluate(() => window.flexura.app.study.document.parameters.force);
const far = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));
const native = (value) => made("native", "solve", model("elastica"), "--set", `force=${value}`).document.beams.rod.position.at(-1);

/** Mattiasson (1981): places of the tip under forces of 1 and 5, to five digits. */
const [AT_1, AT_5] = [[1 - 0.05643, 0.30172, 0], [1 - 0.38763, 0.71379, 0]];

test("the live page opens, and holds its solver in less than 4 MB", async () => {
  assert.equal(await page.evaluate(() => document.documentElement.dataset.live), "true");
  const { page: file } = made("small", "solve", model("elastica"), "--live");
  assert.ok(Buffer.byteLength(text(file)) < 4_000_000);
});

test("a slider moves the tip to where the command puts it", async () => {
  for (const part of [0.55, 0.7, 0.62]) {
    await page.locator("#parameter-force").evaluate((slider, part) => {
      slider.value = String(part * Number(slider.max));
      slider.dispatchEvent(new Event("input", { bubbles: true }));
    }, part);
    await idle();
    const wanted = native(await force());
    // Both errors are below the tolerance, 1e-8 of the length.
    assert.ok(far(await tip(), wanted) < 2e-8, `${await tip()} against ${wanted}`);
    assert.ok(far(await shown(), wanted) < 1e-6);
  }
});

test("a typed value with a unit is taken, and a wrong one refused", async () => {
  const field = page.locator("#value-force");
  await field.fill("0.005 kN");
  await field.press("Enter");
  await idle();
  assert.ok(far(await tip(), AT_5) < 2e-5, String(await tip()));
  await field.fill("5 m");
  await field.press("Enter");
  await idle();
  assert.match(await page.textContent("#live-says"), /expected/);
  assert.ok(far(await tip(), AT_5) < 2e-5);
});

test("a dragged load takes the mechanism along, by its parameter", async () => {
  const box = await page.locator("#grip-0").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const [before, forceBefore] = [await tip(), await force()];
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let i = 1; i <= 12; i++) await page.mouse.move(x + i, y + 6 * i);
  await page.mouse.up();
  await idle();
  const after = await tip();
  assert.ok(far(before, after) > 0.02, `${before} to ${after}`);
  assert.ok((await force()) < forceBefore - 0.1);
  // What it shows is an equilibrium of the force that it shows.
  assert.ok(far(after, native(await force())) < 2e-8);
});

test("the ring of a load is at its place on the screen, and arrow keys move it", async () => {
  const ring = page.locator("#grip-0");
  const [box, stage] = [await ring.boundingBox(), await page.locator("#stage").boundingBox()];
  const [x, y] = await page.evaluate(() => window.flexura.project(window.flexura.line("rod").at(-1)));
  assert.ok(Math.hypot(box.x + box.width / 2 - stage.x - x, box.y + box.height / 2 - stage.y - y) < 1.5);
  const before = await tip();
  await ring.focus();
  await ring.press("ArrowDown");
  await idle();
  assert.ok(far(before, await tip()) > 1e-3);
});

test("a mistake in the text is told at its line, and mending it solves again", async () => {
  const area = page.locator("#model-text");
  const broken = ELASTICA.replace('length = "1 m"', 'lenght = "1 m"');
  const line = broken.split("\n").findIndex((text) => text.includes("lenght")) + 1;
  const before = await tip();
  await area.fill(broken);
  await page.waitForFunction(() => document.querySelectorAll("#problems .wrong").length > 0);
  await idle();
  assert.ok((await page.textContent("#problems")).includes(`line ${line}: `));
  const marked = await page.evaluate(() => [...document.querySelectorAll(".gutter .wrong")].map((row) => Number(row.textContent)));
  assert.ok(marked.includes(line), `${marked}`);
  const heights = await page.evaluate(() => [...document.querySelectorAll(".mark.wrong")].map((mark) => mark.style.top));
  assert.ok(heights.includes(`${18 * (line - 1)}px`), `${heights}`);
  assert.deepEqual(await tip(), before);
  await area.fill(ELASTICA.replace('force = "10 N"', 'force = "1 N"'));
  await page.waitForFunction(() => document.querySelectorAll("#problems .wrong").length === 0);
  await idle();
  assert.ok(far(await tip(), AT_1) < 2e-5, String(await tip()));
});

test("a driven body is dragged: the robot's plate goes where the pointer is, and its rods follow", async () => {
  const { page: robot, complaints: said } = await opened(context, made("robot", "solve", model("six_rod_robot"), "--live").page);
  await robot.waitForFunction(() => document.documentElement.dataset.live !== undefined && !window.live.isBusy);
  await robot.evaluate(() => window.flexura.look("right"));
  await settled(robot);
  const ring = robot.locator(".grip.drive");
  const middle = async () => {
    const box = await ring.boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const state = () =>
    robot.evaluate(() => {
      const { bodies, parameters, status } = window.flexura.app.study.document;
      return { plate: bodies.plate.position, lengths: [1, 2, 3, 4, 5, 6].map((i) => parameters[`length_${i}`]), status };
    });
  const [[x, y], before] = [await middle(), await state()];
  await robot.mouse.move(x, y);
  await robot.mouse.down();
  for (let i = 1; i <= 10; i++) await robot.mouse.move(x + 4 * i, y - 2 * i);
  await robot.waitForFunction(() => !window.live.isBusy);
  await robot.mouse.up();
  await robot.waitForFunction(() => !window.live.isBusy);
  await settled(robot);
  const [after, [newX, newY]] = [await state(), await middle()];
  assert.equal(after.status, "converged");
  assert.ok(Math.hypot(newX - x - 40, newY - y + 20) < 3, `${newX - x}, ${newY - y}`);
  assert.ok(after.plate[1] > before.plate[1] + 5e-3 && after.plate[2] > before.plate[2] + 2e-3, `${after.plate}`);
  assert.ok(after.lengths.some((length, i) => Math.abs(length - before.lengths[i]) > 1e-3));
  assert.deepEqual(said, []);
  await robot.close();
});

test("the live page works in a frame, as a notebook has it", async () => {
  const escaped = text(made("framed", "solve", model("lee_frame"), "--live").page).replaceAll("&", "&amp;").replaceAll('"', "&quot;");
  const host = written("live-host.html", `<!doctype html><iframe width="1200" height="700" srcdoc="${escaped}"></iframe>`);
  const outer = await context.newPage();
  await outer.goto(`file://${host}`);
  const frame = await (await outer.waitForSelector("iframe")).contentFrame();
  await frame.waitForFunction(() => document.documentElement.dataset.live !== undefined && !window.live?.isBusy);
  assert.equal(await frame.evaluate(() => document.documentElement.dataset.live), "true");
  await frame.locator("#value-load").fill("0.5");
  await frame.locator("#value-load").press("Enter");
  await frame.waitForFunction(() => window.flexura.app.study.document.parameters.load === 0.5);
  await outer.close();
});

test("a text that tries to be markup stays text", async () => {
  const evil = ELASTICA.replace('name = "elastica"', 'name = "</script><img src=x onerror=\'window.hit=1\'>"');
  for (const content of [`${evil}\n[load."<b onclick=1>"]\n`, evil]) {
    await page.locator("#model-text").fill(content);
    await page.waitForTimeout(TYPED);
    await idle();
  }
  assert.equal(await page.evaluate(() => window.hit), undefined);
  assert.ok((await page.textContent("h1")).startsWith("</script>"));
  await page.locator("#model-text").fill(ELASTICA);
  await page.waitForTimeout(TYPED);
  await idle();
});

test("a path is traced in the page, and a slider leads back to the equilibrium", async () => {
  const kind = () => page.evaluate(() => window.flexura.app.study.kind);
  await page.click("#live-trace");
  await idle();
  assert.equal(await kind(), "trace");
  assert.ok((await page.evaluate(() => window.flexura.app.study.branches[0].points.length)) > 10);
  await page.locator("#parameter-force").press("ArrowRight");
  await idle();
  assert.equal(await kind(), "solve");
});

test("what the solver does can be ended, and the page solves on after that", async () => {
  await page.evaluate(() => {
    document.querySelector("#live-trace").click();
    document.querySelector("#live-stop").click();
  });
  await idle();
  await page.locator("#value-force").fill("1 N");
  await page.locator("#value-force").press("Enter");
  await idle();
  assert.ok(far(await tip(), AT_1) < 2e-5, String(await tip()));
});

test("nothing was complained about, and nothing went against the page's policy", async () => {
  assert.deepEqual(complaints, []);
  assert.deepEqual(await page.evaluate(() => window.violations), []);
});
