/** Rings on what can be dragged: loads and driven bodies. A drag asks the solver for the equilibrium under the pointer. */

import type { App } from "../app";
import { poseOf } from "../data/state";
import { add, scale, sub } from "../math";
import type { Vec } from "../math";
import { h } from "../panel/dom";
import type { Grip } from "./solver";

/** An arrow key moves a grip by so many pixels. */
const NUDGE = 8;

export class Grips {
  private readonly layer = h("div", { class: "grips" });
  private rings: HTMLButtonElement[] = [];
  private grips: Grip[] = [];
  held = -1;

  constructor(
    private readonly app: App,
    stage: HTMLElement,
    private readonly drag: (grip: number, to: Vec, eye: Vec) => void,
    private readonly dropped: () => void,
  ) {
    stage.append(this.layer);
    app.viewport.afterDraw = () => this.place();
  }

  fill(grips: Grip[]): void {
    this.grips = grips;
    this.rings = grips.map((grip, i) => this.ring(grip, i));
    this.layer.replaceChildren(...this.rings);
    this.place();
  }

  private ring(grip: Grip, index: number): HTMLButtonElement {
    const by = grip.parameters.length > 0 ? `changes ${grip.parameters.join(", ")}` : "changes its force";
    const label = `${grip.kind} ${grip.name}: drag, or use the arrow keys; ${by}`;
    const ring = h("button", { type: "button", class: `grip ${grip.kind}`, "aria-label": label, title: label, id: `grip-${index}` });
    ring.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      ring.focus();
      ring.setPointerCapture(event.pointerId);
      this.held = index;
    });
    ring.addEventListener("pointermove", (event) => {
      if (this.held === index) this.pull(index, ...this.inStage(event.clientX, event.clientY));
    });
    const drop = (): void => {
      if (this.held !== index) return;
      this.held = -1;
      this.dropped();
    };
    ring.addEventListener("pointerup", drop);
    ring.addEventListener("pointercancel", drop);
    ring.addEventListener("keydown", (event) => {
      const ways: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      const way = ways[event.key];
      if (!way) return;
      event.preventDefault();
      const [x, y] = this.app.viewport.project(this.seen(grip));
      this.pull(index, x + NUDGE * way[0], y + NUDGE * way[1]);
    });
    return ring;
  }

  private inStage(x: number, y: number): [number, number] {
    const { left, top } = this.layer.getBoundingClientRect();
    return [x - left, y - top];
  }

  private seen(grip: Grip): Vec {
    return poseOf(this.app.seen(), grip).p;
  }

  /** Where displacements are shown larger than they are, the pointer's way is as much smaller. */
  private pull(index: number, x: number, y: number): void {
    const grip = this.grips[index];
    if (!grip) return;
    const seen = this.seen(grip);
    const { to, eye } = this.app.viewport.under(x, y, seen);
    const state = this.app.point?.state?.();
    const here = state ? poseOf(state, grip).p : seen;
    this.drag(index, add(here, scale(sub(to, seen), 1 / this.app.magnification)), eye);
  }

  private place(): void {
    const isShown = this.app.study?.kind === "solve";
    this.layer.hidden = !isShown;
    if (!isShown || this.grips.length === 0) return;
    const state = this.app.seen();
    this.rings.forEach((ring, i) => {
      const grip = this.grips[i]!;
      const [x, y, depth] = this.app.viewport.project(poseOf(state, grip).p);
      ring.hidden = !(Math.abs(depth) <= 1);
      ring.style.left = `${x}px`;
      ring.style.top = `${y}px`;
    });
  }
}
