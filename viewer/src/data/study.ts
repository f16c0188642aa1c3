/** Any result document as branches of points: what there is to plot, and what there is to show at each. */

import type { Line, State } from "./state";
import { stateOf } from "./state";
import type { MotionShape, Names, ResultDocument, SceneDocument, ShownDocument, StateDocument, Value } from "./types";
import type { Quat, Vec } from "../math";

/** Something with a number at every point. */
export interface Column {
  name: string;
  unit: string;
}

export interface Point {
  /** Parallel to the columns; NaN where there is no number. */
  values: number[];
  stable: boolean | null;
  /** "regular", "fold", "branch", "event", "end" or "failed". */
  kind: string;
  note: string;
  state: (() => State) | null;
}

export interface Branch {
  label: string;
  points: Point[];
  /** Of a path: why it ends where it does, at its first and at its last point. */
  ends?: [End, End];
}

export interface End {
  /** "start", "range", "stop", "closed", "point_limit", "stalled" or "interrupted". */
  word: string;
  reason: string;
  /** Could it not be followed further? */
  isBrokenOff: boolean;
}

export interface Mode {
  value: number;
  error: number;
  shape: MotionShape;
}

export interface Study {
  document: ResultDocument;
  scene: SceneDocument;
  kind: string;
  columns: Column[];
  /** Positions of the columns that are plotted first: across and up. */
  first: [number, number];
  branches: Branch[];
  modes: Mode[];
  /** Are points joined by lines? Those of a sweep are not. */
  isJoined: boolean;
  isConverged: boolean;
  /** What a picture of an unconverged result says. */
  alarm: string;
}

const EMPTY: SceneDocument = {
  units: { outputs: {}, parameters: {} },
  gravity: [0, 0, 0],
  beams: {},
  bodies: {},
  joints: {},
};

/** Columns of outputs: one for a number, three for a vector. */
class Outputs {
  readonly columns: Column[] = [];
  private readonly names: [string, number | null][] = [];

  constructor(samples: Iterable<Names<Value> | undefined>, units: Names<string>) {
    const known = new Map<string, boolean>();
    for (const sample of samples) {
      for (const [name, value] of Object.entries(sample ?? {})) {
        if (value !== null) known.set(name, Array.isArray(value));
      }
    }
    for (const [name, isVector] of known) {
      const unit = units[name] ?? "";
      if (!isVector) this.push(name, unit, name, null);
      else ["x", "y", "z"].forEach((axis, i) => this.push(`${name}.${axis}`, unit, name, i));
    }
  }

  private push(shown: string, unit: string, name: string, component: number | null): void {
    this.columns.push({ name: shown, unit });
    this.names.push([name, component]);
  }

  read(values: Names<Value> | undefined): number[] {
    return this.names.map(([name, component]) => {
      const value = values?.[name];
      const number = component === null ? value : (value as number[] | null | undefined)?.[component];
      return typeof number === "number" ? number : Number.NaN;
    });
  }
}

/** Made when it is first asked for, and kept. */
function once<T>(make: () => T): () => T {
  let made: T | undefined;
  return () => (made ??= make());
}

const number = (value: unknown): number => (typeof value === "number" ? value : Number.NaN);

/** The studies of a document: of `flexura run` all, by name, of others the one. */
export function studiesOf(document: ResultDocument): [string, Study][] {
  const inner = document.studies as Names<ResultDocument> | undefined;
  const named: [string, ResultDocument][] = document.study === "run" && inner ? Object.entries(inner) : [[document.study, document]];
  return named.flatMap(([name, own]): [string, Study][] => {
    const study = studyOf(own);
    const critical = criticalOf(study);
    return critical ? [[name, study], [`${name}, critical curve`, critical]] : [[name, study]];
  });
}

