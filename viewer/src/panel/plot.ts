/** One quantity of the points against another: branches as lines, solid where stable, dashed where not. */

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { THINGS } from "../colours";
import type { Theme } from "../colours";
import type { Branch, Study } from "../data/study";
import { digits, scaleOf } from "../units";

/** Nearer than this a click means a point, px. */
const NEAR = 40;
/** Width and dashes of a line, px, by what is known of its stability. */
const LINES: Record<string, [number, number[]]> = { stable: [2, []], unstable: [2, [6, 4]], undecided: [1, []] };

type Placer = (values: number[]) => [number, number] | null;

export interface Spot {
  branch: number;
  point: number;
}

export class Plot {
  private plot: uPlot | null = null;
  private across: number;
  private up: number;
  private here: Spot = { branch: 0, point: 0 };
  readonly hidden = new Set<number>();

  constructor(
    private readonly host: HTMLElement,
    private readonly study: Study,
    private theme: Theme,
    private readonly choose: (spot: Spot) => void,
  ) {
    [this.across, this.up] = study.first;
    new ResizeObserver(() => this.resize()).observe(host);
    this.build();
  }

  show(across: number, up: number): void {
    [this.across, this.up] = [across, up];
    this.build();
  }

  get columns(): [number, number] {
    return [this.across, this.up];
  }

  mark(spot: Spot): void {
    this.here = spot;
    this.plot?.redraw(false, false);
  }

  paint(theme: Theme): void {
    this.theme = theme;
    this.build();
  }

  hide(branch: number, isHidden: boolean): void {
    if (isHidden) this.hidden.add(branch);
    else this.hidden.delete(branch);
    this.plot?.redraw(false, false);
  }

