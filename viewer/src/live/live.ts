/** The live part of the page: values are moved, things are dragged, the text is changed, and the mechanism follows. */

import type { App } from "../app";
import type { ResultDocument } from "../data/types";
import type { Vec } from "../math";
import { button, choice, h, tick } from "../panel/dom";
import { Editor } from "./editor";
import { Grips } from "./grips";
import { Sliders } from "./sliders";
import { Ended } from "./solver";
import type { Answer, Parameter, Problem, Request, Solver } from "./solver";

/** Samples of all beams together, and of one at most and at least, while something moves. */
const SAMPLES = 600;
const [FEWEST, MOST] = [9, 41];
/** So often at most the same place is asked for in a drag. */
const REPEATS = 12;

export interface LiveModel {
  name: string;
  document: ResultDocument;
  /** The model file. */
  text: string | undefined;
}

type Moving = { values: Map<string, number> } | { grip: number; to: Vec; eye: Vec };

export class Live {
  readonly element: HTMLElement;
  private readonly sliders: Sliders;
  private readonly editor: Editor;
  private readonly grips: Grips;
  private readonly says = h("p", { class: "says", id: "live-says", role: "status", "aria-live": "polite" });
  private readonly studies = h("div", { class: "choices" });
  private readonly unknowns = h("div", {});
  private readonly ending: HTMLButtonElement;
  private parameters: Parameter[] = [];
  private text = "";
  private isInverse = true;
  /** What is to be done next, and what waits behind that: the newest only. */
  private moving: Moving | null = null;
  private repeats = 0;
  private isRunning = false;
  /** Was the solver ended or lost, so that nothing is open in it? */
  private isLost = false;
  private current: LiveModel;
  /** Steps done and the time that the last took, ms; for tests and benches. */
  readonly steps = { count: 0, took: Number.NaN };

  constructor(
    private readonly app: App,
    private readonly solver: Solver,
    private readonly models: LiveModel[],
  ) {
    this.current = models[0]!;
    this.sliders = new Sliders(
      (name, value) => this.move(name, value),
      (name, text) => void this.act({ do: "step", set: [[name, text]] }),
    );
    this.editor = new Editor((text) => void this.edit(text));
    this.ending = button("stop", "end what is being solved", () => void this.stop(), { id: "live-stop", disabled: true });
    const chosen = models.length > 1 ? choice("example", models.map(({ name }) => name), 0, (i) => void this.load(models[i]!), "example") : null;
    this.element = h(
      "section",
      { class: "live", "aria-label": "live" },
      chosen,
      this.sliders.element,
      this.unknowns,
      h(
        "div",
        { class: "choices" },
        button("solve", "solve from rest", () => void this.act({ do: "solve" }), { id: "live-solve" }),
        button("stability", "is it stable, and which loads are critical", () => void this.judge(), { id: "live-stability" }),
        button("reset", "the values of the file again", () => void this.open(this.editor.area.value, []), { id: "live-reset" }),
        this.ending,
      ),
      this.studies,
      this.says,
      h("details", { class: "source", open: true }, h("summary", {}, "model file"), this.editor.element),
    );
    const stage = app.root.querySelector<HTMLElement>(".stage")!;
    this.grips = new Grips(
      app,
      stage,
      (grip, to, eye) => this.run({ grip, to, eye }),
      () => void this.settle(),
    );
    const main = app.root.querySelector("main")!;
    main.classList.add("with-live");
    main.prepend(this.element);
  }

  /** Opens a document's model with the values that the document has, and shows the document until something moves. */
  async load(model: LiveModel): Promise<void> {
    this.current = model;
    const { document, text } = model;
    this.app.replace(document, false);
    if (text === undefined) {
      this.say("this result does not hold its model file, so nothing can be solved again", true);
      return;
    }
    this.editor.fill(text);
    const [first] = Object.values((document.studies as Record<string, ResultDocument> | undefined) ?? {});
    const given = Object.entries(document.parameters ?? first?.parameters ?? {});
    await this.open(text, given, document.study !== "solve" || document.status !== "converged");
  }

