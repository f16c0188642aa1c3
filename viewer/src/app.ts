/** The page: window on the mechanism, plot, table, and what moves them. One study at a time. */

import { DARK, LIGHT, valueColour } from "./colours";
import type { Theme } from "./colours";
import { largestDisplacement, magnified, pointsOf, QUANTITIES, restOf, swung } from "./data/state";
import type { State } from "./data/state";
import { rangeOf, studiesOf } from "./data/study";
import type { Point, Study } from "./data/study";
import type { ResultDocument } from "./data/types";
import { Box } from "./math";
import type { Vec } from "./math";
import { Parallel } from "./panel/parallel";
import { Plot } from "./panel/plot";
import type { Spot } from "./panel/plot";
import { Side } from "./panel/side";
import { Tools } from "./panel/tools";
import { quantity } from "./units";
import { h } from "./panel/dom";
import { layersOf } from "./view/layers";
import type { Options } from "./view/layers";
import { Viewport } from "./view/viewport";
import type { View } from "./view/viewport";

/** Points of a study that are looked at to find its box; a long path does not change much between them. */
const LOOKED_AT = 60;
/** The largest displacement of a mode, as a part of the mechanism's size. */
const SWING = 0.12;
const OPPOSITE: Record<View, View> = {
  front: "back",
  back: "front",
  left: "right",
  right: "left",
  top: "bottom",
  bottom: "top",
  space: "space",
  own: "own",
};
/** Displacements below this part of the size are too small to be seen. */
const UNSEEN = 0.02;

export class App {
  readonly viewport: Viewport;
  readonly studies: [string, Study][];
  readonly options: Options;
  study!: Study;
  spot: Spot = { branch: 0, point: 0 };
  mode = 0;
  phase = 1;
  magnification = 1;
  proposal = 1;
  /** Size of glyphs, m. */
  private glyph = 0;
  private box = new Box();
  private plots: (Plot | Parallel)[] = [];
  private range: [number, number] | null = null;
  /** What stands on the picture, for those who do not see it. */
  private readonly said = h("p", { class: "aside", id: "said", role: "status" });
  private readonly side: Side;
  private readonly tools: Tools;
  private timer = 0;
  theme: Theme;

  constructor(
    readonly root: HTMLElement,
    document_: ResultDocument,
  ) {
    this.studies = studiesOf(document_);
    this.theme = matchMedia("(prefers-color-scheme: dark)").matches ? DARK : LIGHT;
    this.options = {
      quantity: "stress",
      ghost: true,
      loads: true,
      reactions: false,
      names: true,
      frames: false,
      surfaces: true,
    };
    const canvas = h("canvas", { class: "window" });
    const overlay = h("canvas", {
      class: "overlay",
      tabindex: 0,
      role: "img",
      "aria-label": "the mechanism; arrow keys turn it, with shift they move it, plus and minus zoom, F fits it into view",
      keydown: (event) => this.key(event as KeyboardEvent),
    });
    const stage = h("div", { class: "stage", id: "stage" }, canvas, overlay, this.said);
    this.tools = new Tools(this);
    this.side = new Side(this);
    const title = h("h1", {}, document_.model || "mechanism");
    root.replaceChildren(
      h("header", {}, title, this.tools.header),
      h("main", {}, h("section", { class: "left", "aria-label": "the mechanism" }, this.tools.bar, stage, this.tools.path), this.side.element),
    );
    document.title = `${document_.model || "mechanism"} – flexura`;
    this.viewport = new Viewport(canvas, overlay);
    this.paint(this.theme);
    this.open(0);
  }

  /** Shows another document of the same mechanism; unless it is to be fitted, the eye stays where it is. */
  replace(document_: ResultDocument, keepsView: boolean): void {
    const studies = studiesOf(document_);
    const [first] = studies.map(([, study]) => study);
    this.studies.splice(0, this.studies.length, ...studies);
    const heading = this.root.querySelector("h1");
    if (heading) heading.textContent = document_.model || "mechanism";
    document.title = `${document_.model || "mechanism"} – flexura`;
    const isAlike = keepsView && first?.kind === "solve" && this.study.kind === "solve";
    if (!first || !isAlike) {
      this.open(0, !keepsView);
      return;
    }
    this.study = first;
    this.range = this.options.quantity ? rangeOf(first, this.options.quantity) : null;
    this.go({ branch: 0, point: 0 });
  }

