/** Everything that is drawn of one state, sorted into few layers, with the names and values that stand beside it. */

import { hex, THINGS } from "../colours";
import type { Rgb, Theme } from "../colours";
import { add, at, compose, cross, norm, ORIGIN, rotate, scale, sub, unit } from "../math";
import type { Pose, Vec } from "../math";
import type { BoundaryScene, HoldScene, PlaceDocument, SceneDocument } from "../data/types";
import { poseOf } from "../data/state";
import type { State } from "../data/state";
import { quantity } from "../units";
import { axis, polygonOf, sectionsFor, stationsOf, sweep } from "./beams";
import { foot, joint, turn, turned } from "./joints";
import { Pieces, Solids } from "./mesh";

export interface Options {
  quantity: string;
  ghost: boolean;
  loads: boolean;
  reactions: boolean;
  names: boolean;
  frames: boolean;
  surfaces: boolean;
}

export interface Label {
  p: Vec;
  text: string;
  colour: string;
}

/** One draw call each, where there is something in it. */
export interface Layers {
  beams: Solids;
  things: Solids;
  sheets: Solids;
  axes: Pieces;
  strings: Pieces;
  thin: Pieces;
  labels: Label[];
}

interface Drawing {
  state: State;
  rest: State;
  scene: SceneDocument;
  options: Options;
  theme: Theme;
  size: number;
  /** Size of glyphs. */
  g: number;
  colourOf: (value: number) => Rgb;
}

/** More bodies or beams than this have no names and plain marks. */
const CROWD = 40;
/** More of one kind than this have no names. */
const NAMED = 14;

export function layersOf(drawing: Drawing): Layers {
  const layers: Layers = {
    beams: new Solids(),
    things: new Solids(),
    sheets: new Solids(),
    axes: new Pieces(),
    strings: new Pieces(),
    thin: new Pieces(),
    labels: [],
  };
  beams(layers, drawing);
  tubes(layers, drawing);
  if (drawing.options.ghost) ghost(layers, drawing);
  bodies(layers, drawing);
  holds(layers, drawing);
  joints(layers, drawing);
  springs(layers, drawing);
  cables(layers, drawing);
  masses(layers, drawing);
  foundations(layers, drawing);
  if (drawing.options.loads) loads(layers, drawing);
  if (drawing.options.reactions) reactions(layers, drawing);
  if (drawing.options.frames) frames(layers, drawing);
  return layers;
}

/** Colour of a beam that is not coloured by a result. */
function plainColour({ scene, theme }: Drawing, index: number): Rgb {
  if (Object.keys(scene.beams).length > THINGS.length) return hex(theme.metal);
  return hex(THINGS[index % THINGS.length]!);
}

function beams(layers: Layers, drawing: Drawing): void {
  const { state, scene, options, size, colourOf } = drawing;
  const names = Object.keys(scene.beams);
  const most = sectionsFor(names.length);
  names.forEach((name, index) => {
    const line = state.lines.get(name);
    if (!line || line.s.length < 2) return;
    const plain = plainColour(drawing, index);
    const stations = stationsOf(line, scene.beams[name], most, options.quantity, colourOf, plain);
    sweep(layers.beams, stations, scene.beams[name], 0.006 * size, names.length <= CROWD);
    axis(layers.axes, stations);
    if (options.names && names.length <= NAMED) {
      const middle = stations[Math.floor(stations.length / 2)]!;
      layers.labels.push({ p: middle.p, text: name, colour: drawing.theme.ink });
    }
  });
}

function tubes(layers: Layers, drawing: Drawing): void {
  const { state, scene, options, size, colourOf, theme } = drawing;
  for (const [name, tubes] of Object.entries(scene.tubes ?? {})) {
    const line = state.lines.get(name);
    if (!line || line.s.length < 2) continue;
    tubes.tubes.forEach((tube, i) => {
      const colour = hex(THINGS[i % THINGS.length]!);
      const stations = stationsOf(line, undefined, 120, options.quantity, colourOf, colour);
      const own = stations.filter((station) => station.s <= tube.reach * (1 + 1e-9));
      const width = tube.outer ?? 0.004 * size * (i + 1);
      const dimensions = { shape: "tube", stations: [0], width: [width], height: [width] };
      sweep(layers.beams, own, { ...BARE, ...dimensions }, width, true);
      axis(layers.axes, own);
    });
    const base = poseOf(state, tubes.base);
    const back = scale(rotate(base.q, [1, 0, 0]), -1);
    foot(layers.things, layers.thin, base.p, back, drawing.g, theme);
    const tip = line.p[line.p.length - 1]!;
    if (options.loads) wrench(layers, drawing, tip, tubes.force, tubes.moment, theme.load, name, largestLoad(drawing));
  }
}