export function studyOf(document: ResultDocument): Study {
  const scene: SceneDocument = { ...EMPTY, ...(document.scene ?? {}) };
  const isConverged = document.status === "converged";
  const fraction = number(document.load_fraction);
  const reached = Number.isFinite(fraction) ? ` at ${(100 * fraction).toPrecision(3)} % of the load` : "";
  const base: Study = {
    document,
    scene,
    kind: document.study,
    columns: [],
    first: [0, 0],
    branches: [],
    modes: [],
    isJoined: true,
    isConverged,
    alarm: isConverged ? "" : `NOT CONVERGED: ${document.status.replace(/_/g, " ")}${reached}`,
  };
  switch (document.study) {
    case "trace":
      return ofTrace(base);
    case "inverse_dynamics":
      return ofMotion(base);
    case "sweep":
      return ofSweep(base);
    case "buckle":
      return ofBuckling(base);
    default:
      return ofSolve(base);
  }
}

function ofSolve(study: Study): Study {
  const { document, scene } = study;
  const outputs = new Outputs([document.outputs], scene.units.outputs);
  const fraction = Number.isFinite(number(document.load_fraction)) ? number(document.load_fraction) : 1;
  const point: Point = {
    values: outputs.read(document.outputs),
    stable: (document.stable as boolean | null) ?? null,
    kind: study.isConverged ? "end" : "failed",
    note: "",
    state: document.scene ? once(() => stateOf(document, scene, {}, fraction)) : null,
  };
  const others = (document.equilibria as EquilibriumPoint[] | undefined) ?? [];
  if (others.length === 0) return { ...study, columns: outputs.columns, branches: [{ label: "equilibrium", points: [point] }] };
  return withOthers(study, point, others);
}

interface EquilibriumPoint extends ShownDocument {
  energy: number;
  stable: boolean | null;
  outputs: Names<Value>;
}

/** Several equilibria under one load: each a branch of its own, to be chosen in the legend. */
function withOthers(study: Study, rest: Point, others: EquilibriumPoint[]): Study {
  const outputs = new Outputs([study.document.outputs, ...others.map((own) => own.outputs)], study.scene.units.outputs);
  const first: Point = { ...rest, values: [...outputs.read(study.document.outputs), number(study.document.energy)] };
  const branches = others.map((own, i): Branch => {
    const values = [...outputs.read(own.outputs), number(own.energy)];
    const word = own.stable === null ? "" : own.stable ? ", stable" : ", unstable";
    const point: Point = { values, stable: own.stable, kind: "regular", note: "", state: stateAt(study, own, own.shape) };
    return { label: `equilibrium ${i + 1}${word}`, points: [point] };
  });
  const columns = [...outputs.columns, { name: "strain energy", unit: "J" }];
  const up = columns.length - 1;
  return { ...study, columns, first: [0, up], branches: [{ label: "reached from rest", points: [first] }, ...branches], isJoined: false };
}

/** The state of a point, made when it is first looked at. */
function stateAt(study: Study, own: ShownDocument, shape: StateDocument | undefined): (() => State) | null {
  if (!shape || !study.document.scene) return null;
  return once(() => {
    const { units } = study.scene;
    return stateOf(shape, own.scene ? { ...EMPTY, ...own.scene, units } : study.scene, own.loads ?? {});
  });
}

function ofBuckling(study: Study): Study {
  const solved = ofSolve(study);
  const modes = (study.document.modes as { value: number; error_estimate: number; shape: MotionShape }[]) ?? [];
  return {
    ...solved,
    modes: modes.map((mode) => ({ value: mode.value, error: mode.error_estimate, shape: mode.shape })),
  };
}

interface TracePoint extends StateDocument, ShownDocument {
  parameter: number;
  second_parameter?: number;
  arc: number;
  kind: string;
  crossing?: string;
  event?: string;
  outputs: Names<Value>;
  stable: boolean | null;
  unstable_directions: number | null;
}

interface BranchDocument {
  origin: string;
  points: TracePoint[];
  ends?: string[];
  end_reasons?: (string | null)[];
}