  /** Opens a text; where something is wrong with it, what was open stays. */
  private async open(text: string, values: [string, number][], keepsDocument = false): Promise<void> {
    await this.guarded(async () => {
      const answer = await this.solver.ask({ do: "open", text, name: this.name, inverse: this.isInverse });
      this.tell(answer.problems);
      if (!answer.opened) return;
      this.text = text;
      const { parameters, studies, has_unknowns } = answer.opened;
      this.parameters = parameters;
      this.sliders.fill(parameters, (own) => own.is_found);
      this.fillStudies(studies);
      this.fillUnknowns(has_unknowns);
      const found = new Set(parameters.filter((own) => own.is_found).map(({ name }) => name));
      const kept = values.filter(([name, value]) => !found.has(name) && parameters.some((own) => own.name === name && own.value !== value));
      if (kept.length > 0) this.take(await this.solver.ask({ do: "step", values: kept, samples: this.samples() }), !keepsDocument);
      else this.take(await this.solver.ask({ do: "solve" }), !keepsDocument);
      await this.findGrips();
    });
  }

  private get name(): string {
    return `${this.current.name || "model"}.toml`;
  }

  private async findGrips(): Promise<void> {
    this.grips.fill((await this.solver.ask({ do: "grips" })).grips ?? []);
  }

  private async edit(text: string): Promise<void> {
    this.moving = null;
    if (this.isRunning) {
      this.solver.restart();
      await Promise.resolve();
    }
    await this.open(text, []);
  }

  private fillStudies(studies: [string, string][]): void {
    const names = this.parameters.filter((own) => !own.is_found).map(({ name }) => name);
    let along = 0;
    const parts: HTMLElement[] = [];
    if (names.length > 0) {
      const trace = (): void => {
        const name = names[along]!;
        void this.act({ do: "trace", parameter: name, range: this.sliders.range(name) ?? [0, 1] });
      };
      parts.push(choice("trace along", names, 0, (i) => (along = i), "live-along"), button("trace", "the path of equilibria over the slider's range", trace, { id: "live-trace" }));
    }
    if (studies.length > 0) {
      let which = 0;
      const labels = studies.map(([name, kind]) => `${name} (${kind.replace(/_/g, " ")})`);
      parts.push(
        choice("study", labels, 0, (i) => (which = i), "live-study"),
        button("run", "do the study of the file", () => void this.act({ do: "study", name: studies[which]![0] }), { id: "live-run" }),
      );
    }
    this.studies.replaceChildren(...parts);
  }

  private fillUnknowns(has: boolean): void {
    const toggle = (isOn: boolean): void => {
      this.isInverse = isOn;
      void this.open(this.editor.area.value, []);
    };
    this.unknowns.replaceChildren(...(has ? [tick("find the unknowns so that the targets are met", this.isInverse, toggle, "live-inverse")] : []));
  }

  private samples(): number {
    const beams = Object.keys(this.app.study.scene.beams).length;
    return Math.round(Math.min(MOST, Math.max(FEWEST, SAMPLES / Math.max(1, beams))));
  }

  private move(name: string, value: number): void {
    const values = this.moving && "values" in this.moving ? this.moving.values : new Map<string, number>();
    values.set(name, value);
    this.run({ values });
  }

  /** Does the newest of what is asked for while something moves; what came in between is left out. */
  private run(moving: Moving): void {
    this.moving = moving;
    if (!this.isRunning) void this.guarded(() => this.pump());
  }

  private async pump(): Promise<void> {
    while (this.moving) {
      const next = this.moving;
      this.moving = null;
      const samples = this.samples();
      const request: Request =
        "values" in next ? { do: "step", values: [...next.values], samples } : { do: "drag", grip: next.grip, to: next.to, eye: next.eye, samples };
      const answer = await this.solver.ask(request);
      this.steps.count++;
      this.steps.took = answer.took;
      this.take(answer, true, true);
      // What is held goes on until it is where the pointer is.
      this.repeats = "grip" in next && answer.is_there === false && answer.way === "near" ? this.repeats + 1 : 0;
      if (this.repeats > 0 && this.repeats < REPEATS && !this.moving) this.moving = next;
      // A frame is drawn before the next step is shown.
      await new Promise((done) => requestAnimationFrame(done));
    }
  }

