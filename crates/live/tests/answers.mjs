// Opens and solves models with the solver of the page; one line of JSON for each.
//
//   node answers.mjs live.wasm.gz SAMPLES MODEL.toml ...

import { readFileSync } from "node:fs";
import { basename } from "node:path";
import { gunzipSync } from "node:zlib";

const [module, samples, ...models] = process.argv.slice(2);
const compiled = new WebAssembly.Module(gunzipSync(readFileSync(module)));

function solver() {
  const { exports } = new WebAssembly.Instance(compiled, {});
  return (request) => {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    // Making room may move the memory.
    const room = exports.flexura_room(bytes.length);
    new Uint8Array(exports.memory.buffer, room, bytes.length).set(bytes);
    exports.flexura_answer();
    return new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.flexura_text(), exports.flexura_length()));
  };
}

for (const path of models) {
  const name = basename(path);
  let answer;
  try {
    const ask = solver();
    const opened = JSON.parse(ask({ do: "open", text: readFileSync(path, "utf8"), name }));
    answer = opened.opened ? JSON.parse(ask({ do: "solve", samples: Number(samples) })) : opened;
  } catch (error) {
    answer = { broken: String(error) };
  }
  process.stdout.write(`${JSON.stringify({ name, answer })}\n`);
}
