/** What is written on the picture: names and values, axes, scale, colours, magnification, alarms. */

import { css, LIGHT, valueColour } from "../colours";
import type { Theme } from "../colours";
import type { Vec } from "../math";
import { norm } from "../math";
import { digits, quantity, scaleOf } from "../units";
import type { Label } from "./layers";

/** Left, top, right and bottom of something that is written, px. */
type Place = [number, number, number, number];

/** More names than this hide what they name. */
const MOST_LABELS = 80;
const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";

export class Overlay {
  theme: Theme = LIGHT;
  /** Name, unit and ends of the scale of colours; null for none. */
  scale: { name: string; unit: string; range: [number, number] } | null = null;
  magnification = 1;
  alarm = "";
  caption = "";
  gravity: Vec = [0, 0, 0];
  private readonly context: CanvasRenderingContext2D;
  private width = 1;
  private height = 1;

  constructor(readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("this browser gives no canvas to draw on");
    this.context = context;
  }

  resize(width: number, height: number): void {
    const ratio = Math.min(2, globalThis.devicePixelRatio || 1);
    [this.width, this.height] = [width, height];
    [this.canvas.width, this.canvas.height] = [Math.floor(width * ratio), Math.floor(height * ratio)];
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  draw(labels: Label[], project: (p: Vec) => Vec, axis: (v: Vec) => Vec, metresPerPixel: number): void {
    this.context.clearRect(0, 0, this.width, this.height);
    this.labels(labels, project, [...this.remarks(), ...this.colours()]);
    this.axes(axis);
    this.ruler(metresPerPixel);
  }

  private text(x: number, y: number, text: string, colour: string, align: CanvasTextAlign, size = 12): void {
    const c = this.context;
    c.font = `${size}px ${FONT}`;
    c.textAlign = align;
    c.textBaseline = "middle";
    c.lineJoin = "round";
    c.lineWidth = 3.5;
    c.strokeStyle = this.theme.background;
    c.strokeText(text, x, y);
    c.fillStyle = colour;
    c.fillText(text, x, y);
  }

  /** Each beside its point, where there is room. */
  private labels(labels: Label[], project: (p: Vec) => Vec, written: Place[]): void {
    const taken = [...written];
    const c = this.context;
    c.font = `12px ${FONT}`;
    for (const label of labels.slice(0, MOST_LABELS)) {
      const [x, y, z] = project(label.p);
      if (z < -1 || z > 1 || x < 0 || y < 0 || x > this.width || y > this.height) continue;
      const text = label.text.length > 48 ? `${label.text.slice(0, 47)}…` : label.text;
      const width = c.measureText(text).width;
      const places: [number, number][] = [
        [x + 8, y - 10],
        [x + 8, y + 10],
        [x - 8 - width, y - 10],
        [x - 8 - width, y + 10],
        [x + 8, y - 26],
        [x + 8, y + 26],
      ];
      const box = ([left, middle]: [number, number]): Place => [left, middle - 8, left + width, middle + 8];
      const isFree = (place: [number, number]): boolean => {
        const [l, t, r, b] = box(place);
        if (l < 2 || r > this.width - 2 || t < 2 || b > this.height - 2) return false;
        return taken.every(([L, T, R, B]) => r < L || l > R || b < T || t > B);
      };
      const place = places.find(isFree);
      if (!place) continue;
      taken.push(box(place));
      this.text(place[0], place[1], text, label.colour, "left");
    }
  }

  private arrow(x: number, y: number, dx: number, dy: number, colour: string): void {
    const c = this.context;
    const length = Math.hypot(dx, dy);
    c.strokeStyle = colour;
    c.fillStyle = colour;
    c.lineWidth = 1.8;
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x + dx, y + dy);
    c.stroke();
    if (length < 6) return;
    const [ux, uy] = [dx / length, dy / length];
    c.beginPath();
    c.moveTo(x + dx + 4 * ux, y + dy + 4 * uy);
    c.lineTo(x + dx - 4 * ux - 3 * uy, y + dy - 4 * uy + 3 * ux);
    c.lineTo(x + dx - 4 * ux + 3 * uy, y + dy - 4 * uy - 3 * ux);
    c.fill();
  }

