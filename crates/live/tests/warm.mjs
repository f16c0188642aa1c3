// Times of warm steps in Node, by hand:
//
//   node crates/live/tests/warm.mjs
//
// Each step gives the model other values and solves from where it stands; what a page draws of it is timed besides.

import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";

const root = new URL("../../..", import.meta.url);
const compiled = new WebAssembly.Module(gunzipSync(readFileSync(new URL("crates/report/src/live.wasm.gz", root))));

function solver() {
  const { exports } = new WebAssembly.Instance(compiled, {});
  return (request) => {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    // Making room may move the memory.
    const room = exports.flexura_room(bytes.length);
    new Uint8Array(exports.memory.buffer, room, bytes.length).set(bytes);
    exports.flexura_answer();
    const text = new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.flexura_text(), exports.flexura_length()));
    return JSON.parse(text);
  };
}

// Model, are its unknowns found, parameter, middle and width of what it is moved over.
const CASES = [
  ["six_rod_robot", false, "length_1", 0.5, 0.02],
  ["six_rod_robot", true, "y", 0.02, 0.02],
  ["lee_frame", true, "load", 0.8, 0.8],
  ["cantilever_strip", true, "payload", 0.04, 0.04],
];
const COUNT = 400;
/** Steps before the clock starts: the module is compiled anew for speed while it runs. */
const BEFORE = 300;

for (const [name, inverse, parameter, middle, width] of CASES) {
  const ask = solver();
  const text = readFileSync(new URL(`models/${name}.toml`, root), "utf8");
  ask({ do: "open", text, name: `${name}.toml`, inverse });
  ask({ do: "solve", samples: 0 });
  for (let i = 0; i < BEFORE; i++) ask({ do: "step", values: [[parameter, middle + 0.5 * width * Math.sin((2 * Math.PI * i) / 100)]], samples: 0 });
  for (const samples of [0, 41]) {
    const times = [];
    for (let i = 0; i < COUNT; i++) {
      const value = middle + 0.5 * width * Math.sin((2 * Math.PI * i) / 100);
      const begun = performance.now();
      const answer = ask({ do: "step", values: [[parameter, value]], samples });
      times.push(performance.now() - begun);
      if (answer.way !== "near") throw new Error(`${name}: ${JSON.stringify(answer).slice(0, 300)}`);
    }
    times.sort((a, b) => a - b);
    const what = samples === 0 ? "the step alone" : `with a document of ${samples} samples a beam`;
    const kind = inverse && name === "six_rod_robot" ? "inverse" : "forward";
    console.log(`${name.padEnd(18)} ${kind}  ${what}: median ${times[COUNT / 2].toFixed(3)} ms, a quarter below ${times[COUNT / 4].toFixed(3)} ms`);
  }
}
