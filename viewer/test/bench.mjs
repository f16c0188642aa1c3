// Times that a person waits: no test, since a busy machine would fail it.

import { browser, opened } from "./chrome.mjs";
import { BENT, made, madeOf, model, settled, shown, text } from "./support.mjs";

const chrome = await browser();
const context = await chrome.newContext({ viewport: { width: 1200, height: 760 } });
const LONG = 50;

/** The median of several runs in the page, ms. */
async function median(page, run) {
  const times = [];
  for (let i = 0; i < 9; i++) times.push(await page.evaluate(run));
  return times.sort((a, b) => a - b)[4];
}

async function timed(what, path, runs = {}) {
  const start = performance.now();
  const { page } = await opened(context, path);
  console.log(`${what}: open after ${(performance.now() - start).toFixed(0)} ms`);
  await settled(page);
  for (const [name, run] of Object.entries(runs)) {
    const time = await median(page, run);
    console.log(`  ${name}: ${time.toFixed(1)} ms${time > LONG ? " (a long task)" : ""}`);
  }
  await page.close();
}

const frame = () => {
  const start = performance.now();
  window.flexura.app.draw();
  window.flexura.app.viewport.draw();
  return performance.now() - start;
};
await timed("strip", madeOf("strip", BENT.replace("0 N", "2 N")).page, { frame });
await timed("lattice of a thousand beams", made("lattice", "solve", model("lattice"), "--set", "n=23").page, { frame });

const { document } = madeOf("path", BENT, "trace", "--parameter", "push", "--range", "0 N:4 N");
const some = document.branches[0].points.at(-1);
const points = Array.from({ length: 10_000 }, (_, i) => ({
  ...some,
  beams: i % 100 === 0 ? some.beams : undefined,
  parameter: i / 1000,
  outputs: { down: Math.sin(i / 500), across: 0.2 - i / 1e5 },
  stable: i % 3000 < 2000,
}));
await timed("path of 10 000 points", shown("path", { ...document, branches: [{ ...document.branches[0], points }] }), {
  "plot anew": () => {
    const start = performance.now();
    window.flexura.app.plot.show(0, 1);
    return performance.now() - start;
  },
  "move to a point": () => {
    const start = performance.now();
    window.flexura.go({ branch: 0, point: 5000 });
    return performance.now() - start;
  },
});

// Warm steps in the worker of the live page: other values, solved from where it stands; without what is drawn of them.
for (const [name, inverse, parameter, middle, width] of [
  ["six_rod_robot", false, "length_1", 0.5, 0.02],
  ["six_rod_robot", true, "y", 0.02, 0.02],
  ["lee_frame", true, "load", 0.8, 0.8],
]) {
  const { page } = await opened(context, made(`live-${name}`, "solve", model(name), "--live").page);
  await page.waitForFunction(() => document.documentElement.dataset.live !== undefined);
  const took = await page.evaluate(
    async ({ text, inverse, parameter, middle, width }) => {
      const ask = (request) => window.live.solver.ask(request);
      await ask({ do: "open", text, name: "model.toml", inverse });
      await ask({ do: "solve", samples: 0 });
      const times = [];
      for (let i = 0; i < 600; i++) {
        const value = middle + 0.5 * width * Math.sin((2 * Math.PI * i) / 100);
        const answer = await ask({ do: "step", values: [[parameter, value]], samples: 0 });
        if (answer.way !== "near") throw new Error(JSON.stringify(answer).slice(0, 300));
        if (i >= 300) times.push(answer.took);
      }
      return times.sort((a, b) => a - b)[150];
    },
    { text: text(model(name)), inverse, parameter, middle, width },
  );
  console.log(`${name}, ${inverse && name === "six_rod_robot" ? "inverse" : "forward"}: a warm step takes ${took.toFixed(2)} ms in the page`);
  await page.close();
}
await chrome.close();
