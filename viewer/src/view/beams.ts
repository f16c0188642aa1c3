/** Beams as solid sweeps of their sections: true width, height, twist and taper. */

import type { Rgb } from "../colours";
import { add, rotate, scale } from "../math";
import type { Quat, Vec } from "../math";
import type { BeamScene } from "../data/types";
import { placeOn, valueOn } from "../data/state";
import type { Line } from "../data/state";
import type { Pieces, Solids } from "./mesh";

/** Triangles that all sections together may have. */
const MOST_TRIANGLES = 90_000;
/** Between two sections a beam turns by no more than this where there are triangles for it, rad. */
const TURN = 0.06;

interface Station {
  p: Vec;
  q: Quat;
  s: number;
  colour: Rgb;
}

/** How many sections each of so many beams can have. */
export const sectionsFor = (beams: number): number =>
  Math.max(4, Math.min(160, Math.floor(MOST_TRIANGLES / (12 * Math.max(1, beams)))));

/** Where sections are drawn: where the line bends, where the section changes, and where the colour does. */
function places(line: Line, scene: BeamScene | undefined, most: number, isColoured: boolean): number[] {
  const length = line.s[line.s.length - 1] ?? 0;
  let turning = 0;
  for (let i = 1; i < line.q.length; i++) {
    const cosine = Math.abs(line.q[i]!.reduce((sum, c, k) => sum + c * line.q[i - 1]![k]!, 0));
    turning += 2 * Math.acos(Math.min(1, cosine));
  }
  const wanted = Math.max(isColoured ? 17 : 2, 2 + Math.ceil(turning / TURN));
  const count = Math.min(most, wanted);
  const list = Array.from({ length: count }, (_, i) => (length * i) / (count - 1));
  const own = scene?.stations ?? [];
  if (own.length > 1 && own.length + count <= 2 * most) list.push(...own.filter((s) => s > 0 && s < length));
  list.sort((a, b) => a - b);
  return list.filter((s, i) => i === 0 || s - list[i - 1]! > 1e-9 * length);
}

export function stationsOf(
  line: Line,
  scene: BeamScene | undefined,
  most: number,
  quantity: string,
  colourOf: (value: number) => Rgb,
  plain: Rgb,
): Station[] {
  const values = line.values[quantity];
  return places(line, scene, most, values !== undefined).map((s) => {
    const { p, q, index, part } = placeOn(line, s);
    const value = values ? valueOn(values, index, part) : Number.NaN;
    return { p, q, s, colour: Number.isFinite(value) ? colourOf(value) : plain };
  });
}

/** A dimension at an arc length, straight between the places where it is given. */
function dimension(scene: BeamScene, list: number[], s: number): number {
  if (list.length <= 1 || scene.stations.length !== list.length) return list[0] ?? 0;
  const upper = scene.stations.findIndex((station) => station > s);
  if (upper < 0) return list[list.length - 1]!;
  if (upper === 0) return list[0]!;
  const [a, b] = [scene.stations[upper - 1]!, scene.stations[upper]!];
  const t = b > a ? (s - a) / (b - a) : 0;
  return list[upper - 1]! * (1 - t) + list[upper]! * t;
}

/** Corners of a section with their normals, in (e2, e3); two neighbours share a flat side or a smooth one. */
interface Outline {
  corners: [number, number][];
  normals: [number, number][];
  /** Sides as pairs of corners. */
  sides: [number, number][];
}

function rectangle(width: number, height: number): Outline {
  const [y, z] = [0.5 * width, 0.5 * height];
  return {
    corners: [
      [y, -z],
      [y, z],
      [y, z],
      [-y, z],
      [-y, z],
      [-y, -z],
      [-y, -z],
      [y, -z],
    ],
    normals: [
      [1, 0],
      [1, 0],
      [0, 1],
      [0, 1],
      [-1, 0],
      [-1, 0],
      [0, -1],
      [0, -1],
    ],
    sides: [
      [0, 1],
      [2, 3],
      [4, 5],
      [6, 7],
    ],
  };
}

function ellipse(width: number, height: number, count: number): Outline {
  const corners: [number, number][] = [];
  const normals: [number, number][] = [];
  for (let i = 0; i < count; i++) {
    const angle = (2 * Math.PI * i) / count;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    corners.push([0.5 * width * c, 0.5 * height * s]);
    const size = Math.hypot(c / width, s / height) || 1;
    normals.push([c / width / size, s / height / size]);
  }
  return { corners, normals, sides: corners.map((_, i) => [i, (i + 1) % count]) };
}

/** The sweep of one beam. `rod` is the diameter that stands for a section without dimensions. */
export function sweep(
  solids: Solids,
  stations: Station[],
  scene: BeamScene | undefined,
  rod: number,
  isDetailed: boolean,
): void {
  const around = isDetailed ? 16 : 6;
  const outlineAt = (s: number): Outline => {
    if (!scene || scene.width.length === 0) return ellipse(rod, rod, isDetailed ? 10 : 4);
    const width = dimension(scene, scene.width, s);
    const height = dimension(scene, scene.height, s);
    return scene.shape === "rectangle" ? rectangle(width, height) : ellipse(width, height, around);
  };
  let before: number[] | null = null;
  stations.forEach((station, i) => {
    const outline = outlineAt(station.s);
    const space = ([y, z]: [number, number]): Vec => rotate(station.q, [0, y, z]);
    const ring = outline.corners.map((corner, k) =>
      solids.vertex(add(station.p, space(corner)), space(outline.normals[k]!), station.colour),
    );
    if (before) {
      for (const [a, b] of outline.sides) solids.quad(before[a]!, before[b]!, ring[b]!, ring[a]!);
    }
    if (i === 0 || i === stations.length - 1) {
      const corners = outline.corners.filter((_, k) => outline.sides.length === outline.corners.length || k % 2 === 0);
      const list = corners.map((corner) => add(station.p, space(corner)));
      const tangent = scale(rotate(station.q, [1, 0, 0]), i === 0 ? -1 : 1);
      const bore = scene?.inner?.length ? dimension(scene, scene.inner, station.s) : 0;
      if (bore > 0) {
        const hole = ellipse(bore, bore, around).corners.map((corner) => add(station.p, space(corner)));
        solids.collar(list, hole, tangent, station.colour);
      } else solids.polygon(i === 0 ? list.reverse() : list, tangent, station.colour);
    }
    before = ring;
  });
}

/** The axis as pieces of lines, so that a beam thinner than a pixel is still seen. */
export function axis(pieces: Pieces, stations: Station[]): void {
  for (let i = 1; i < stations.length; i++) {
    const [a, b] = [stations[i - 1]!, stations[i]!];
    pieces.piece(a.p, b.p, a.colour, b.colour);
  }
}

/** A smooth polygon along a line. */
export function polygonOf(line: Line, most: number): Vec[] {
  return places(line, undefined, most, false).map((s) => placeOn(line, s).p);
}

