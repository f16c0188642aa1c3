/** The window on the mechanism: camera, light, layers, and the picture as a file. */

import {
  AmbientLight,
  BufferGeometry,
  Color,
  ColorManagement,
  DirectionalLight,
  DoubleSide,
  LinearSRGBColorSpace,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  OrthographicCamera,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Theme } from "../colours";
import type { Box, Vec } from "../math";
import { unit } from "../math";
import type { Layers } from "./layers";
import type { Pieces } from "./mesh";
import { Overlay } from "./overlay";

// Colours are given as they are seen.
ColorManagement.enabled = false;

export type View = "front" | "back" | "left" | "right" | "top" | "bottom" | "space" | "own";

/** From where the eye looks; of "own" the mechanism decides. */
const EYES: Record<Exclude<View, "own">, Vec> = {
  front: [0, -1, 0],
  back: [0, 1, 0],
  left: [-1, 0, 0],
  right: [1, 0, 0],
  top: [0, 0, 1],
  bottom: [0, 0, -1],
  space: [0.55, -1, 0.6],
};
const ANGLE = 30;
/** Room for the scale of colours and for remarks, px. */
const MARGIN = { right: 100, top: 44 };

export class Viewport {
  readonly overlay: Overlay;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly perspective = new PerspectiveCamera(ANGLE, 1, 0.01, 100);
  private readonly orthographic = new OrthographicCamera(-1, 1, 1, -1, -100, 100);
  private readonly controls: OrbitControls;
  private readonly light = new DirectionalLight(0xffffff, 1.0);
  private readonly beams: Mesh;
  private readonly things: Mesh;
  private readonly sheets: Mesh;
  private readonly thin: LineSegments;
  private readonly axes: LineSegments2;
  private readonly strings: LineSegments2;
  private isPerspective = true;
  private isQueued = false;
  private size = 1;
  private box: Box | null = null;
  /** From where the eye was last asked to look. */
  view: View = "own";
  private layers: Layers | null = null;
  /** Called after every frame: for what is laid over the window. */
  afterDraw: (() => void) | null = null;

