/** Glyphs of joints and supports, all of one size. */

import { hex } from "../colours";
import type { Rgb, Theme } from "../colours";
import { across, add, cross, dot, mix, norm, rotate, scale, sub, unit } from "../math";
import type { Pose, Quat, Vec } from "../math";
import type { Pieces, Solids } from "./mesh";

/** The rotation that turns x into a direction. */
export function along(direction: Vec): Quat {
  const half = unit(add(direction, [1, 0, 0]));
  if (direction[0] < -0.999999) return [0, 0, 0, 1];
  const axis = cross([1, 0, 0], half);
  return [half[0], axis[0], axis[1], axis[2]];
}

/** Where a joint is, and how it stands. */
export interface Stand {
  kind: string;
  fixed: Pose;
  moving: Pose;
  /** Global, of the fixed frame. */
  axis: Vec;
  second: Vec;
  isGrounded: boolean;
  isDriven: boolean;
}

export function joint(solids: Solids, pieces: Pieces, stand: Stand, g: number, theme: Theme): void {
  const ink = hex(stand.isDriven ? theme.load : theme.ground);
  const metal = hex(theme.metal);
  const p = stand.moving.p;
  const { axis, second } = stand;
  const side = cross(axis, second);
  const frame: Pose = { p, q: along(axis) };
  const span = (direction: Vec, length: number): [Vec, Vec] => [
    add(p, scale(direction, -length)),
    add(p, scale(direction, length)),
  ];
  const block = (): void => {
    // What is fixed to the ground: a plate below the joint, away from the axis.
    if (stand.isGrounded) foot(solids, pieces, p, scale(side, -1), g, theme);
  };
  // The rail stays where it is and reaches as far as the sleeve goes on it.
  const rail = (): [Vec, Vec] => {
    const travel = dot(sub(p, stand.fixed.p), axis);
    const place = (t: number): Vec => add(stand.fixed.p, scale(axis, t));
    return [place(Math.min(-2.6 * g, travel - 1.3 * g)), place(Math.max(2.6 * g, travel + 1.3 * g))];
  };
  switch (stand.kind) {
    case "weld":
      solids.box({ p, q: stand.moving.q }, [0.35 * g, 0.35 * g, 0.35 * g], metal);
      break;
    case "revolute": {
      const [a, b] = span(axis, 0.9 * g);
      solids.cylinder(a, b, 0.3 * g, ink, 14);
      for (const end of [a, b]) {
        solids.cylinder(add(end, scale(axis, -0.08 * g)), add(end, scale(axis, 0.08 * g)), 0.5 * g, metal, 14);
      }
      block();
      break;
    }
    case "prismatic": {
      const [a, b] = rail();
      const half = 0.5 * norm(sub(b, a));
      solids.box({ p: mix(a, b, 0.5), q: along(axis) }, [half, 0.14 * g, 0.14 * g], metal);
      solids.box(frame, [0.8 * g, 0.42 * g, 0.42 * g], ink);
      break;
    }
    case "cylindrical": {
      const [a, b] = rail();
      solids.cylinder(a, b, 0.16 * g, metal, 10);
      const [c, d] = span(axis, 0.8 * g);
      solids.cylinder(c, d, 0.45 * g, ink, 16);
      break;
    }
    case "universal": {
      solids.cylinder(...span(axis, 0.9 * g), 0.2 * g, ink, 10);
      solids.cylinder(...span(second, 0.9 * g), 0.2 * g, ink, 10);
      solids.ring(p, axis, second, 0.9 * g, 0.1 * g, Math.PI, metal);
      solids.ring(p, second, axis, 0.9 * g, 0.1 * g, Math.PI, metal);
      break;
    }
    case "spherical":
      solids.sphere(p, 0.5 * g, ink, 16);
      solids.ring(p, axis, second, 0.62 * g, 0.1 * g, 2 * Math.PI, metal);
      block();
      break;
    case "planar":
      solids.box({ p, q: along(axis) }, [0.05 * g, 1.1 * g, 1.1 * g], metal);
      solids.cylinder(p, add(p, scale(axis, 0.5 * g)), 0.3 * g, ink, 12);
      break;
    case "free": {
      const around = Array.from({ length: 25 }, (_, i): Vec => {
        const angle = (2 * Math.PI * i) / 24;
        return add(p, add(scale(second, g * Math.cos(angle)), scale(side, g * Math.sin(angle))));
      });
      pieces.dashes(around, 0.26 * g, hex(theme.faint));
      break;
    }
    default:
      break;
  }
}

/** A plate on the ground with hatching behind it; `outward` points into the ground. */
export function foot(solids: Solids, pieces: Pieces, p: Vec, outward: Vec, g: number, theme: Theme): void {
  const colour: Rgb = hex(theme.ground);
  const centre = add(p, scale(outward, 0.1 * g));
  solids.box({ p: centre, q: along(outward) }, [0.1 * g, 1.1 * g, 1.1 * g], hex(theme.metal));
  const u = across(outward);
  const v = cross(outward, u);
  for (let i = -2; i <= 2; i++) {
    const a = add(add(centre, scale(outward, 0.1 * g)), add(scale(u, 0.5 * i * g), scale(v, -1.1 * g)));
    const b = add(a, scale(v, 2.2 * g));
    const back = add(scale(outward, 0.5 * g), scale(u, 0.4 * g));
    for (const from of [a, b]) pieces.piece(from, add(from, back), colour);
  }
}

/** A curved arrow about an axis: a moment. */
export function turn(solids: Solids, p: Vec, axis: Vec, radius: number, r: number, c: Rgb): void {
  const start = across(axis);
  const most = 1.45 * Math.PI;
  solids.ring(p, axis, start, radius, r, most, c);
  const side = cross(axis, start);
  const end = add(p, scale(add(scale(start, Math.cos(most)), scale(side, Math.sin(most))), radius));
  const forward = add(scale(start, -Math.sin(most)), scale(side, Math.cos(most)));
  solids.stump(end, add(end, scale(forward, 5 * r)), 2.4 * r, 0, c, 10);
}

export const turned = (pose: Pose, v: Vec): Vec => rotate(pose.q, v);
