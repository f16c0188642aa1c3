/** The model file, to be changed in the page; messages stand behind the lines that they are about. */

import { h } from "../panel/dom";
import type { Problem } from "./solver";

/** Height of a line, px; as in the style sheet. */
const LINE = 18;
/** After so many milliseconds without a stroke the text is read. */
const PAUSE = 250;

export class Editor {
  readonly element: HTMLElement;
  readonly area: HTMLTextAreaElement;
  private readonly gutter = h("div", { class: "gutter", "aria-hidden": "true" });
  private readonly marks = h("div", { class: "marks-at-lines", "aria-hidden": "true" });
  private readonly list = h("ul", { id: "problems", role: "status", "aria-live": "polite" });
  private timer = 0;

  constructor(changed: (text: string) => void) {
    this.area = h("textarea", { id: "model-text", wrap: "off", spellcheck: "false", autocomplete: "off", "aria-label": "model file; what is wrong is told below" });
    this.area.addEventListener("input", () => {
      this.resize();
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => changed(this.area.value), PAUSE);
    });
    this.element = h("div", { class: "editing" }, h("div", { class: "editor" }, this.gutter, h("div", { class: "sheet" }, this.area, this.marks)), this.list);
  }

  fill(text: string): void {
    if (this.area.value !== text) this.area.value = text;
    this.tell([]);
    this.resize();
  }

  private resize(): void {
    const lines = this.area.value.split("\n");
    this.area.style.height = `${lines.length * LINE + 4}px`;
    const longest = lines.reduce((longest, line) => Math.max(longest, line.length), 20);
    this.area.style.width = `${longest + 4}ch`;
    if (this.gutter.childElementCount !== lines.length) {
      this.gutter.replaceChildren(...lines.map((_, i) => h("div", {}, String(i + 1))));
    }
  }

  /** Shows what is wrong, at its lines and as a list from which a click leads there. */
  tell(problems: Problem[]): void {
    const lines = this.area.value.split("\n");
    const taken = new Set<number>();
    const marks: HTMLElement[] = [];
    for (const row of this.gutter.children) row.className = "";
    for (const problem of problems) {
      const row = problem.line - 1;
      if (row < 0 || taken.has(row)) continue;
      taken.add(row);
      const kind = problem.is_warning ? "looks-odd" : "wrong";
      const mark = h("div", { class: `mark ${kind}` }, problem.message);
      mark.style.top = `${row * LINE}px`;
      mark.style.left = `${(lines[row]?.length ?? 0) + 3}ch`;
      marks.push(mark);
      const number = this.gutter.children[row];
      if (number) number.className = kind;
    }
    this.marks.replaceChildren(...marks);
    this.list.replaceChildren(...problems.map((problem) => this.entry(problem)));
  }

  private entry(problem: Problem): HTMLElement {
    const place = problem.line > 0 ? `line ${problem.line}: ` : "";
    const go = h("button", { type: "button", class: problem.is_warning ? "looks-odd" : "wrong", title: problem.shown }, `${place}${problem.message}`);
    go.addEventListener("click", () => {
      this.area.focus();
      this.area.setSelectionRange(problem.from, Math.max(problem.to, problem.from));
    });
    return h("li", {}, go, problem.hint ? h("span", { class: "hint" }, ` ${problem.hint}`) : null);
  }
}