  /** The global axes in the lower left corner, and the direction of gravity. */
  private axes(axis: (v: Vec) => Vec): void {
    const [x, y] = [46, this.height - 46];
    const names: [string, Vec, string][] = [
      ["x", [1, 0, 0], "#d55e00"],
      ["y", [0, 1, 0], "#009e73"],
      ["z", [0, 0, 1], "#0072b2"],
    ];
    const seen = names.map(([name, v, colour]) => ({ name, colour, v: axis(v) }));
    // Those that point away from the eye first.
    seen.sort((a, b) => a.v[2] - b.v[2]);
    for (const { name, colour, v } of seen) {
      this.arrow(x, y, 26 * v[0], -26 * v[1], colour);
      this.text(x + 38 * v[0], y - 38 * v[1], name, colour, "center");
    }
    const g = norm(this.gravity);
    if (g > 0) {
      const v = axis(this.gravity.map((component) => component / g) as Vec);
      this.arrow(x + 62, y - 16, 26 * v[0], -26 * v[1], this.theme.ink);
      this.text(x + 78, y, `g ${quantity(g, "m/s²", 3)}`, this.theme.ink, "left", 11);
    }
  }

  /** A bar of a round length. */
  private ruler(metresPerPixel: number): void {
    const most = 150 * metresPerPixel;
    if (!(most > 0) || !Number.isFinite(most)) return;
    const power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((k) => k * power).find((l) => l <= most) ?? power;
    const width = length / metresPerPixel;
    const [x, y] = [this.width - 20 - width, this.height - 22];
    const c = this.context;
    c.strokeStyle = this.theme.ink;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(x, y - 4);
    c.lineTo(x, y);
    c.lineTo(x + width, y);
    c.lineTo(x + width, y - 4);
    c.stroke();
    this.text(x + 0.5 * width, y + 11, quantity(length, "m"), this.theme.ink, "center", 11);
  }

  /** The scale of colours; the place that it takes. */
  private colours(): Place[] {
    if (!this.scale) return [];
    const { name, unit, range } = this.scale;
    const scale = scaleOf(unit, Math.max(Math.abs(range[0]), Math.abs(range[1])));
    const height = Math.min(180, this.height - 170);
    if (height < 60) return [];
    const [x, y] = [this.width - 92, 40];
    const c = this.context;
    const span = range[1] - range[0];
    if (!(span > 1e-9 * Math.max(Math.abs(range[0]), Math.abs(range[1])))) {
      this.text(this.width - 16, y - 16, `${name} ${quantity(range[1], unit, 3)} everywhere`, this.theme.ink, "right");
      return [[this.width - 260, 0, this.width, y]];
    }
    c.globalAlpha = 0.75;
    c.fillStyle = this.theme.background;
    c.fillRect(x - 6, y - 10, 94, height + 20);
    c.globalAlpha = 1;
    for (let i = 0; i < height; i++) {
      c.fillStyle = css(valueColour(1 - i / (height - 1)));
      c.fillRect(x, y + i, 14, 1.5);
    }
    // As exact as the largest value is written, so that round-off and what is nothing beside it read as zero.
    const exact = 10 ** (Math.floor(Math.log10(Math.max(Math.abs(range[0]), Math.abs(range[1])) * scale.factor)) - 2);
    const title = scale.unit ? `${name} / ${scale.unit}` : name;
    this.text(this.width - 16, y - 16, title, this.theme.ink, "right");
    for (let i = 0; i <= 4; i++) {
      const value = range[1] + ((range[0] - range[1]) * i) / 4;
      const at = y + (height * i) / 4;
      c.strokeStyle = this.theme.ink;
      c.lineWidth = 1;
      c.beginPath();
      c.moveTo(x + 14, at);
      c.lineTo(x + 18, at);
      c.stroke();
      this.text(x + 22, at, digits(exact * Math.round((value * scale.factor) / exact), 3), this.theme.ink, "left", 11);
    }
    return [[x - 40, 0, this.width, y + height + 10]];
  }

  /** How large displacements are drawn. */
  get magnified(): string {
    const times = `displacements × ${digits(this.magnification, 4)}`;
    return this.magnification === 1 ? `${times} (to scale)` : times;
  }

  /** What has to be said; the place that it takes. */
  private remarks(): Place[] {
    const isTrue = this.magnification === 1;
    const lines: [string, string, number][] = [];
    if (this.alarm) lines.push([this.alarm, this.theme.alarm, 14]);
    if (this.caption) lines.push([this.caption, this.theme.ink, 13]);
    lines.push([this.magnified, isTrue ? this.theme.faint : this.theme.alarm, 12]);
    lines.forEach(([text, colour, size], i) => this.text(14, 18 + 19 * i, text, colour, "left", size));
    return [[0, 0, 300, 19 * lines.length + 4]];
  }
}

