/** Where everything is: a state of the mechanism, also magnified, swung or at rest. */

import { add, at, between, compose, conjugate, exp, log, mix, multiply, ORIGIN, rotate, scale, sub } from "../math";
import type { Pose, Quat, Vec } from "../math";
import type {
  BeamDocument,
  LoadDocuments,
  MotionShape,
  PlaceDocument,
  SceneDocument,
  StateDocument,
} from "./types";

/** A beam's axis; all lists run parallel. */
export interface Line {
  s: number[];
  p: Vec[];
  q: Quat[];
  /** Results by name; missing where a beam has none. */
  values: Record<string, number[]>;
}

export interface State {
  document: StateDocument;
  /** What is drawn besides; of a study whose parameter changes the mechanism each state has its own. */
  scene: SceneDocument;
  lines: Map<string, Line>;
  bodies: Map<string, Pose>;
  /** Loads that differ from the scene's. */
  loads: LoadDocuments;
  /** Part of the loads that acts. */
  fraction: number;
  /** Are the places those that were found, not magnified ones? */
  isTrue: boolean;
}

/** What a beam can be coloured by. */
export const QUANTITIES: { key: string; name: string; unit: string }[] = [
  { key: "stress", name: "stress (von Mises)", unit: "Pa" },
  { key: "strain", name: "surface strain", unit: "" },
  { key: "curvature", name: "bending curvature", unit: "1/m" },
  { key: "twist", name: "twist rate", unit: "rad/m" },
  { key: "moment", name: "moment", unit: "N·m" },
  { key: "force", name: "force", unit: "N" },
  { key: "axial", name: "axial force", unit: "N" },
  { key: "displacement", name: "displacement", unit: "m" },
];

function valuesOf(beam: BeamDocument): Record<string, number[]> {
  const length = ([x, y, z]: Vec): number => Math.hypot(x, y, z);
  const values: Record<string, number[]> = {
    curvature: beam.curvature.map(([, k2, k3]) => Math.hypot(k2, k3)),
    twist: beam.curvature.map(([k1]) => k1),
    moment: beam.moment.map(length),
    force: beam.force.map(length),
    axial: beam.force.map((force, i) => {
      const tangent = rotate(beam.rotation[i]!, [1, 0, 0]);
      return force[0] * tangent[0] + force[1] * tangent[1] + force[2] * tangent[2];
    }),
  };
  if (beam.stress) values.stress = beam.stress;
  if (beam.strain) values.strain = beam.strain;
  return values;
}

/** The state of a document. */
export function stateOf(
  document: StateDocument,
  scene: SceneDocument,
  loads: LoadDocuments = {},
  fraction = 1,
): State {
  const lines = new Map<string, Line>();
  const entries = [...Object.entries(document.beams ?? {}), ...Object.entries(document.tubes ?? {})];
  for (const [name, beam] of entries) {
    const line: Line = { s: beam.s, p: beam.position, q: beam.rotation, values: valuesOf(beam) };
    const rest = scene.beams[name];
    if (rest && rest.s.length > 1) {
      line.values.displacement = line.s.map((s, i) => {
        const before = placeOn({ s: rest.s, p: rest.position, q: rest.rotation, values: {} }, s).p;
        return Math.hypot(...sub(line.p[i]!, before));
      });
    }
    lines.set(name, line);
  }
  const bodies = new Map<string, Pose>();
  for (const [name, body] of Object.entries(document.bodies ?? {})) {
    bodies.set(name, { p: body.position, q: body.rotation });
  }
  return { document, scene, lines, bodies, loads, fraction, isTrue: true };
}

const rests = new WeakMap<SceneDocument, State>();

/** The undeformed mechanism of a scene. */
export function restOf(scene: SceneDocument): State {
  const known = rests.get(scene);
  if (known) return known;
  const made = makeRest(scene);
  rests.set(scene, made);
  return made;
}

function makeRest(scene: SceneDocument): State {
  const lines = new Map<string, Line>();
  for (const [name, beam] of Object.entries(scene.beams)) {
    lines.set(name, { s: beam.s, p: beam.position, q: beam.rotation, values: {} });
  }
  const bodies = new Map<string, Pose>();
  for (const [name, body] of Object.entries(scene.bodies)) {
    bodies.set(name, { p: body.position, q: body.rotation });
  }
  return { document: {}, scene, lines, bodies, loads: {}, fraction: 0, isTrue: false };
}

/** A section between samples: the axis as the cubic with the sections' directions, values in straight lines. */
export function placeOn(line: Line, s: number): Pose & { index: number; part: number } {
  const last = line.s.length - 1;
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (line.s[middle]! <= s) low = middle;
    else high = middle;
  }
  const index = Math.min(low, Math.max(0, last - 1));
  const step = last > 0 ? line.s[index + 1]! - line.s[index]! : 0;
  const part = step > 0 ? Math.min(1, Math.max(0, (s - line.s[index]!) / step)) : 0;
  if (part === 0) return { p: line.p[index]!, q: line.q[index]!, index, part };
  if (part === 1) return { p: line.p[index + 1]!, q: line.q[index + 1]!, index, part };
  const [a, b] = [line.p[index]!, line.p[index + 1]!];
  const [u, v] = [rotate(line.q[index]!, [1, 0, 0]), rotate(line.q[index + 1]!, [1, 0, 0])];
  const t = part;
  // Hermite's cubic; an axis that stretches is a little off between samples, by less than a picture shows.
  const [h00, h10] = [(1 + 2 * t) * (1 - t) ** 2, t * (1 - t) ** 2 * step];
  const [h01, h11] = [t * t * (3 - 2 * t), t * t * (t - 1) * step];
  const p = add(add(scale(a, h00), scale(u, h10)), add(scale(b, h01), scale(v, h11)));
  return { p, q: between(line.q[index]!, line.q[index + 1]!, part), index, part };
}