  constructor(
    readonly canvas: HTMLCanvasElement,
    overlay: HTMLCanvasElement,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.overlay = new Overlay(overlay);
    const solid = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide });
    // A little in front of their axes, which are there for beams thinner than a pixel.
    const section = solid.clone();
    [section.polygonOffset, section.polygonOffsetFactor, section.polygonOffsetUnits] = [true, -2, -12];
    const sheet = new MeshLambertMaterial({
      vertexColors: true,
      side: DoubleSide,
      transparent: true,
      opacity: 0.28,
      depthWrite: false,
    });
    const fat = (linewidth: number): LineMaterial => new LineMaterial({ linewidth, vertexColors: true });
    this.beams = new Mesh(new BufferGeometry(), section);
    this.things = new Mesh(new BufferGeometry(), solid);
    this.sheets = new Mesh(new BufferGeometry(), sheet);
    this.thin = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ vertexColors: true }));
    this.axes = new LineSegments2(new LineSegmentsGeometry(), fat(2.2));
    this.strings = new LineSegments2(new LineSegmentsGeometry(), fat(1.8));
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.scene.add(new AmbientLight(0xffffff, 2.35), this.light, this.light.target);
    for (const object of this.objects) {
      object.frustumCulled = false;
      this.scene.add(object);
    }
    this.controls = new OrbitControls(this.perspective, overlay);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.redraw());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement ?? canvas);
    this.resize();
  }

  private get objects(): (Mesh | LineSegments)[] {
    return [this.beams, this.things, this.sheets, this.thin, this.axes, this.strings];
  }

  private get camera(): PerspectiveCamera | OrthographicCamera {
    return this.isPerspective ? this.perspective : this.orthographic;
  }

  /** What there is to see. */
  show(layers: Layers): void {
    this.layers = layers;
    const put = (object: Mesh | LineSegments, geometry: BufferGeometry, count: number): void => {
      object.geometry.dispose();
      object.geometry = geometry;
      object.visible = count > 0;
    };
    put(this.beams, layers.beams.geometry(), layers.beams.triangles);
    put(this.things, layers.things.geometry(), layers.things.triangles);
    put(this.sheets, layers.sheets.geometry(), layers.sheets.triangles);
    put(this.thin, layers.thin.geometry(), layers.thin.positions.length);
    const fat = (object: LineSegments2, pieces: Pieces): void => {
      const geometry = new LineSegmentsGeometry();
      if (pieces.positions.length > 0) {
        geometry.setPositions(new Float32Array(pieces.positions));
        geometry.setColors(new Float32Array(pieces.colours));
      }
      put(object, geometry, pieces.positions.length);
    };
    fat(this.axes, layers.axes);
    fat(this.strings, layers.strings);
    this.redraw();
  }

  paint(theme: Theme): void {
    this.scene.background = new Color(theme.background);
    this.overlay.theme = theme;
    this.redraw();
  }

  setPerspective(isPerspective: boolean): void {
    const before = this.camera;
    this.isPerspective = isPerspective;
    const after = this.camera;
    after.position.copy(before.position);
    if (!isPerspective) {
      const distance = before.position.distanceTo(this.controls.target);
      this.orthographic.zoom = this.size / (2 * distance * Math.tan((ANGLE * Math.PI) / 360));
    }
    this.controls.object = after;
    this.resize();
    this.controls.update();
  }

  /** Looks at a box from one side, all of it in sight. */
  fit(box: Box, view: View): void {
    this.box = box;
    this.view = view;
    const size = Math.max(box.size, 1e-9);
    this.size = size;
    const eye = unit(view === "own" ? ownEye(box) : EYES[view]);
    const target = new Vector3(...box.middle);
    // Straight from above there would be no upwards.
    const tilt = Math.abs(eye[2]) > 0.9999 ? new Vector3(0, -1e-4, 0) : new Vector3();
    const direction = new Vector3(...eye).add(tilt).normalize();
    const half = this.halfExtent(box, direction);
    const distance = half / Math.tan((ANGLE * Math.PI) / 360);
    this.camera.position.copy(target).addScaledVector(direction, distance);
    this.orthographic.zoom = this.size / (2 * half);
    [this.orthographic.near, this.orthographic.far] = [-50 * size, 50 * size];
    this.controls.target.copy(target);
    this.controls.minDistance = 0.01 * size;
    this.controls.maxDistance = 40 * size;
    this.resize();
    this.controls.update();
    this.redraw();
  }

  /** Half the height that a picture must have to hold the box beside what is written, with a margin for marks and labels. */
  private halfExtent(box: Box, direction: Vector3): number {
    const { width, height } = this.canvas.getBoundingClientRect();
    const room = (whole: number, margin: number): number => (whole > 2 * margin ? (whole - margin) / whole : 1);
    const [across, upright] = [room(width, MARGIN.right), room(height, MARGIN.top)];
    const aspect = width > 0 && height > 0 ? width / height : 1;
    const up = new Vector3(0, 0, 1);
    const right = new Vector3().crossVectors(up, direction);
    if (right.length() < 1e-6) right.set(1, 0, 0);
    right.normalize();
    const above = new Vector3().crossVectors(direction, right);
    const middle = new Vector3(...box.middle);
    let half = 0.12 * this.size;
    for (let i = 0; i < 8; i++) {
      const corner = new Vector3(
        (i & 1 ? box.high : box.low)[0],
        (i & 2 ? box.high : box.low)[1],
        (i & 4 ? box.high : box.low)[2],
      ).sub(middle);
      const depth = this.isPerspective ? corner.dot(direction) * Math.tan((ANGLE * Math.PI) / 360) : 0;
      half = Math.max(half, (Math.abs(corner.dot(above)) + depth) / upright, (Math.abs(corner.dot(right)) / aspect + depth) / across);
    }
    return 1.2 * half;
  }

  /** Turns the eye, rad; moves it nearer by a factor. */
  move(across: number, up: number, nearer = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const radius = offset.length();
    let polar = Math.acos(Math.min(1, Math.max(-1, offset.z / radius))) - up;
    polar = Math.min(Math.PI - 1e-3, Math.max(1e-3, polar));
    const azimuth = Math.atan2(offset.y, offset.x) - across;
    const far = this.isPerspective ? radius / nearer : radius;
    if (!this.isPerspective) this.orthographic.zoom *= nearer;
    const flat = Math.sin(polar);
    offset.set(flat * Math.cos(azimuth), flat * Math.sin(azimuth), Math.cos(polar)).multiplyScalar(far);
    this.camera.position.copy(this.controls.target).add(offset);
    this.orthographic.updateProjectionMatrix();
    this.controls.update();
    this.redraw();
  }

  /** Moves what is seen to the right and up, CSS pixels. */
  shift(right: number, up: number): void {
    const way = new Vector3(-right, -up, 0).applyQuaternion(this.camera.quaternion).multiplyScalar(this.metresPerPixel);
    this.camera.position.add(way);
    this.controls.target.add(way);
    this.controls.update();
    this.redraw();
  }

  /** Where a point is on the canvas, CSS pixels; z is its depth, between -1 and 1 where it is in sight. */
  project(p: Vec): Vec {
    const { width, height } = this.canvas.getBoundingClientRect();
    this.camera.updateMatrixWorld();
    const v = new Vector3(...p).project(this.camera);
    return [0.5 * (1 + v.x) * width, 0.5 * (1 - v.y) * height, v.z];
  }

  /** The point under a pixel at the depth of another point, and the unit vector of the line of sight there. */
  under(x: number, y: number, deep: Vec): { to: Vec; eye: Vec } {
    const { width, height } = this.canvas.getBoundingClientRect();
    const [, , depth] = this.project(deep);
    const [across, up] = [(2 * x) / width - 1, 1 - (2 * y) / height];
    const to = new Vector3(across, up, depth).unproject(this.camera);
    const before = new Vector3(across, up, depth - 1e-3 * (1 + Math.abs(depth))).unproject(this.camera);
    const eye = this.isPerspective ? to.clone().sub(this.camera.position) : to.clone().sub(before);
    eye.normalize();
    return { to: [to.x, to.y, to.z], eye: [eye.x, eye.y, eye.z] };
  }

  /** Metres per CSS pixel at the point that the eye looks at. */
  get metresPerPixel(): number {
    const { height } = this.canvas.getBoundingClientRect();
    if (!this.isPerspective) return this.size / this.orthographic.zoom / Math.max(1, height);
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((ANGLE * Math.PI) / 360)) / Math.max(1, height);
  }

  /** Work of the last frame. */
  get counts(): { triangles: number; calls: number } {
    return { triangles: this.renderer.info.render.triangles, calls: this.renderer.info.render.calls };
  }

  /** What is written beside things. */
  get labels(): string[] {
    return (this.layers?.labels ?? []).map(({ text }) => text);
  }

  redraw(): void {
    if (this.isQueued) return;
    this.isQueued = true;
    requestAnimationFrame(() => {
      this.isQueued = false;
      this.draw();
    });
  }

  draw(): void {
    const camera = this.camera;
    this.light.position.copy(camera.position);
    // From above the left shoulder, so that sides differ.
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    const distance = camera.position.distanceTo(this.controls.target);
    this.light.position.addScaledVector(right, -0.5 * distance).addScaledVector(up, 0.7 * distance);
    this.light.target.position.copy(this.controls.target);
    // As far apart as needed and no more, so that depths differ where they should.
    [this.perspective.near, this.perspective.far] = [0.02 * distance, distance + 20 * this.size];
    this.perspective.updateProjectionMatrix();
    this.renderer.render(this.scene, camera);
    if (this.layers) {
      const axis = (v: Vec): [number, number, number] => {
        const seen = new Vector3(...v).transformDirection(camera.matrixWorldInverse);
        return [seen.x, seen.y, seen.z];
      };
      this.overlay.draw(this.layers.labels, (p) => this.project(p), axis, this.metresPerPixel);
    }
    this.afterDraw?.();
  }

  private resize(): void {
    const { width, height } = (this.canvas.parentElement ?? this.canvas).getBoundingClientRect();
    if (!(width > 0 && height > 0)) return;
    this.renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.overlay.resize(width, height);
    this.perspective.aspect = width / height;
    this.perspective.updateProjectionMatrix();
    const half = 0.5 * this.size;
    const across = (half * width) / height;
    [this.orthographic.left, this.orthographic.right] = [-across, across];
    [this.orthographic.top, this.orthographic.bottom] = [half, -half];
    this.orthographic.updateProjectionMatrix();
    // The middle of what is seen is the middle of the room beside the scale of colours and below the remarks.
    const shift = [width > 2 * MARGIN.right ? 0.5 * MARGIN.right : 0, height > 2 * MARGIN.top ? -0.5 * MARGIN.top : 0] as const;
    for (const camera of [this.perspective, this.orthographic]) camera.setViewOffset(width, height, ...shift, width, height);
    this.draw();
  }

  /** The picture as it is seen, with all that is written on it. */
  picture(type = "image/png", quality?: number): string {
    this.draw();
    const sheet = document.createElement("canvas");
    [sheet.width, sheet.height] = [this.canvas.width, this.canvas.height];
    const context = sheet.getContext("2d");
    if (!context) throw new Error("this browser gives no canvas to draw the picture on");
    context.drawImage(this.canvas, 0, 0);
    context.drawImage(this.overlay.canvas, 0, 0, sheet.width, sheet.height);
    return sheet.toDataURL(type, quality);
  }

  get fitted(): Box | null {
    return this.box;
  }
}

/** Of a flat mechanism nearly across its plane, of another from above its front. */
function ownEye(box: Box): Vec {
  const [x, y, z] = box.extent;
  const flat = 0.04 * box.size;
  if (y <= flat) return [0.16, -1, 0.24];
  if (z <= flat) return [0, -0.35, 1];
  if (x <= flat) return [1, -0.3, 0.3];
  return EYES.space;
}
