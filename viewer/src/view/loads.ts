/** Arrows of loads and reactions, with their values. */

import { hex } from "../colours";
import { add, norm, rotate, scale, unit } from "../math";
import type { Vec } from "../math";
import type { PlaceDocument, SceneDocument } from "../data/types";
import { poseOf } from "../data/state";
import type { State } from "../data/state";
import { quantity } from "../units";
import { turn } from "./joints";
import type { Drawing, Layers } from "./layers";

export function largestLoad({ scene, state }: Drawing): { force: number; moment: number } {
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

export function loads(layers: Layers, drawing: Drawing): void {
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
export function wrench(
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

export function reactions(layers: Layers, drawing: Drawing): void {
  const list = reactionsOf(drawing.state, drawing.scene);
  const largest = {
    force: Math.max(0, ...list.map((own) => norm(own.force))),
    moment: Math.max(0, ...list.map((own) => norm(own.moment))),
  };
  for (const { name, p, force, moment } of list) {
    wrench(layers, drawing, p, force, moment, drawing.theme.reaction, name, largest);
  }
}
