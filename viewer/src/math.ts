/** Vectors, rotations as (w, x, y, z), and poses. Metres and radians. */

export type Vec = [number, number, number];
export type Quat = [number, number, number, number];
export interface Pose {
  p: Vec;
  q: Quat;
}

export const ORIGIN: Pose = { p: [0, 0, 0], q: [1, 0, 0, 0] };

export const add = (a: Vec, b: Vec): Vec => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const sub = (a: Vec, b: Vec): Vec => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Vec, f: number): Vec => [a[0] * f, a[1] * f, a[2] * f];
export const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const norm = (a: Vec): number => Math.hypot(a[0], a[1], a[2]);
export const mix = (a: Vec, b: Vec, t: number): Vec => [
  a[0] + (b[0] - a[0]) * t,
  a[1] + (b[1] - a[1]) * t,
  a[2] + (b[2] - a[2]) * t,
];
export const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** Of the same direction with length one; x where there is no direction. */
export function unit(a: Vec): Vec {
  const n = norm(a);
  return n > 1e-300 ? scale(a, 1 / n) : [1, 0, 0];
}

/** A unit vector across a direction, level where there is one. */
export function level(axis: Vec): Vec {
  return unit(Math.abs(axis[2]) < 0.9 ? cross([0, 0, 1], axis) : cross([0, 1, 0], axis));
}

/** A unit vector across a unit vector. */
export function across(a: Vec): Vec {
  const other: Vec = Math.abs(a[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
  return unit(cross(a, other));
}

export function multiply(a: Quat, b: Quat): Quat {
  const [aw, ax, ay, az] = a;
  const [bw, bx, by, bz] = b;
  return [
    aw * bw - ax * bx - ay * by - az * bz,
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
  ];
}

export const conjugate = ([w, x, y, z]: Quat): Quat => [w, -x, -y, -z];

export function rotate([w, x, y, z]: Quat, v: Vec): Vec {
  const t: Vec = scale(cross([x, y, z], v), 2);
  return add(add(v, scale(t, w)), cross([x, y, z], t));
}

export const at = (pose: Pose, point: Vec): Vec => add(pose.p, rotate(pose.q, point));
export const compose = (a: Pose, b: Pose): Pose => ({ p: at(a, b.p), q: multiply(a.q, b.q) });

/** The rotation vector of a rotation. */
export function log(q: Quat): Vec {
  const [w, x, y, z] = q[0] < 0 ? (q.map((c) => -c) as Quat) : q;
  const sine = Math.hypot(x, y, z);
  if (sine < 1e-12) return [2 * x, 2 * y, 2 * z];
  const factor = (2 * Math.atan2(sine, w)) / sine;
  return [x * factor, y * factor, z * factor];
}

/** The rotation of a rotation vector. */
export function exp(v: Vec): Quat {
  const angle = norm(v);
  if (angle < 1e-12) return [1, 0.5 * v[0], 0.5 * v[1], 0.5 * v[2]];
  const factor = Math.sin(0.5 * angle) / angle;
  return [Math.cos(0.5 * angle), v[0] * factor, v[1] * factor, v[2] * factor];
}

/** Between two rotations, the short way. */
export function between(a: Quat, b: Quat, t: number): Quat {
  const sign = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  const q: Quat = [0, 0, 0, 0];
  for (let i = 0; i < 4; i++) q[i] = a[i]! * (1 - t) + sign * b[i]! * t;
  const n = Math.hypot(q[0], q[1], q[2], q[3]) || 1;
  return [q[0] / n, q[1] / n, q[2] / n, q[3] / n];
}

/** The box around points; null where there is none. */
export class Box {
  low: Vec = [Infinity, Infinity, Infinity];
  high: Vec = [-Infinity, -Infinity, -Infinity];

  include(point: Vec): void {
    if (!point.every(Number.isFinite)) return;
    for (let i = 0; i < 3; i++) {
      this.low[i] = Math.min(this.low[i]!, point[i]!);
      this.high[i] = Math.max(this.high[i]!, point[i]!);
    }
  }

  get isEmpty(): boolean {
    return !(this.low[0] <= this.high[0]);
  }

  get extent(): Vec {
    return this.isEmpty ? [0, 0, 0] : sub(this.high, this.low);
  }

  get middle(): Vec {
    return this.isEmpty ? [0, 0, 0] : mix(this.low, this.high, 0.5);
  }

  get size(): number {
    return norm(this.extent);
  }
}
