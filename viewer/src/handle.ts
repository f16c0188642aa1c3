/** What pages around this one, tests among them, may ask it. */

import type { App } from "./app";
import type { Vec } from "./math";
import type { Spot } from "./panel/plot";
import type { View } from "./view/viewport";

/** For pages around this one: what they may ask it. */
export interface Handle {
  /** Moves to a point of a branch, both counted from zero. */
  go(spot: Spot): void;
  look(view: View): void;
  /** Where a point is on the window, CSS pixels. */
  project(p: Vec): Vec;
  /** Where a point of a path is in the plot, CSS pixels of the page. */
  locate(spot: Spot): [number, number] | null;
  picture(type?: string, quality?: number): string;
  readonly spot: Spot;
  readonly counts: { triangles: number; calls: number };
  /** What is written beside things: names and values. */
  readonly labels: string[];
  /** A beam's axis as it is seen, m. */
  line(name: string): Vec[];
  app: App;
}

declare global {
  interface Window {
    flexura?: Handle;
  }
}

export function handleOf(app: App): Handle {
  return {
    go: (spot) => app.go(spot),
    look: (view) => app.look(view),
    project: (p) => app.viewport.project(p),
    locate: (spot) => app.plot?.locate(spot) ?? null,
    picture: (type, quality) => app.viewport.picture(type, quality),
    get spot() {
      return app.spot;
    },
    get counts() {
      return app.viewport.counts;
    },
    get labels() {
      return app.viewport.labels;
    },
    line: (name) => app.seen().lines.get(name)?.p ?? [],
    app,
  };
}
