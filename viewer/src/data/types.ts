/** The result document, as far as the page reads it. SI units. Nothing in it is trusted to be there. */

import type { Quat, Vec } from "../math";

export type Value = number | number[] | null;
export type Names<T> = Record<string, T>;

export interface PlaceDocument {
  body?: string;
  beam?: string;
  s?: number;
  position: Vec;
  rotation?: Quat;
}

export interface HoldScene {
  kind: string;
  axis: Vec;
  place: PlaceDocument;
}

export interface BeamScene {
  section: string;
  shape: string;
  material?: string;
  yield_strength?: number;
  stations: number[];
  width: number[];
  height: number[];
  inner?: number[];
  s: number[];
  position: Vec[];
  rotation: Quat[];
  start?: HoldScene;
  end?: HoldScene;
  distributed?: { frame: string; s: number[]; force: Vec[]; moment: Vec[] }[];
  foundations?: { between: [number, number]; direction?: Vec; frame: string }[];
}

export type BoundaryScene =
  | { shape: "curve"; points: Vec[] }
  | { shape: "line"; point: Vec; direction: Vec }
  | { shape: "plane" }
  | { shape: "cylinder"; semi_axes: [number, number] }
  | { shape: "net"; rows: number; points: Vec[] };

export interface JointScene {
  kind: string;
  parent: PlaceDocument;
  child: PlaceDocument;
  axis: Vec;
  second_axis: Vec;
  driven: boolean;
  boundaries?: { child: BoundaryScene; parent: BoundaryScene };
}

export interface SceneDocument {
  units: { outputs: Names<string>; parameters: Names<string> };
  gravity: Vec;
  beams: Names<BeamScene>;
  bodies: Names<{ position: Vec; rotation: Quat; mass: number; center_of_mass: Vec }>;
  joints: Names<JointScene>;
  springs?: Names<{
    from: PlaceDocument;
    to: PlaceDocument;
    law: string;
    wrap?: { place: PlaceDocument; radius: number; axis?: Vec };
  }>;
  cables?: Names<{ route: PlaceDocument[]; eyelets: number[] }>;
  tubes?: Names<{
    base: PlaceDocument;
    tubes: { reach: number; outer: number | null }[];
    force: Vec;
    moment: Vec;
  }>;
  masses?: Names<{ place: PlaceDocument; mass: number }>;
  loads?: Names<{ place: PlaceDocument; force: Vec; moment: Vec; frame: string }>;
  text?: string;
}

export interface BeamDocument {
  s: number[];
  position: Vec[];
  rotation: Quat[];
  force: Vec[];
  moment: Vec[];
  curvature: Vec[];
  stretch?: number[];
  stress?: number[] | null;
  strain?: number[] | null;
}

export interface StateDocument {
  beams?: Names<BeamDocument>;
  bodies?: Names<{ position: Vec; rotation: Quat }>;
  joints?: Names<{
    coordinates?: number[];
    efforts?: number[];
    force: Vec;
    moment: Vec;
    contact?: { point: Vec; normal: Vec; force: number };
  }>;
  springs?: Names<{ length: number; tension: number; slack?: boolean; course?: Vec[] }>;
  cables?: Names<{ length: number; tension: number; course: Vec[] }>;
  tubes?: Names<BeamDocument>;
}

/** A state that stands among others of a study. */
export interface ShownDocument {
  shape?: StateDocument;
  /** Where more than loads differs from the study's scene. */
  scene?: SceneDocument;
  loads?: LoadDocuments;
}

export type LoadDocuments = Names<{ force: Vec; moment: Vec }>;

export interface MotionShape {
  beams: Names<{ displacement: Vec[]; turning: Vec[] }>;
  bodies: Names<{ displacement: Vec; turning: Vec }>;
}

/** A document of any study; fields of one kind are missing in the others. */
export interface ResultDocument extends StateDocument {
  flexura: string;
  model: string;
  study: string;
  status: string;
  reason?: string;
  warnings?: string[];
  scene?: SceneDocument;
  parameters?: Names<number>;
  outputs?: Names<Value>;
  [field: string]: unknown;
}
