/** Everything that is drawn of one state, sorted into few layers, with the names and values that stand beside it. */

import { hex, THINGS } from "../colours";
import type { Rgb, Theme } from "../colours";
import { add, at, compose, level, norm, ORIGIN, rotate, scale, sub } from "../math";
import type { Pose, Vec } from "../math";
import type { HoldScene, PlaceDocument, SceneDocument } from "../data/types";
import { poseOf } from "../data/state";
import type { State } from "../data/state";
import { quantity } from "../units";
import { axis, polygonOf, sectionsFor, stationsOf, sweep } from "./beams";
import { boundary } from "./boundaries";
import { foot, joint, turned } from "./joints";
import { largestLoad, loads, reactions, wrench } from "./loads";
import { Pieces, Solids } from "./mesh";
import { cables, foundations, springs } from "./strings";

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

export interface Drawing {
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
    const mass = body?.mass ?? 0;
    if (body && mass > 0) layers.things.sphere(at(pose, body.center_of_mass), 0.34 * g, hex(theme.ink), isCrowd ? 4 : 10);
    const text = mass > 0 ? `${name} ${quantity(mass, "kg", 3)}` : name;
    if (options.names && state.bodies.size <= NAMED) layers.labels.push({ p: pose.p, text, colour: theme.ink });
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
      const second = level(axis);
      const pose: Pose = { p, q: line.q[index]! };
      const fixed = poseOf(state, hold.place);
      const stand = { kind: hold.kind, fixed, moving: pose, axis, second, isGrounded: isGround, isDriven: false };
      joint(layers.things, layers.thin, stand, 0.8 * g, theme);
    }
  }
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

function masses(layers: Layers, { state, scene, theme, g, options }: Drawing): void {
  for (const [name, own] of Object.entries(scene.masses ?? {})) {
    const { p } = poseOf(state, own.place);
    layers.things.sphere(p, 0.45 * g, hex(theme.ink), 14);
    if (options.names) layers.labels.push({ p, text: `${name} ${quantity(own.mass, "kg", 3)}`, colour: theme.ink });
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