function endOf(branch: BranchDocument, side: 0 | 1): End {
  const word = branch.ends?.[side] ?? "";
  return { word, reason: branch.end_reasons?.[side] ?? "", isBrokenOff: ["stalled", "point_limit", "interrupted"].includes(word) };
}

const ORIGINS: Names<string> = {
  rest: "from rest",
  branch_point: "from a branch point",
  search: "found by search",
  imperfection: "found by an imperfection",
};

function ofTrace(study: Study): Study {
  const { document, scene } = study;
  const branches = (document.branches as BranchDocument[] | undefined) ?? [];
  const all = branches.flatMap((branch) => branch.points);
  const outputs = new Outputs(
    all.map((point) => point.outputs),
    scene.units.outputs,
  );
  const parameter = String(document.parameter);
  const columns = [
    { name: parameter, unit: scene.units.parameters[parameter] ?? "" },
    ...outputs.columns,
    { name: "arc", unit: "" },
  ];
  const pointOf = (point: TracePoint): Point => ({
    values: [point.parameter, ...outputs.read(point.outputs), point.arc],
    stable: point.stable,
    kind: point.kind,
    note: (point.crossing ?? point.event ?? "").replace(/_/g, " "),
    state: stateAt(study, point, point.beams ? point : point.shape),
  });
  return {
    ...study,
    columns,
    first: [1, 0],
    branches: branches.map((branch, i) => ({
      label: `${i + 1} ${ORIGINS[branch.origin] ?? branch.origin}`,
      points: branch.points.map(pointOf),
      ends: [endOf(branch, 0), endOf(branch, 1)],
    })),
  };
}

/** The curve on which a fold or branch point lies as a second parameter changes. */
function criticalOf(study: Study): Study | null {
  const { document, scene } = study;
  const curve = document.critical as { parameter: string; kind: string; points: TracePoint[] } | undefined;
  if (!curve || curve.points.length === 0) return null;
  const outputs = new Outputs(curve.points.map((point) => point.outputs), scene.units.outputs);
  const names = [curve.parameter, String(document.parameter)];
  const points = curve.points.map((point): Point => ({
    values: [number(point.second_parameter), point.parameter, ...outputs.read(point.outputs)],
    stable: point.stable,
    kind: "regular",
    note: "",
    state: stateAt(study, point, point.beams ? point : point.shape),
  }));
  return {
    ...study,
    kind: "critical",
    columns: [...names.map((name) => ({ name, unit: scene.units.parameters[name] ?? "" })), ...outputs.columns],
    first: [0, 1],
    branches: [{ label: curve.kind.replace(/_/g, " "), points }],
  };
}

interface Motions extends ResultDocument {
  times: number[];
}

function ofMotion(study: Study): Study {
  const document = study.document as Motions;
  const scene = study.scene;
  const series = (document.outputs ?? {}) as unknown as Names<(number | number[] | null)[]>;
  const at = (i: number): Names<Value> =>
    Object.fromEntries(Object.entries(series).map(([name, list]) => [name, list[i] ?? null]));
  const samples = document.times.map((_, i) => at(i));
  const outputs = new Outputs(samples, scene.units.outputs);
  const parameter = String(document.parameter);
  const extra: [string, string, string][] = [
    ["value", parameter, scene.units.parameters[parameter] ?? ""],
    ["drive_power", "drive power", "W"],
    ["gravity_power", "power of gravity", "W"],
    ["kinetic_energy", "kinetic energy", "J"],
    ["energy", "strain energy", "J"],
  ];
  const columns = [
    { name: "time", unit: "s" },
    ...outputs.columns,
    ...extra.map(([, name, unit]) => ({ name, unit })),
  ];
  const points = document.times.map((time, i): Point => {
    const more = extra.map(([key]) => number((document[key] as number[] | undefined)?.[i]));
    return {
      values: [time, ...outputs.read(samples[i]), ...more],
      stable: null,
      kind: i === 0 || i === document.times.length - 1 ? "end" : "regular",
      note: "",
      state: document.scene ? once(() => instant(document, scene, i)) : null,
    };
  });
  return { ...study, columns, first: [0, 1], branches: [{ label: "motion", points }] };
}