const BARE = { section: "", s: [], position: [], rotation: [] };

function ghost(layers: Layers, drawing: Drawing): void {
  const { rest, scene, theme, size } = drawing;
  const colour = hex(theme.faint);
  const few = rest.lines.size <= CROWD;
  for (const line of rest.lines.values()) {
    if (line.s.length < 2) continue;
    const points = polygonOf(line, few ? 300 : 6);
    if (few) layers.thin.dashes(points, 0.012 * size, colour);
    else layers.thin.polyline(points, colour);
  }
  if (rest.bodies.size > CROWD) return;
  for (const [name, places] of attachments(scene)) {
    const pose = rest.bodies.get(name);
    if (!pose) continue;
    for (const place of places) layers.thin.dashes([pose.p, at(pose, place)], 0.012 * size, colour);
  }
}

/** Points of bodies that something holds on to, in the bodies' axes. */
export function attachments(scene: SceneDocument): Map<string, Vec[]> {
  const places = new Map<string, Vec[]>();
  const put = (place: PlaceDocument | undefined): void => {
    if (place?.body === undefined) return;
    const list = places.get(place.body) ?? [];
    if (!list.some((other) => norm(sub(other, place.position)) < 1e-12)) list.push(place.position);
    places.set(place.body, list);
  };
  for (const beam of Object.values(scene.beams)) {
    put(beam.start?.place);
    put(beam.end?.place);
  }
  for (const joint of Object.values(scene.joints)) {
    put(joint.parent);
    put(joint.child);
  }
  for (const spring of Object.values(scene.springs ?? {})) {
    put(spring.from);
    put(spring.to);
    put(spring.wrap?.place);
  }
  for (const cable of Object.values(scene.cables ?? {})) cable.route.forEach(put);
  for (const load of Object.values(scene.loads ?? {})) put(load.place);
  for (const tubes of Object.values(scene.tubes ?? {})) put(tubes.base);
  return places;
}

function bodies(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
  const metal = hex(theme.metal);
  const isCrowd = state.bodies.size > CROWD;
  const places = attachments(scene);
  for (const [name, pose] of state.bodies) {
    for (const place of places.get(name) ?? []) {
      if (norm(place) > 0.05 * g) layers.things.cylinder(pose.p, at(pose, place), 0.16 * g, metal, isCrowd ? 4 : 8);
    }
    layers.things.sphere(pose.p, (isCrowd ? 0.22 : 0.3) * g, metal, isCrowd ? 4 : 12);
    const body = scene.bodies[name];
    if (body && body.mass > 0 && norm(body.center_of_mass) > 0) {
      layers.things.sphere(at(pose, body.center_of_mass), 0.24 * g, hex(theme.ink), 10);
    }
    if (options.names && state.bodies.size <= NAMED) layers.labels.push({ p: pose.p, text: name, colour: theme.ink });
  }
}

