/** Opens the page: unpacks the document and shows it, or says why that cannot be. */

import "./style.css";
import { App } from "./app";
import { unpacked } from "./data/unpack";
import type { ResultDocument } from "./data/types";
import type { Vec } from "./math";
import type { Spot } from "./panel/plot";
import { h } from "./panel/dom";
import type { View } from "./view/viewport";

/** For pages around this one: what they may ask it. */
interface Handle {
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

async function open(): Promise<void> {
  const root = document.getElementById("page");
  const packed = document.getElementById("document")?.textContent ?? "";
  if (!root) return;
  try {
    const app = new App(root, JSON.parse(await unpacked(packed)) as ResultDocument);
    window.flexura = {
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
    document.documentElement.dataset.ready = "true";
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    root.replaceChildren(h("p", { class: "waiting", role: "alert" }, `The result cannot be shown: ${why}`));
    document.documentElement.dataset.ready = "failed";
  }
}

void open();
