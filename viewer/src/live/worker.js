// What runs beside the page: the solver. One request at a time, and its answer.

let solver;

self.onmessage = async ({ data }) => {
  try {
    if (data.module) {
      solver = (await WebAssembly.instantiate(data.module, {})).exports;
      self.postMessage({ id: data.id, text: "{}", took: 0 });
      return;
    }
    const begun = performance.now();
    const request = new TextEncoder().encode(data.request);
    // Making room may move the memory.
    const room = solver.flexura_room(request.length);
    new Uint8Array(solver.memory.buffer, room, request.length).set(request);
    solver.flexura_answer();
    const text = told();
    self.postMessage({ id: data.id, text, took: performance.now() - begun });
  } catch (error) {
    self.postMessage({ id: data.id, broken: `${error}${solver ? `: ${told()}` : ""}` });
  }
};

function told() {
  return new TextDecoder().decode(new Uint8Array(solver.memory.buffer, solver.flexura_text(), solver.flexura_length()));
}