export const valueOn = (values: number[], index: number, part: number): number => {
  const a = values[index] ?? Number.NaN;
  const b = values[index + 1] ?? a;
  return part === 0 ? a : a + (b - a) * part;
};

/** Where a place is in a state. */
export function poseOf(state: State, place: PlaceDocument): Pose {
  let carrier: Pose = ORIGIN;
  if (place.body !== undefined) carrier = state.bodies.get(place.body) ?? ORIGIN;
  else if (place.beam !== undefined) {
    const line = state.lines.get(place.beam);
    if (line && line.s.length > 0) carrier = placeOn(line, place.s ?? 0);
  }
  return compose(carrier, { p: place.position, q: place.rotation ?? [1, 0, 0, 0] });
}

/** The state with displacements so many times as large; turnings follow as far as a turn is one. */
export function magnified(state: State, rest: State, factor: number): State {
  if (factor === 1) return state;
  const moved = (before: Pose, now: Pose): Pose => ({
    p: mix(before.p, now.p, factor),
    q: multiply(exp(scale(log(multiply(now.q, conjugate(before.q))), factor)), before.q),
  });
  const lines = new Map<string, Line>();
  for (const [name, line] of state.lines) {
    const before = rest.lines.get(name);
    if (!before || before.s.length < 2) {
      lines.set(name, line);
      continue;
    }
    const poses = line.s.map((s, i) => moved(placeOn(before, s), { p: line.p[i]!, q: line.q[i]! }));
    lines.set(name, { ...line, p: poses.map((pose) => pose.p), q: poses.map((pose) => pose.q) });
  }
  const bodies = new Map<string, Pose>();
  for (const [name, now] of state.bodies) {
    const before = rest.bodies.get(name);
    bodies.set(name, before ? moved(before, now) : now);
  }
  return { ...state, lines, bodies, isTrue: false };
}

/** The state moved along a small motion. */
export function swung(state: State, shape: MotionShape, amount: number): State {
  const moved = (pose: Pose, shift: Vec, turn: Vec): Pose => ({
    p: add(pose.p, scale(shift, amount)),
    q: multiply(exp(scale(turn, amount)), pose.q),
  });
  const lines = new Map<string, Line>();
  for (const [name, line] of state.lines) {
    const own = shape.beams[name];
    if (!own || own.displacement.length !== line.s.length) {
      lines.set(name, line);
      continue;
    }
    const poses = line.s.map((_, i) =>
      moved({ p: line.p[i]!, q: line.q[i]! }, own.displacement[i]!, own.turning[i]!),
    );
    lines.set(name, { ...line, p: poses.map((pose) => pose.p), q: poses.map((pose) => pose.q) });
  }
  const bodies = new Map<string, Pose>();
  for (const [name, pose] of state.bodies) {
    const own = shape.bodies[name];
    bodies.set(name, own ? moved(pose, own.displacement, own.turning) : pose);
  }
  return { ...state, lines, bodies, isTrue: false };
}

/** The largest displacement from rest. */
export function largestDisplacement(state: State, rest: State): number {
  let largest = 0;
  for (const line of state.lines.values()) {
    for (const value of line.values.displacement ?? []) largest = Math.max(largest, value);
  }
  for (const [name, pose] of state.bodies) {
    const before = rest.bodies.get(name);
    if (before) largest = Math.max(largest, Math.hypot(...sub(pose.p, before.p)));
  }
  return largest;
}

/** All points that a picture must hold. */
export function* pointsOf(state: State): Generator<Vec> {
  const { scene } = state;
  for (const [name, line] of state.lines) {
    const beam = scene.beams[name];
    const [y, z] = [beam?.width, beam?.height].map((list) => 0.5 * Math.max(0, ...(list ?? [])));
    for (let i = 0; i < line.p.length; i++) {
      yield line.p[i]!;
      if (!y || !z) continue;
      for (const [a, b] of [[y, z], [y, -z], [-y, z], [-y, -z]]) yield add(line.p[i]!, rotate(line.q[i]!, [0, a!, b!]));
    }
  }
  for (const pose of state.bodies.values()) yield pose.p;
  for (const joint of Object.values(scene.joints)) {
    yield poseOf(state, joint.parent).p;
    yield poseOf(state, joint.child).p;
    for (const [boundary, place] of [
      [joint.boundaries?.child, joint.child],
      [joint.boundaries?.parent, joint.parent],
    ] as const) {
      if (boundary && "points" in boundary) {
        const pose = poseOf(state, place);
        for (const point of boundary.points) yield at(pose, point);
      }
    }
  }
  for (const own of [...Object.values(scene.loads ?? {}), ...Object.values(scene.masses ?? {})]) {
    yield poseOf(state, own.place).p;
  }
  for (const [name, body] of Object.entries(scene.bodies)) {
    const pose = state.bodies.get(name);
    if (pose && body.mass > 0) yield at(pose, body.center_of_mass);
  }
  for (const spring of Object.values(scene.springs ?? {})) {
    yield poseOf(state, spring.from).p;
    yield poseOf(state, spring.to).p;
  }
  for (const cable of Object.values(scene.cables ?? {})) {
    for (const place of cable.route) yield poseOf(state, place).p;
  }
}