function holds(layers: Layers, { state, scene, theme, g }: Drawing): void {
  const isCrowd = Object.keys(scene.beams).length > 4 * CROWD;
  for (const [name, beam] of Object.entries(scene.beams)) {
    const line = state.lines.get(name);
    if (!line || line.s.length < 2) continue;
    const ends: [HoldScene | undefined, number, number][] = [
      [beam.start, 0, -1],
      [beam.end, line.s.length - 1, 1],
    ];
    for (const [hold, index, sign] of ends) {
      if (!hold) continue;
      const isGround = hold.place.body === undefined && hold.place.beam === undefined;
      const p = line.p[index]!;
      if (hold.kind === "weld") {
        const outward = scale(rotate(line.q[index]!, [1, 0, 0]), sign);
        if (isGround) foot(layers.things, layers.thin, p, outward, g, theme);
        continue;
      }
      if (isCrowd) continue;
      const carrier = poseOf(state, { ...hold.place, position: [0, 0, 0], rotation: [1, 0, 0, 0] });
      const axis = rotate(carrier.q, hold.axis);
      const second = acrossOf(axis);
      const pose: Pose = { p, q: line.q[index]! };
      const fixed = poseOf(state, hold.place);
      const stand = { kind: hold.kind, fixed, moving: pose, axis, second, isGrounded: isGround, isDriven: false };
      joint(layers.things, layers.thin, stand, 0.8 * g, theme);
    }
  }
}

function acrossOf(axis: Vec): Vec {
  const side = Math.abs(axis[2]) < 0.9 ? cross([0, 0, 1], axis) : cross([0, 1, 0], axis);
  return unit(side);
}

function joints(layers: Layers, drawing: Drawing): void {
  const { state, scene, theme, g, options } = drawing;
  for (const [name, own] of Object.entries(scene.joints)) {
    const fixed = poseOf(state, own.parent);
    const moving = poseOf(state, own.child);
    const isGround = (place: PlaceDocument): boolean => place.body === undefined && place.beam === undefined;
    const stand = {
      kind: own.kind,
      fixed,
      moving,
      axis: turned(fixed, own.axis),
      second: turned(fixed, own.second_axis),
      isGrounded: isGround(own.parent) || isGround(own.child),
      isDriven: own.driven,
    };
    joint(layers.things, layers.thin, stand, g, theme);
    const contact = state.isTrue ? state.document.joints?.[name]?.contact : undefined;
    if (own.boundaries && options.surfaces) {
      const near = contact?.point ?? moving.p;
      boundary(layers, drawing, own.boundaries.parent, fixed, near, theme.ground);
      boundary(layers, drawing, own.boundaries.child, moving, near, theme.contact);
    }
    if (contact) {
      layers.things.sphere(contact.point, 0.28 * g, hex(theme.load), 12);
      if (Number.isFinite(contact.force) && norm(contact.normal) > 0.5 && options.names) {
        const text = `${name} ${quantity(contact.force, "N", 3)}`;
        layers.labels.push({ p: contact.point, text, colour: theme.load });
      }
    }
  }
}

/** A curve or surface that something rolls on; what has no end is cut to the size of the mechanism. */
function boundary(
  layers: Layers,
  { size }: Drawing,
  own: BoundaryScene,
  pose: Pose,
  near: Vec,
  colour: string,
): void {
  const c = hex(colour);
  const local = rotate([pose.q[0], -pose.q[1], -pose.q[2], -pose.q[3]], sub(near, pose.p));
  switch (own.shape) {
    case "curve":
      layers.strings.polyline(own.points.map((point) => at(pose, point)), c);
      break;
    case "line": {
      const t = own.direction.reduce((sum, d, i) => sum + d * (local[i]! - own.point[i]!), 0);
      const end = (far: number): Vec => at(pose, add(own.point, scale(own.direction, t + far)));
      layers.strings.piece(end(-0.35 * size), end(0.35 * size), c);
      break;
    }
    case "plane": {
      const corner = (x: number, y: number): Vec => at(pose, [local[0] + 0.3 * size * x, local[1] + 0.3 * size * y, 0]);
      const corners = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
      layers.sheets.polygon(corners, rotate(pose.q, [0, 0, 1]), c);
      layers.thin.polyline([...corners, corners[0]!], c);
      break;
    }
    case "cylinder": {
      const [a, b] = own.semi_axes;
      const ring = (z: number): Vec[] =>
        Array.from({ length: 48 }, (_, i) => {
          const angle = (2 * Math.PI * i) / 48;
          return [a * Math.cos(angle), b * Math.sin(angle), local[2] + z] as Vec;
        });
      net(layers, pose, [ring(-0.3 * size), ring(0.3 * size)], c, 1);
      break;
    }
    case "net": {
      const count = own.points.length / own.rows;
      const rows = Array.from({ length: own.rows }, (_, i) => own.points.slice(i * count, (i + 1) * count));
      net(layers, pose, rows, c, 4);
      break;
    }
  }
}

