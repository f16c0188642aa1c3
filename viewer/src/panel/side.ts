/** The panel beside the window: plot with its legend, table, model file. */

import type { App } from "../app";
import type { Study } from "../data/study";
import { button, choice, copy, fileName, h, save } from "./dom";
import { colourOf } from "./plot";
import { asText, csvOf, groupsOf, render } from "./table";

/** What lines and marks of a path mean: those that there are. */
function legendOf(study: Study): string {
  const points = study.branches.flatMap((branch) => branch.points);
  const special = (kind: string): boolean => points.some((point) => point.kind === kind);
  const isBroken = study.branches.some((branch) => branch.ends?.some((end) => end.isBrokenOff));
  const all: [boolean, string][] = [
    [points.some((point) => point.stable === true), "— stable"],
    [points.some((point) => point.stable === false), "- - unstable"],
    [points.every((point) => point.stable === null), "thin: stability not decided"],
    [special("fold"), "○ fold"],
    [special("branch"), "□ branch point"],
    [special("event"), "△ event"],
    [isBroken, "× not followed further"],
  ];
  return all.flatMap(([isThere, text]) => (isThere ? [text] : [])).join("   ");
}

export class Side {
  readonly element = h("aside", { class: "side", "aria-label": "results" });
  private readonly table = h("div", { class: "table", id: "table" });

  constructor(private readonly app: App) {}

  /** The panels of the study; the plots go into the elements that are returned. */
  fill(): { plot?: HTMLElement; parallel?: HTMLElement } {
    const { study } = this.app;
    const hosts: { plot?: HTMLElement; parallel?: HTMLElement } = {};
    const parts: HTMLElement[] = [];
    const hasMany = study.branches.length > 1 || study.branches.some((branch) => branch.points.length > 1);
    const hasPath = hasMany && study.columns.length > 1;
    if (hasPath) {
      hosts.plot = h("div", { class: "plot", id: "plot", role: "img", "aria-label": "plot; click on it to move the mechanism to the nearest point" });
      parts.push(h("section", { class: "plots" }, this.choices(), hosts.plot, this.legend()));
    }
    if (study.kind === "sweep" && hasPath) {
      hosts.parallel = h("div", { class: "parallel", id: "parallel" });
      parts.push(hosts.parallel);
    }
    parts.push(h("section", { class: "numbers" }, this.buttons(), this.table));
    const { text } = study.scene;
    if (text) {
      const take = button("copy", "copy the model file", () => void copy(text), { id: "copy-model" });
      parts.push(h("details", { class: "model" }, h("summary", {}, "model file"), take, h("pre", { id: "model", tabindex: 0 }, text)));
    }
    this.element.replaceChildren(...parts);
    return hosts;
  }

  private choices(): HTMLElement {
    const { study } = this.app;
    const names = study.columns.map(({ name }) => name);
    const show = (across: number, up: number): void => this.app.plot?.show(across, up);
    const now = (): [number, number] => this.app.plot?.columns ?? study.first;
    return h(
      "div",
      { class: "choices" },
      choice("up", names, study.first[1], (i) => show(now()[0], i), "plot-up"),
      choice("across", names, study.first[0], (i) => show(i, now()[1]), "plot-across"),
    );
  }

  /** One entry for each branch: shown or hidden, and a click on its name goes there. */
  private legend(): HTMLElement {
    const { study } = this.app;
    const entries = study.branches.map((branch, i) => {
      const swatch = h("span", { class: "swatch" });
      swatch.style.background = colourOf(i);
      const box = h("input", { type: "checkbox", checked: true, id: `branch-${i}`, "aria-label": `show branch ${branch.label}` });
      box.addEventListener("change", () => this.app.plot?.hide(i, !box.checked));
      const go = button(branch.label, `move to branch ${branch.label}`, () => this.app.go({ branch: i, point: 0 }), { id: `go-branch-${i}` });
      return h("li", {}, box, swatch, go);
    });
    const marks = study.isJoined && study.kind === "trace" ? h("p", { class: "marks" }, legendOf(study)) : null;
    return h("div", { class: "legend" }, h("ul", { id: "legend" }, ...entries), marks);
  }

  private buttons(): HTMLElement {
    const { app } = this;
    const groups = (): string => asText(groupsOf(app.study, app.point));
    return h(
      "div",
      { class: "choices" },
      button("copy table", "copy the table", () => void copy(groups()), { id: "copy-table" }),
      button("CSV", "save the numbers as CSV", () => save(fileName(app.study.document.model, "csv"), new Blob([csvOf(app.study)], { type: "text/csv" })), { id: "save-csv" }),
    );
  }

  update(): void {
    this.table.replaceChildren(render(groupsOf(this.app.study, this.app.point)));
  }
}