  /** Shows one of the studies from its start. */
  open(index: number, fits = true): void {
    this.stop();
    this.study = this.studies[index]![1];
    this.mode = 0;
    this.phase = this.study.modes.length > 0 ? 1 : 0;
    const spot = this.firstSpot();
    this.spot = spot;
    const known = QUANTITIES.filter(({ key }) => rangeOf(this.study, key) !== null);
    this.options.quantity = this.telling(known.map(({ key }) => key));
    this.tools.fill(known);
    this.measure();
    this.propose();
    this.range = this.options.quantity ? rangeOf(this.study, this.options.quantity) : null;
    const hosts = this.side.fill();
    this.plots = [];
    const choose = (chosen: Spot): void => this.go(chosen);
    if (hosts.plot) this.plots.push(new Plot(hosts.plot, this.study, this.theme, choose));
    if (hosts.parallel) this.plots.push(new Parallel(hosts.parallel, this.study, this.theme, choose));
    if (fits) this.viewport.fit(this.box, "own");
    this.go(spot);
  }

  /** Where a path ends, on the first branch that does so in a stable state, or where the last one was stable; of other studies the first point. */
  private firstSpot(): Spot {
    const { branches, isJoined, kind } = this.study;
    if (!isJoined || kind === "inverse_dynamics") return { branch: 0, point: this.shown(0)[0] ?? 0 };
    const last = (branch: number, isFit: (point: Point) => boolean): Spot[] => {
      const point = this.shown(branch).findLast((i) => isFit(branches[branch]!.points[i]!));
      return point === undefined ? [] : [{ branch, point }];
    };
    const ends = branches.flatMap((_, i) => last(i, () => true));
    const stable = branches.flatMap((_, i) => last(i, (point) => point.stable === true));
    const isEnd = (spot: Spot): boolean => ends.some((end) => end.branch === spot.branch && end.point === spot.point);
    return stable.find(isEnd) ?? stable.at(-1) ?? ends[0] ?? { branch: 0, point: 0 };
  }

  /** What to colour by at first: stress, or else what differs from place to place. */
  private telling(known: string[]): string {
    const varies = (key: string): boolean => {
      const [low, high] = rangeOf(this.study, key) ?? [0, 0];
      return high - low > 1e-9 * Math.max(Math.abs(low), Math.abs(high));
    };
    const wanted = ["stress", "moment", "curvature", "twist"].filter((key) => known.includes(key));
    return wanted.find(varies) ?? wanted[0] ?? "";
  }

  get plot(): Plot | undefined {
    return this.plots.find((plot) => plot instanceof Plot);
  }

  get point(): Point | undefined {
    return this.study.branches[this.spot.branch]?.points[this.spot.point];
  }

  /** Points of a branch that can be shown. */
  shown(branch: number): number[] {
    const points = this.study.branches[branch]?.points ?? [];
    return points.map((point, i) => (point.state ? i : -1)).filter((i) => i >= 0);
  }

  /** Moves to a point; of a path to the nearest that can be shown. */
  go(spot: Spot): void {
    const shown = this.study.isJoined ? this.shown(spot.branch) : [spot.point];
    const nearest = shown.reduce((best, i) => (Math.abs(i - spot.point) < Math.abs(best - spot.point) ? i : best), shown[0] ?? spot.point);
    this.spot = { branch: spot.branch, point: shown.includes(spot.point) ? spot.point : nearest };
    for (const plot of this.plots) plot.mark(this.spot);
    this.tools.update();
    this.side.update();
    this.draw();
  }

  setPhase(phase: number): void {
    this.phase = phase;
    this.draw();
  }

  setMode(mode: number): void {
    this.mode = mode;
    this.draw();
  }

  setQuantity(key: string): void {
    this.options.quantity = key;
    this.range = key ? rangeOf(this.study, key) : null;
    this.draw();
  }

