/** Samples of a sweep as lines across upright axes, one axis for each column. */

import { css, valueColour } from "../colours";
import type { Theme } from "../colours";
import type { Study } from "../data/study";
import { digits, scaleOf } from "../units";
import { h } from "./dom";
import type { Spot } from "./plot";

const MARGIN = { left: 46, right: 46, top: 34, bottom: 22 };
/** Nearer than this a click means a line, px. */
const NEAR = 25;

export class Parallel {
  private readonly canvas = h("canvas", { role: "img", "aria-label": "samples as lines across one axis for each quantity" });
  private here: Spot = { branch: 0, point: 0 };
  private ranges: [number, number][] = [];

  constructor(
    private readonly host: HTMLElement,
    private readonly study: Study,
    private theme: Theme,
    choose: (spot: Spot) => void,
  ) {
    host.append(this.canvas);
    this.ranges = study.columns.map((_, i) => this.range(i));
    new ResizeObserver(() => this.draw()).observe(host);
    this.canvas.addEventListener("click", (event) => {
      const spot = this.nearest(event.offsetX, event.offsetY);
      if (spot) choose(spot);
    });
    this.draw();
  }

  mark(spot: Spot): void {
    this.here = spot;
    this.draw();
  }

  paint(theme: Theme): void {
    this.theme = theme;
    this.draw();
  }

  private range(column: number): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (const point of this.study.branches[0]?.points ?? []) {
      const value = point.values[column]!;
      if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
    }
    if (!(low <= high)) return [0, 1];
    return low === high ? [low - 0.5 * (Math.abs(low) || 1), high + 0.5 * (Math.abs(high) || 1)] : [low, high];
  }

  private get size(): [number, number] {
    const { width, height } = this.host.getBoundingClientRect();
    return [Math.max(width, 60 * this.study.columns.length), height];
  }

  private placeOf(column: number, value: number): [number, number] | null {
    if (!Number.isFinite(value)) return null;
    const [width, height] = this.size;
    const count = Math.max(1, this.study.columns.length - 1);
    const [low, high] = this.ranges[column]!;
    const x = MARGIN.left + ((width - MARGIN.left - MARGIN.right) * column) / count;
    const part = (value - low) / (high - low);
    return [x, height - MARGIN.bottom - part * (height - MARGIN.top - MARGIN.bottom)];
  }

  private draw(): void {
    const [width, height] = this.size;
    const ratio = Math.min(2, globalThis.devicePixelRatio || 1);
    [this.canvas.width, this.canvas.height] = [width * ratio, height * ratio];
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    const c = this.canvas.getContext("2d");
    if (!c || height <= 0) return;
    c.scale(ratio, ratio);
    const points = this.study.branches[0]?.points ?? [];
    const first = this.study.first[1];
    const [low, high] = this.ranges[first] ?? [0, 1];
    points.forEach((point) => this.line(c, point.values, css(valueColour((point.values[first]! - low) / (high - low))), 1));
    const here = points[this.here.point];
    if (here) this.line(c, here.values, this.theme.load, 3);
    this.axes(c);
  }

  private line(c: CanvasRenderingContext2D, values: number[], colour: string, width: number): void {
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.beginPath();
    let isDown = false;
    values.forEach((value, i) => {
      const place = this.placeOf(i, value);
      if (place && isDown) c.lineTo(...place);
      else if (place) c.moveTo(...place);
      isDown = place !== null;
    });
    c.stroke();
  }

  private axes(c: CanvasRenderingContext2D): void {
    const [, height] = this.size;
    c.fillStyle = this.theme.ink;
    c.strokeStyle = this.theme.ink;
    c.lineWidth = 1;
    c.textAlign = "center";
    this.study.columns.forEach(({ name, unit }, i) => {
      const [low, high] = this.ranges[i]!;
      const x = this.placeOf(i, low)![0];
      c.beginPath();
      c.moveTo(x, MARGIN.top);
      c.lineTo(x, height - MARGIN.bottom);
      c.stroke();
      const scale = scaleOf(unit, Math.max(Math.abs(low), Math.abs(high)));
      c.font = "11px system-ui, sans-serif";
      const title = scale.unit ? `${name} / ${scale.unit}` : name;
      c.fillText(title.length > 18 ? `${title.slice(0, 17)}…` : title, x, 12 + 12 * (i % 2));
      c.font = "10px system-ui, sans-serif";
      // What is nothing beside the other end is round-off.
      const shown = (value: number): string =>
        digits(Math.abs(value) < 1e-9 * Math.max(Math.abs(low), Math.abs(high)) ? 0 : value * scale.factor, 3);
      c.fillText(shown(high), x + 18, MARGIN.top + 4);
      c.fillText(shown(low), x, height - 8);
    });
  }

  private nearest(x: number, y: number): Spot | null {
    let best: Spot | null = null;
    let least = NEAR;
    (this.study.branches[0]?.points ?? []).forEach((point, p) => {
      for (let i = 1; i < point.values.length; i++) {
        const [a, b] = [this.placeOf(i - 1, point.values[i - 1]!), this.placeOf(i, point.values[i]!)];
        if (!a || !b || x < a[0] || x > b[0]) continue;
        const distance = Math.abs(a[1] + ((b[1] - a[1]) * (x - a[0])) / (b[0] - a[0]) - y);
        if (distance < least) [least, best] = [distance, { branch: 0, point: p }];
      }
    });
    return best;
  }
}