/** Closed rings joined to a surface, with every so-manieth ring as a line. */
function net(layers: Layers, pose: Pose, rows: Vec[][], c: Rgb, every: number): void {
  const placed = rows.map((row) => row.map((point) => at(pose, point)));
  const count = placed[0]?.length ?? 0;
  const indices = placed.map((row, j) =>
    row.map((point, i) => {
      const left = row[(i + count - 1) % count]!;
      const right = row[(i + 1) % count]!;
      const down = (placed[j - 1] ?? row)[i]!;
      const up = (placed[j + 1] ?? row)[i]!;
      return layers.sheets.vertex(point, unit(cross(sub(right, left), sub(up, down))), c);
    }),
  );
  for (let j = 1; j < indices.length; j++) {
    for (let i = 0; i < count; i++) {
      const k = (i + 1) % count;
      layers.sheets.quad(indices[j - 1]![i]!, indices[j - 1]![k]!, indices[j]![k]!, indices[j]![i]!);
    }
  }
  placed.forEach((row, j) => {
    if (j % every === 0) layers.thin.polyline([...row, row[0]!], c);
  });
  for (let i = 0; i < count; i += 8) layers.thin.polyline(placed.map((row) => row[i]!), c);
}

function springs(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
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
  const u = acrossOf(e);
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

function cables(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
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

function masses(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
  for (const [name, own] of Object.entries(scene.masses ?? {})) {
    const { p } = poseOf(state, own.place);
    layers.things.sphere(p, 0.45 * g, hex(theme.ink), 14);
    if (options.names) layers.labels.push({ p, text: `${name} ${quantity(own.mass, "kg", 3)}`, colour: theme.ink });
  }
}

/** A band along the rest shape, and springs from it to the beam. */
function foundations(layers: Layers, { state, rest, scene, theme, g }: Drawing): void {
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
          : acrossOf(tangent);
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

function largestLoad({ scene, state }: Drawing): { force: number; moment: number } {
  const largest = { force: 0, moment: 0 };
  const take = (force: Vec, moment: Vec): void => {
    largest.force = Math.max(largest.force, norm(force));
    largest.moment = Math.max(largest.moment, norm(moment));
  };
  for (const [name, load] of Object.entries(scene.loads ?? {})) {
    const own = state.loads[name] ?? load;
    take(own.force, own.moment);
  }
  for (const own of Object.values(scene.tubes ?? {})) take(own.force, own.moment);
  return largest;
}

function loads(layers: Layers, drawing: Drawing): void {
  const { state, scene, theme } = drawing;
  const largest = largestLoad(drawing);
  for (const [name, load] of Object.entries(scene.loads ?? {})) {
    const own = state.loads[name] ?? load;
    const pose = poseOf(state, load.place);
    const seen = (v: Vec): Vec => scale(load.frame === "local" ? rotate(pose.q, v) : v, state.fraction);
    wrench(layers, drawing, pose.p, seen(own.force), seen(own.moment), theme.load, name, largest);
  }
  for (const [name, beam] of Object.entries(scene.beams)) {
    for (const own of beam.distributed ?? []) comb(layers, drawing, name, own);
  }
}

/** Arrows of a force and a moment, as long as they are large beside the others, with their values. */
function wrench(
  layers: Layers,
  { size, g, options }: Drawing,
  p: Vec,
  force: Vec,
  moment: Vec,
  colour: string,
  name: string,
  largest: { force: number; moment: number },
): void {
  const c = hex(colour);
  const [f, m] = [norm(force), norm(moment)];
  const label = (at: Vec, text: string): void => {
    layers.labels.push({ p: at, text: options.names ? text : text.slice(name.length).trim(), colour });
  };
  if (f > 1e-9 * largest.force && f > 0) {
    const length = size * (0.05 + 0.11 * Math.min(1, f / (largest.force || f)));
    const tip = add(p, scale(unit(force), length));
    layers.things.arrow(p, tip, 0.16 * g, c);
    label(tip, `${name} ${quantity(f, "N", 3)}`);
  }
  if (m > 1e-9 * largest.moment && m > 0) {
    const radius = g * (1 + 0.8 * Math.min(1, m / (largest.moment || m)));
    turn(layers.things, p, unit(moment), radius, 0.13 * g, c);
    label(add(p, scale(unit(moment), 0.6 * g)), `${name} ${quantity(m, "N·m", 3)}`);
  }
}

/** A load per length as a row of arrows. */
function comb(
  layers: Layers,
  { state, size, g, theme }: Drawing,
  name: string,
  own: { frame: string; s: number[]; force: Vec[]; moment: Vec[] },
): void {
  const c = hex(theme.load);
  const largest = Math.max(...own.force.map(norm));
  if (!(largest > 0)) return;
  own.s.forEach((s, i) => {
    const pose = poseOf(state, { beam: name, s, position: [0, 0, 0] });
    const force = own.frame === "section" ? rotate(pose.q, own.force[i]!) : own.force[i]!;
    const length = (0.07 * size * norm(force)) / largest;
    if (length < 0.004 * size) return;
    const tail = add(pose.p, scale(unit(force), -length));
    layers.things.arrow(tail, pose.p, 0.07 * g, c);
    if (i === Math.floor(own.s.length / 2)) {
      layers.labels.push({ p: tail, text: `${quantity(largest * state.fraction, "N/m", 3)}`, colour: theme.load });
    }
  });
}

/** Forces and moments of the ground on the mechanism. */
export function reactionsOf(state: State, scene: SceneDocument): { name: string; p: Vec; force: Vec; moment: Vec }[] {
  const list: { name: string; p: Vec; force: Vec; moment: Vec }[] = [];
  const isGround = (place: PlaceDocument | undefined): boolean =>
    place !== undefined && place.body === undefined && place.beam === undefined;
  for (const [name, beam] of Object.entries(scene.beams)) {
    const result = state.document.beams?.[name];
    const line = state.lines.get(name);
    if (!result || !line) continue;
    const last = result.force.length - 1;
    if (isGround(beam.start?.place)) {
      const minus = (v: Vec): Vec => scale(v, -1);
      list.push({ name, p: line.p[0]!, force: minus(result.force[0]!), moment: minus(result.moment[0]!) });
    }
    if (isGround(beam.end?.place)) {
      list.push({ name, p: line.p[last]!, force: result.force[last]!, moment: result.moment[last]! });
    }
  }
  for (const [name, own] of Object.entries(scene.joints)) {
    const result = state.document.joints?.[name];
    if (!result) continue;
    const p = poseOf(state, own.child).p;
    const sign = isGround(own.parent) ? 1 : isGround(own.child) ? -1 : 0;
    if (sign) list.push({ name, p, force: scale(result.force, sign), moment: scale(result.moment, sign) });
  }
  return list;
}

function reactions(layers: Layers, drawing: Drawing): void {
  const list = reactionsOf(drawing.state, drawing.scene);
  const largest = {
    force: Math.max(0, ...list.map((own) => norm(own.force))),
    moment: Math.max(0, ...list.map((own) => norm(own.moment))),
  };
  for (const { name, p, force, moment } of list) {
    wrench(layers, drawing, p, force, moment, drawing.theme.reaction, name, largest);
  }
}

/** e1, e2, e3 along the beams in red, green and blue. */
function frames(layers: Layers, { state, scene, g }: Drawing): void {
  const colours = ["#d55e00", "#009e73", "#0072b2"].map(hex);
  const few = Object.keys(scene.beams).length <= CROWD;
  for (const [name, line] of state.lines) {
    const length = line.s[line.s.length - 1] ?? 0;
    const count = few ? 13 : 2;
    for (let i = 0; i < count; i++) {
      const s = (length * i) / (count - 1);
      const pose = compose(poseOf(state, { beam: name, s, position: [0, 0, 0] }), ORIGIN);
      ([[1, 0, 0], [0, 1, 0], [0, 0, 1]] as Vec[]).forEach((e, k) => {
        layers.thin.piece(pose.p, add(pose.p, scale(rotate(pose.q, e), 1.2 * g)), colours[k]!);
      });
    }
  }
}