  setMagnification(factor: number): void {
    this.magnification = factor;
    this.tools.update();
    this.draw();
  }

  set(option: keyof Omit<Options, "quantity">, isOn: boolean): void {
    this.options[option] = isOn;
    this.draw();
  }

  paint(theme: Theme): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme.name;
    this.viewport.paint(theme);
    for (const plot of this.plots) plot.paint(theme);
    if (this.study) this.draw();
  }

  look(view: View): void {
    this.viewport.fit(this.box, view);
  }

  /** From the other side where the eye is there already. */
  lookAgain(view: View): void {
    this.look(this.viewport.view === view ? OPPOSITE[view] : view);
  }

  play(): void {
    if (this.timer) {
      this.stop();
      return;
    }
    let last = performance.now();
    let clock = 0;
    const step = (now: number): void => {
      const elapsed = Math.min(0.1, (now - last) / 1000);
      last = now;
      clock += elapsed;
      if (this.study.modes.length > 0) this.setPhase(Math.sin(2 * Math.PI * 0.5 * clock));
      else this.advance(clock);
      this.timer = requestAnimationFrame(step);
    };
    this.playedFrom = this.shown(this.spot.branch).indexOf(this.spot.point);
    this.timer = requestAnimationFrame(step);
    this.tools.update();
  }

  private playedFrom = 0;

  /** Through a branch in about five seconds, then again from its start; a motion in the pace of its times. */
  private advance(clock: number): void {
    const shown = this.shown(this.spot.branch);
    if (shown.length < 2) return;
    const time = this.study.kind === "inverse_dynamics" ? this.study.branches[0]!.points.map((p) => p.values[0]!) : null;
    let index: number;
    if (time) {
      const whole = time[time.length - 1]! - time[0]!;
      const pace = whole > 0.5 && whole < 20 ? 1 : whole / 5;
      const t = time[0]! + ((time[shown[this.playedFrom] ?? 0]! - time[0]! + clock * pace) % whole);
      index = Math.max(0, shown.findIndex((i) => time[i]! >= t));
    } else index = (this.playedFrom + Math.floor((clock * shown.length) / 5)) % shown.length;
    const point = shown[index]!;
    if (point !== this.spot.point) this.go({ branch: this.spot.branch, point });
  }

  get isPlaying(): boolean {
    return this.timer !== 0;
  }

  stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.tools?.update();
  }

  private key(event: KeyboardEvent): void {
    const [turn, way] = [0.12, 30];
    const arrow = (x: number, y: number): void => {
      if (event.shiftKey) this.viewport.shift(way * x, way * y);
      else this.viewport.move(turn * x, turn * y);
    };
    const actions: Record<string, () => void> = {
      ArrowLeft: () => arrow(-1, 0),
      ArrowRight: () => arrow(1, 0),
      ArrowUp: () => arrow(0, 1),
      ArrowDown: () => arrow(0, -1),
      "+": () => this.viewport.move(0, 0, 1.15),
      "=": () => this.viewport.move(0, 0, 1.15),
      "-": () => this.viewport.move(0, 0, 1 / 1.15),
      f: () => this.look("own"),
      x: () => this.lookAgain("right"),
      y: () => this.lookAgain("front"),
      z: () => this.lookAgain("top"),
      i: () => this.look("space"),
      " ": () => this.play(),
    };
    const action = actions[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action();
  }

  /** The state at the present point as it is seen. */
  seen(): State {
    const state = this.point?.state?.() ?? restOf(this.study.scene);
    const swinging = this.study.modes[this.mode];
    if (swinging) return swung(state, swinging.shape, this.phase * SWING * this.box.size);
    return magnified(state, restOf(state.scene), this.magnification);
  }

  private measure(): void {
    const box = new Box();
    const states = this.study.branches.flatMap((branch) => branch.points.filter((point) => point.state));
    const every = Math.max(1, Math.ceil(states.length / LOOKED_AT));
    const looked = states.filter((_, i) => i % every === 0 || i === states.length - 1);
    const shown = looked.map((point) => point.state!());
    for (const state of [restOf(this.study.scene), ...shown.flatMap((state) => [restOf(state.scene), state])]) {
      for (const p of pointsOf(state)) box.include(p);
    }
    if (box.isEmpty) box.include([0, 0, 0]);
    const isPoint = box.size === 0;
    if (isPoint) for (const p of [[-1, -1, -1], [1, 1, 1]] as Vec[]) box.include(p);
    this.box = box;
    this.glyph = (isPoint ? 0.1 : 0.022) * box.size;
  }

  /** Where nothing could be seen, a factor that shows something; it is not set by itself. */
  private propose(): void {
    let most = 0;
    for (const branch of this.study.branches) {
      const shown = branch.points.filter((point) => point.state);
      const every = Math.max(1, Math.ceil(shown.length / LOOKED_AT));
      shown.filter((_, i) => i % every === 0 || i === shown.length - 1).forEach((point) => {
        const state = point.state!();
        most = Math.max(most, largestDisplacement(state, restOf(state.scene)));
      });
    }
    this.magnification = 1;
    const part = most / this.box.size;
    // Shapes among others are rounded, and so are their displacements.
    const least = this.study.kind === "solve" || this.study.kind === "buckle" ? 1e-12 : 2e-6;
    if (!(part > least) || part >= UNSEEN) {
      this.proposal = 1;
      return;
    }
    const wanted = 0.08 / part;
    const power = 10 ** Math.floor(Math.log10(wanted));
    this.proposal = [5, 2, 1].map((k) => k * power).find((k) => k <= wanted) ?? power;
  }

  draw(): void {
    const { quantity: key } = this.options;
    const range = this.range;
    const size = this.box.size;
    const span = range ? range[1] - range[0] : 0;
    const state = this.seen();
    const layers = layersOf({
      state,
      rest: restOf(state.scene),
      scene: state.scene,
      options: this.options,
      theme: this.theme,
      size,
      g: this.glyph,
      colourOf: (value) => valueColour(range && span > 0 ? (value - range[0]) / span : 0.5),
    });
    const overlay = this.viewport.overlay;
    const known = QUANTITIES.find((own) => own.key === key);
    overlay.scale = known && range ? { name: known.name, unit: known.unit, range } : null;
    overlay.magnification = this.magnification;
    overlay.alarm = this.alarm();
    overlay.caption = this.caption();
    overlay.gravity = state.scene.gravity;
    this.said.textContent = [overlay.alarm, overlay.caption, overlay.magnified].filter(Boolean).join("; ");
    this.viewport.show(layers);
  }

  private alarm(): string {
    if (this.point?.kind === "failed" && this.study.kind === "sweep") return `NOT CONVERGED: ${this.point.note || "this sample"}`;
    if (!this.study.branches.some((branch) => branch.points.some((point) => point.state))) {
      return "this result holds no shapes";
    }
    return this.study.alarm;
  }

  /** Where on the path the picture is. */
  private caption(): string {
    const { study, point } = this;
    const swinging = study.modes[this.mode];
    if (swinging) {
      const name = study.document.parameter ? String(study.document.parameter) : "load fraction";
      const unit = study.scene.units.parameters[name] ?? "";
      return `mode ${this.mode + 1}: ${name} = ${quantity(swinging.value, unit, 5)}; size not to scale`;
    }
    if (!point || study.kind === "solve" || study.columns.length === 0) return "";
    if (study.kind === "sweep") {
      const varied = Object.keys((study.document.vary as object) ?? {});
      return study.columns
        .map(({ name, unit }, i) => (varied.includes(name) && i < varied.length ? `${name} = ${quantity(point.values[i], unit)}` : ""))
        .filter(Boolean)
        .join(", ");
    }
    if (study.kind === "critical") {
      return study.columns.slice(0, 2).map(({ name, unit }, i) => `${name} = ${quantity(point.values[i], unit, 4)}`).join(", ");
    }
    const { name, unit } = study.columns[0]!;
    const special = point.kind === "fold" || point.kind === "branch" || point.kind === "event" ? `, ${point.kind === "branch" ? "branch point" : point.kind}` : "";
    const stability = point.stable === false ? ", unstable" : "";
    return `${name} = ${quantity(point.values[0], unit, 4)}${special}${stability}`;
  }
}
