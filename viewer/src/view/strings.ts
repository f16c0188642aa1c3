/** What is long and thin: springs, ligaments, cables; and the springs of foundations. */

import { hex } from "../colours";
import type { Rgb } from "../colours";
import { level, add, cross, norm, rotate, scale, sub, unit } from "../math";
import type { Pose, Vec } from "../math";
import { poseOf } from "../data/state";
import { quantity } from "../units";
import type { Drawing, Layers } from "./layers";
import type { Pieces } from "./mesh";

export function springs(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
  const colour = hex(theme.spring);
  for (const [name, own] of Object.entries(scene.springs ?? {})) {
    const result = state.document.springs?.[name];
    const [from, to] = [poseOf(state, own.from).p, poseOf(state, own.to).p];
    const course = state.isTrue && result?.course && result.course.length > 1 ? result.course : [from, to];
    const paint = result?.slack ? hex(theme.faint) : colour;
    if (course.length > 2) layers.strings.polyline(course, paint);
    else coil(layers.strings, from, to, 0.45 * g, paint);
    if (own.wrap) {
      const place = poseOf(state, own.wrap.place);
      if (own.wrap.axis) {
        const along = rotate(place.q, own.wrap.axis);
        const [a, b] = [-3, 3].map((k) => add(place.p, scale(along, k * g))) as [Vec, Vec];
        layers.sheets.cylinder(a, b, own.wrap.radius, hex(theme.metal), 32);
      } else layers.sheets.sphere(place.p, own.wrap.radius, hex(theme.metal), 32);
    }
    if (options.names) {
      const middle = course[Math.floor(course.length / 2)]!;
      const p = course.length > 2 ? middle : scale(add(from, to), 0.5);
      const tension = result ? (result.slack ? " slack" : ` ${quantity(result.tension, "N", 3)}`) : "";
      layers.labels.push({ p, text: name + tension, colour: theme.spring });
    }
  }
}

/** A helix from end to end with straight ends. */
function coil(pieces: Pieces, from: Vec, to: Vec, radius: number, c: Rgb): void {
  const way = sub(to, from);
  const length = norm(way);
  if (length < 3 * radius) {
    pieces.piece(from, to, c);
    return;
  }
  const e = unit(way);
  const u = level(e);
  const v = cross(e, u);
  const [turns, steps] = [8, 14];
  const points: Vec[] = [from];
  for (let i = 0; i <= turns * steps; i++) {
    const part = i / (turns * steps);
    const angle = (2 * Math.PI * i) / steps;
    const r = radius * Math.min(1, 8 * part, 8 * (1 - part));
    const middle = add(from, scale(e, length * (0.15 + 0.7 * part)));
    points.push(add(middle, add(scale(u, r * Math.cos(angle)), scale(v, r * Math.sin(angle)))));
  }
  points.push(to);
  pieces.polyline(points, c);
}

export function cables(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
  const colour = hex(theme.cable);
  for (const [name, own] of Object.entries(scene.cables ?? {})) {
    const result = state.document.cables?.[name];
    const guides = own.route.map((place) => poseOf(state, place).p);
    const course = state.isTrue && result && result.course.length > 1 ? result.course : guides;
    layers.strings.polyline(course, colour);
    for (const index of own.eyelets) {
      const place = guides[index];
      if (place) layers.things.sphere(place, 0.2 * g, colour, 10);
    }
    if (options.names) {
      const tension = result ? ` ${quantity(result.tension, "N", 3)}` : "";
      layers.labels.push({ p: course[Math.floor(0.5 * course.length)]!, text: name + tension, colour: theme.cable });
    }
  }
}

/** A band along the rest shape, and springs from it to the beam. */
export function foundations(layers: Layers, { state, rest, scene, theme, g }: Drawing): void {
  const colour = hex(theme.soil);
  for (const [name, beam] of Object.entries(scene.beams)) {
    const [line, before] = [state.lines.get(name), rest.lines.get(name)];
    if (!line || !before) continue;
    for (const own of beam.foundations ?? []) {
      const place = (list: typeof line, t: number): Pose => {
        const s = own.between[0] + (own.between[1] - own.between[0]) * t;
        return poseOf({ ...state, lines: new Map([["", list]]) }, { beam: "", s, position: [0, 0, 0] });
      };
      let last: [number, number] | null = null;
      for (let i = 0; i <= 24; i++) {
        const pose = place(before, i / 24);
        const tangent = rotate(pose.q, [1, 0, 0]);
        const across = own.direction
          ? own.frame === "section"
            ? rotate(pose.q, own.direction)
            : own.direction
          : level(tangent);
        const n = unit(cross(tangent, across));
        const pair: [number, number] = [
          layers.sheets.vertex(add(pose.p, scale(across, 2.5 * g)), n, colour),
          layers.sheets.vertex(add(pose.p, scale(across, -2.5 * g)), n, colour),
        ];
        if (last) layers.sheets.quad(last[0], last[1], pair[1], pair[0]);
        last = pair;
        layers.thin.piece(pose.p, place(line, i / 24).p, colour);
      }
    }
  }
}
