/** Curves and surfaces that roll and slide on each other. */

import { hex } from "../colours";
import type { Rgb } from "../colours";
import { add, at, cross, rotate, scale, sub, unit } from "../math";
import type { Pose, Vec } from "../math";
import type { BoundaryScene } from "../data/types";
import type { Drawing, Layers } from "./layers";

/** A curve or surface that something rolls on; what has no end is cut to the size of the mechanism. */
export function boundary(
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
