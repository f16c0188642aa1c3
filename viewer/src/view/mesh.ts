/** Triangles and lines put together from simple solids, so that a whole layer is one draw call. */

import { BufferAttribute, BufferGeometry } from "three";
import type { Rgb } from "../colours";
import { across, add, cross, norm, rotate, scale, sub, unit } from "../math";
import type { Pose, Vec } from "../math";

export class Solids {
  private readonly positions: number[] = [];
  private readonly normals: number[] = [];
  private readonly colours: number[] = [];
  private readonly faces: number[] = [];

  get triangles(): number {
    return this.faces.length / 3;
  }

  vertex(p: Vec, n: Vec, c: Rgb): number {
    this.positions.push(p[0], p[1], p[2]);
    this.normals.push(n[0], n[1], n[2]);
    this.colours.push(c[0], c[1], c[2]);
    return this.positions.length / 3 - 1;
  }

  face(a: number, b: number, c: number): void {
    this.faces.push(a, b, c);
  }

  quad(a: number, b: number, c: number, d: number): void {
    this.faces.push(a, b, c, a, c, d);
  }

  /** A flat polygon with corners counter-clockwise about its normal. */
  polygon(corners: Vec[], n: Vec, c: Rgb): void {
    const list = corners.map((corner) => this.vertex(corner, n, c));
    for (let i = 2; i < list.length; i++) this.face(list[0]!, list[i - 1]!, list[i]!);
  }

  /** A flat ring between two lines of equally many corners. */
  collar(outer: Vec[], inner: Vec[], n: Vec, c: Rgb): void {
    const rows = [outer, inner].map((corners) => corners.map((corner) => this.vertex(corner, n, c)));
    const [a, b] = rows as [number[], number[]];
    a.forEach((_, i) => {
      const k = (i + 1) % a.length;
      this.quad(a[i]!, a[k]!, b[k]!, b[i]!);
    });
  }

  /** A cone's stump from a to b, closed at both ends; a cylinder where the radii are equal. */
  stump(a: Vec, b: Vec, ra: number, rb: number, c: Rgb, sides = 10): void {
    const axis = sub(b, a);
    if (norm(axis) < 1e-300) return;
    const e = unit(axis);
    const u = across(e);
    const v = cross(e, u);
    const slope = (ra - rb) / norm(axis);
    const ring = (centre: Vec, r: number, i: number): Vec => {
      const angle = (2 * Math.PI * i) / sides;
      return add(centre, add(scale(u, r * Math.cos(angle)), scale(v, r * Math.sin(angle))));
    };
    const first = this.positions.length / 3;
    for (let i = 0; i <= sides; i++) {
      const angle = (2 * Math.PI * i) / sides;
      const n = unit(add(add(scale(u, Math.cos(angle)), scale(v, Math.sin(angle))), scale(e, slope)));
      this.vertex(ring(a, ra, i), n, c);
      this.vertex(ring(b, rb, i), n, c);
    }
    for (let i = 0; i < sides; i++) {
      const k = first + 2 * i;
      this.quad(k, k + 2, k + 3, k + 1);
    }
    const rim = (centre: Vec, r: number): Vec[] => Array.from({ length: sides }, (_, i) => ring(centre, r, i));
    if (ra > 0) this.polygon(rim(a, ra).reverse(), scale(e, -1), c);
    if (rb > 0) this.polygon(rim(b, rb), e, c);
  }

  cylinder(a: Vec, b: Vec, r: number, c: Rgb, sides = 10): void {
    this.stump(a, b, r, r, c, sides);
  }

  arrow(a: Vec, b: Vec, r: number, c: Rgb): void {
    const length = norm(sub(b, a));
    const head = Math.min(4.5 * r, 0.6 * length);
    const neck = add(b, scale(unit(sub(a, b)), head));
    this.cylinder(a, neck, r, c, 8);
    this.stump(neck, b, 2.3 * r, 0, c, 12);
  }