/** A motion at one of its times. */
function instant(document: Motions, scene: SceneDocument, i: number): State {
  interface Series {
    position: Vec[];
    rotation: Quat[];
  }
  interface Joints {
    coordinates: number[][];
    efforts: number[][];
    force: Vec[];
    moment: Vec[];
    contact_point?: Vec[];
  }
  const pick = <A, B>(list: unknown, make: (one: A) => B): Names<B> =>
    Object.fromEntries(Object.entries((list ?? {}) as Names<A>).map(([name, one]) => [name, make(one)]));
  const state: StateDocument = {
    bodies: pick(document.bodies, (body: Series) => ({
      position: body.position[i]!,
      rotation: body.rotation[i]!,
    })),
    joints: pick(document.joints, (joint: Joints) => {
      const point = joint.contact_point?.[i];
      return {
        coordinates: joint.coordinates[i],
        efforts: joint.efforts[i],
        force: joint.force[i]!,
        moment: joint.moment[i]!,
        ...(point ? { contact: { point, normal: [0, 0, 0] as Vec, force: Number.NaN } } : {}),
      };
    }),
    springs: pick(document.springs, (spring: { length: number[]; tension: number[] }) => ({
      length: spring.length[i]!,
      tension: spring.tension[i]!,
    })),
    cables: pick(document.cables, (cable: { length: number[]; tension: number[] }) => ({
      length: cable.length[i]!,
      tension: cable.tension[i]!,
      course: [],
    })),
  };
  return stateOf(state, scene);
}

interface Sample extends ShownDocument {
  parameters: Names<number>;
  status: string;
  reason?: string;
  outputs: Names<Value>;
  energy: number | null;
  stable?: boolean | null;
  warnings?: string[];
}

function ofSweep(study: Study): Study {
  const { document, scene } = study;
  const samples = (document.samples as Sample[]) ?? [];
  const varied = Object.keys((document.vary as Names<number[]>) ?? {});
  const outputs = new Outputs(
    samples.map((sample) => sample.outputs),
    scene.units.outputs,
  );
  const columns = [
    ...varied.map((name) => ({ name, unit: scene.units.parameters[name] ?? "" })),
    ...outputs.columns,
    { name: "energy", unit: "J" },
  ];
  const points = samples.map((sample): Point => {
    const isConverged = sample.status === "converged";
    return {
      values: [
        ...varied.map((name) => number(sample.parameters[name])),
        ...outputs.read(sample.outputs),
        number(sample.energy),
      ],
      stable: sample.stable ?? null,
      kind: isConverged ? "regular" : "failed",
      note: [isConverged ? "" : sample.status.replace(/_/g, " "), sample.reason ?? "", ...(sample.warnings ?? [])].filter(Boolean).join("; "),
      state: stateAt(study, sample, sample.shape),
    };
  });
  const missing = samples.filter((sample) => sample.status !== "converged").length;
  return {
    ...study,
    columns,
    first: [0, Math.min(varied.length, columns.length - 1)],
    branches: [{ label: `${samples.length} samples`, points }],
    isJoined: false,
    alarm: missing > 0 ? `${missing} of ${samples.length} samples did not converge` : "",
  };
}

/** Range of a result over all points with a state, for one scale of colours. */
export function rangeOf(study: Study, quantity: string): [number, number] | null {
  let [low, high] = [Infinity, -Infinity];
  for (const branch of study.branches) {
    for (const point of branch.points) {
      const lines: Iterable<Line> = point.state?.().lines.values() ?? [];
      for (const line of lines) {
        for (const value of line.values[quantity] ?? []) {
          if (!Number.isFinite(value)) continue;
          low = Math.min(low, value);
          high = Math.max(high, value);
        }
      }
    }
  }
  return low <= high ? [low, high] : null;
}