  /** After a drag: the whole document, with all its samples. */
  private async settle(): Promise<void> {
    while (this.isRunning) await new Promise((done) => setTimeout(done, 20));
    await this.act({ do: "step" });
  }

  private async act(request: Request): Promise<void> {
    await this.guarded(async () => {
      const answer = await this.solver.ask(request);
      this.tell(answer.problems);
      this.take(answer, true);
    });
  }

  private async judge(): Promise<void> {
    await this.guarded(async () => {
      const now = await this.solver.ask({ do: "step" });
      this.take(now, true);
      const verdict = verdictOf(now.document);
      const answer = await this.solver.ask({ do: "stability" });
      if (answer.document) this.app.replace(answer.document, true);
      const why = answer.problems[0];
      this.say(answer.document ? `${verdict}; shown: the critical loads of the mechanism at rest` : `${verdict}; no critical loads: ${why?.message ?? ""}`, false);
    });
  }

  /** Shows what came back. */
  private take(answer: Answer, shows: boolean, isMoving = false): void {
    if (answer.values) this.sliders.update(answer.values, isMoving);
    if (answer.document && shows) this.app.replace(answer.document, true);
    const problem = answer.problems.find((own) => !own.is_warning);
    const time = `${answer.took < 10 ? answer.took.toFixed(1) : Math.round(answer.took)} ms`;
    if (problem) this.say(problem.message, true);
    else if (answer.way === "kept") this.say(`no equilibrium there, so the last one is shown: ${answer.reason ?? ""}`, true);
    else if (answer.document && answer.document.status !== "converged") this.say(answer.document.reason ?? answer.document.status, true);
    else if (answer.way === "rest") this.say(`solved from rest in ${time}; ${verdictOf(answer.document)}`, false);
    else if (answer.document) this.say(`solved in ${time}${answer.way ? `; ${verdictOf(answer.document)}` : ""}`, false);
  }

  private tell(problems: Problem[]): void {
    this.editor.tell(problems);
  }

  private say(text: string, isBad: boolean): void {
    this.says.textContent = text;
    this.says.className = isBad ? "says bad" : "says";
  }

  private async guarded(work: () => Promise<void>): Promise<void> {
    while (this.isRunning) await new Promise((done) => setTimeout(done, 5));
    this.isRunning = true;
    this.ending.disabled = false;
    this.element.setAttribute("aria-busy", "true");
    try {
      if (this.isLost && this.text) {
        this.isLost = false;
        await this.solver.ask({ do: "open", text: this.text, name: this.name, inverse: this.isInverse });
        await this.solver.ask({ do: "solve", samples: 0 });
        await this.findGrips();
      }
      await work();
    } catch (error) {
      this.isLost = true;
      if (!(error instanceof Ended)) this.say(error instanceof Error ? error.message : String(error), true);
    } finally {
      this.isRunning = false;
      this.ending.disabled = true;
      this.element.removeAttribute("aria-busy");
      if (this.moving) void this.guarded(() => this.pump());
    }
  }

  /** Ends what runs; the model is opened again as it was. */
  private async stop(): Promise<void> {
    this.moving = null;
    this.solver.restart();
    await this.open(this.text, [], true);
    this.say("ended", false);
  }

  get isBusy(): boolean {
    return this.isRunning || this.moving !== null;
  }

  async begin(): Promise<void> {
    await this.load(this.models[0]!);
  }
}

function verdictOf(document: ResultDocument | undefined): string {
  if (!document || document.status !== "converged") return "no equilibrium";
  if (document.stable === true) return "stable";
  if (document.stable === false) {
    const count = Number(document.unstable_directions);
    return `unstable in ${count} direction${count === 1 ? "" : "s"}`;
  }
  return `stability not decided: ${String(document.stability_reason ?? "")}`;
}