  private range(column: number): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (const branch of this.study.branches) {
      for (const point of branch.points) {
        const value = point.values[column]!;
        if (Number.isFinite(value)) [low, high] = [Math.min(low, value), Math.max(high, value)];
      }
    }
    if (!(low <= high)) return [0, 1];
    const margin = 0.06 * (high - low) || 0.5 * Math.abs(high) || 1;
    return [low - margin, high + margin];
  }

  private resize(): void {
    const { width, height } = this.host.getBoundingClientRect();
    if (width > 0 && height > 0) this.plot?.setSize({ width: Math.floor(width), height: Math.floor(height) });
  }

  private build(): void {
    this.plot?.destroy();
    const { width, height } = this.host.getBoundingClientRect();
    const [x, y] = [this.range(this.across), this.range(this.up)];
    const axisOf = (column: number, range: [number, number]): uPlot.Axis => {
      const { name, unit } = this.study.columns[column] ?? { name: "", unit: "" };
      const scale = scaleOf(unit, Math.max(Math.abs(range[0]), Math.abs(range[1])));
      const short = name.length > 40 ? `${name.slice(0, 39)}…` : name;
      return {
        label: scale.unit ? `${short} / ${scale.unit}` : short,
        labelSize: 20,
        labelFont: "12px system-ui, sans-serif",
        font: "11px system-ui, sans-serif",
        stroke: this.theme.ink,
        grid: { stroke: this.theme.grid, width: 1 },
        ticks: { stroke: this.theme.grid, width: 1, size: 5 },
        // Ticks at round numbers of the unit that is shown.
        splits: (_u, _i, low, high, step) => roundSplits(low * scale.factor, high * scale.factor, step * scale.factor).map((v) => v / scale.factor),
        values: (_u, splits) => splits.map((value) => digits(value * scale.factor, 4)),
      };
    };
    this.plot = new uPlot(
      {
        width: Math.max(120, Math.floor(width)),
        height: Math.max(100, Math.floor(height)),
        legend: { show: false },
        cursor: { x: true, y: true, points: { show: false }, drag: { x: true, y: true, uni: 20, setScale: true } },
        scales: {
          x: { time: false, range: (_u, low, high) => (low === 0 && high === 1 ? x : [low, high]) },
          y: { range: (_u, low, high) => (low === null || (low === 0 && high === 1) ? y : [low, high]) },
        },
        axes: [{ ...axisOf(this.across, x), size: 34 }, { ...axisOf(this.up, y), size: 58 }],
        series: [{}, { show: true, points: { show: false } }],
        hooks: { draw: [(u) => this.draw(u)], ready: [(u) => this.listen(u)] },
      },
      [x, y],
      this.host,
    );
    const plot = this.plot;
    plot.batch(() => {
      plot.setScale("x", { min: x[0], max: x[1] });
      plot.setScale("y", { min: y[0], max: y[1] });
    });
  }

  private draw(u: uPlot): void {
    const c = u.ctx;
    const ratio = uPlot.pxRatio;
    const placed = this.placer(u, true);
    c.save();
    c.beginPath();
    c.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    c.clip();
    this.study.branches.forEach((branch, i) => {
      if (this.hidden.has(i)) return;
      if (this.study.isJoined) this.lines(placed, c, branch, colourOf(i), ratio);
      this.dots(placed, c, branch, colourOf(i), ratio);
      this.brokenOff(placed, c, branch, ratio);
    });
    const point = this.study.branches[this.here.branch]?.points[this.here.point];
    const place = point && placed(point.values);
    if (place) {
      c.beginPath();
      c.arc(place[0], place[1], 6 * ratio, 0, 2 * Math.PI);
      c.lineWidth = 2.5 * ratio;
      c.strokeStyle = this.theme.background;
      c.fillStyle = this.theme.load;
      c.fill();
      c.stroke();
    }
    c.restore();
  }

  /** Where points are: both axes are straight, so that two of their places say all. */
  private placer(u: uPlot, canvas: boolean): Placer {
    const axis = (scale: "x" | "y", column: number): ((values: number[]) => number) => {
      const { min, max } = u.scales[scale]!;
      const [low, high] = [min ?? 0, max ?? 1];
      const from = u.valToPos(low, scale, canvas);
      const per = (u.valToPos(high, scale, canvas) - from) / (high - low || 1);
      return (values) => from + per * (values[column]! - low);
    };
    const [x, y] = [axis("x", this.across), axis("y", this.up)];
    return (values) => {
      const [a, b] = [x(values), y(values)];
      return Number.isFinite(a) && Number.isFinite(b) ? [a, b] : null;
    };
  }

  private lines(placed: Placer, c: CanvasRenderingContext2D, branch: Branch, colour: string, ratio: number): void {
    c.strokeStyle = colour;
    c.lineJoin = "round";
    // A piece is as its ends are; at a fold or branch point itself nothing is decided, so the other end says it.
    const kindOf = (i: number): string => {
      const known = [branch.points[i - 1]!.stable, branch.points[i]!.stable].find((stable) => stable !== null);
      return known === undefined ? "undecided" : known ? "stable" : "unstable";
    };
    let run = "";
    c.beginPath();
    const finish = (): void => {
      const [width, dashes] = LINES[run] ?? LINES.stable!;
      c.lineWidth = width * ratio;
      c.setLineDash(dashes.map((length) => length * ratio));
      c.stroke();
      c.beginPath();
    };
    let before: [number, number] | null = null;
    branch.points.forEach((point, i) => {
      const place = placed(point.values);
      if (place && before) {
        const kind = kindOf(i);
        if (kind !== run) {
          if (run) finish();
          run = kind;
          c.moveTo(before[0], before[1]);
        }
        c.lineTo(place[0], place[1]);
      } else if (place) c.moveTo(place[0], place[1]);
      before = place;
    });
    finish();
    c.setLineDash([]);
  }

  /** Special points of a path; all points of a sweep, hollow where they failed. */
  private dots(placed: Placer, c: CanvasRenderingContext2D, branch: Branch, colour: string, ratio: number): void {
    for (const point of branch.points) {
      const isSpecial = point.kind === "fold" || point.kind === "branch" || point.kind === "event";
      if (this.study.isJoined && !isSpecial && branch.points.length > 1) continue;
      const place = placed(point.values);
      if (!place) continue;
      const [x, y] = place;
      const r = (isSpecial ? 5 : 3.5) * ratio;
      c.fillStyle = isSpecial ? this.theme.background : colour;
      c.strokeStyle = isSpecial ? this.theme.ink : colour;
      c.lineWidth = 1.6 * ratio;
      c.beginPath();
      if (point.kind === "branch") c.rect(x - r, y - r, 2 * r, 2 * r);
      else if (point.kind === "event") {
        c.moveTo(x, y - 1.3 * r);
        c.lineTo(x + 1.2 * r, y + r);
        c.lineTo(x - 1.2 * r, y + r);
        c.closePath();
      } else c.arc(x, y, r, 0, 2 * Math.PI);
      if (point.kind !== "failed") c.fill();
      c.stroke();
    }
  }

  /** Crosses where a branch could not be followed further. */
  private brokenOff(placed: Placer, c: CanvasRenderingContext2D, branch: Branch, ratio: number): void {
    branch.ends?.forEach((end, side) => {
      const point = branch.points[side === 0 ? 0 : branch.points.length - 1];
      const place = end.isBrokenOff && point ? placed(point.values) : null;
      if (!place) return;
      const [[x, y], r] = [place, 4.5 * ratio];
      c.strokeStyle = this.theme.alarm;
      c.lineWidth = 2 * ratio;
      c.beginPath();
      for (const sign of [-1, 1]) {
        c.moveTo(x - r, y - sign * r);
        c.lineTo(x + r, y + sign * r);
      }
      c.stroke();
    });
  }

  private listen(u: uPlot): void {
    u.over.addEventListener("click", (event) => {
      const rect = u.over.getBoundingClientRect();
      const spot = this.nearest(u, event.clientX - rect.left, event.clientY - rect.top);
      if (spot) this.choose(spot);
    });
  }

  private nearest(u: uPlot, x: number, y: number): Spot | null {
    let best: Spot | null = null;
    let least = NEAR;
    const placed = this.placer(u, false);
    this.study.branches.forEach((branch, b) => {
      if (this.hidden.has(b)) return;
      const hasShapes = this.study.isJoined && branch.points.some((point) => point.state);
      branch.points.forEach((point, p) => {
        if (hasShapes && !point.state) return;
        const place = placed(point.values);
        const distance = place ? Math.hypot(place[0] - x, place[1] - y) : Infinity;
        if (distance < least) [least, best] = [distance, { branch: b, point: p }];
      });
    });
    return best;
  }

  /** Where a point is in the window, CSS pixels. */
  locate(spot: Spot): [number, number] | null {
    const point = this.study.branches[spot.branch]?.points[spot.point];
    const place = this.plot && point ? this.placer(this.plot, false)(point.values) : null;
    if (!place || !this.plot) return null;
    const rect = this.plot.over.getBoundingClientRect();
    return [rect.left + place[0], rect.top + place[1]];
  }
}

export const colourOf = (branch: number): string => THINGS[branch % THINGS.length]!;

/** Multiples of 1, 2 or 5 times a power of ten about `step` apart. */
export function roundSplits(low: number, high: number, step: number): number[] {
  const power = 10 ** Math.floor(Math.log10(step));
  const round = [1, 2, 5, 10].map((k) => k * power).find((k) => k >= 0.999 * step) ?? step;
  const first = Math.ceil(low / round - 1e-9);
  const last = Math.floor(high / round + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * round);
}