  sphere(centre: Vec, r: number, c: Rgb, around = 12): void {
    const rows = Math.max(2, Math.round(around / 2));
    const first = this.positions.length / 3;
    for (let j = 0; j <= rows; j++) {
      for (let i = 0; i <= around; i++) {
        const [u, v] = [(2 * Math.PI * i) / around, (Math.PI * j) / rows];
        const n: Vec = [Math.sin(v) * Math.cos(u), Math.sin(v) * Math.sin(u), Math.cos(v)];
        this.vertex(add(centre, scale(n, r)), n, c);
      }
    }
    for (let j = 0; j < rows; j++) {
      for (let i = 0; i < around; i++) {
        const k = first + j * (around + 1) + i;
        if (j > 0) this.face(k, k + around + 1, k + 1);
        if (j < rows - 1) this.face(k + 1, k + around + 1, k + around + 2);
      }
    }
  }

  box(pose: Pose, half: Vec, c: Rgb): void {
    for (let axis = 0; axis < 3; axis++) {
      for (const sign of [-1, 1]) {
        const corner = (a: number, b: number): Vec => {
          const local: Vec = [0, 0, 0];
          local[axis] = sign * half[axis]!;
          local[(axis + 1) % 3] = a * half[(axis + 1) % 3]!;
          local[(axis + 2) % 3] = b * half[(axis + 2) % 3]!;
          return add(pose.p, rotate(pose.q, local));
        };
        const n: Vec = [0, 0, 0];
        n[axis] = sign;
        const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
        this.polygon(sign > 0 ? corners : corners.reverse(), rotate(pose.q, n), c);
      }
    }
  }

  /** A part of a ring about an axis, from angle zero along `start`. */
  ring(centre: Vec, axis: Vec, start: Vec, radius: number, r: number, turn: number, c: Rgb): void {
    const side = cross(axis, start);
    const count = Math.max(6, Math.ceil(Math.abs(turn) * 5));
    const sides = 6;
    const first = this.positions.length / 3;
    for (let i = 0; i <= count; i++) {
      const angle = (turn * i) / count;
      const out = add(scale(start, Math.cos(angle)), scale(side, Math.sin(angle)));
      for (let j = 0; j <= sides; j++) {
        const a = (2 * Math.PI * j) / sides;
        const n = add(scale(out, Math.cos(a)), scale(axis, Math.sin(a)));
        this.vertex(add(centre, add(scale(out, radius), scale(n, r))), n, c);
      }
    }
    for (let i = 0; i < count; i++) {
      for (let j = 0; j < sides; j++) {
        const k = first + i * (sides + 1) + j;
        if (turn > 0) this.quad(k, k + sides + 1, k + sides + 2, k + 1);
        else this.quad(k, k + 1, k + sides + 2, k + sides + 1);
      }
    }
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute("normal", new BufferAttribute(new Float32Array(this.normals), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(this.colours), 3));
    geometry.setIndex(new BufferAttribute(new Uint32Array(this.faces), 1));
    return geometry;
  }
}

/** Separate pieces of lines. */
export class Pieces {
  readonly positions: number[] = [];
  readonly colours: number[] = [];

  piece(a: Vec, b: Vec, ca: Rgb, cb: Rgb = ca): void {
    this.positions.push(...a, ...b);
    this.colours.push(...ca, ...cb);
  }

  polyline(points: Vec[], c: Rgb): void {
    for (let i = 1; i < points.length; i++) this.piece(points[i - 1]!, points[i]!, c);
  }

  /** Every second of equally long pieces along a polygon. */
  dashes(points: Vec[], length: number, c: Rgb): void {
    let [left, isDrawn] = [length, true];
    for (let i = 1; i < points.length; i++) {
      let a = points[i - 1]!;
      const b = points[i]!;
      for (let rest = norm(sub(b, a)); rest > 0; rest = norm(sub(b, a))) {
        if (rest <= left) {
          if (isDrawn) this.piece(a, b, c);
          left -= rest;
          break;
        }
        const next = add(a, scale(unit(sub(b, a)), left));
        if (isDrawn) this.piece(a, next, c);
        [a, left, isDrawn] = [next, length, !isDrawn];
      }
    }
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute("color", new BufferAttribute(new Float32Array(this.colours), 3));
    return geometry;
  }
}
