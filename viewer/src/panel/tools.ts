/** Buttons, choices and sliders around the window. */

import type { App } from "../app";
import { DARK, LIGHT } from "../colours";
import type { View } from "../view/viewport";
import { digits } from "../units";
import { button, choice, fileName, h, save, tick } from "./dom";

const VIEWS: [string, View, string][] = [
  ["fit", "own", "fit into view (F)"],
  ["xz", "front", "view along y (Y); again: from the other side"],
  ["xy", "top", "view along z (Z); again: from the other side"],
  ["yz", "right", "view along x (X); again: from the other side"],
  ["3-D", "space", "view from above the front (I)"],
];

export class Tools {
  readonly header: HTMLElement;
  readonly bar: HTMLElement;
  readonly path: HTMLElement;
  private readonly status = h("span", { class: "chip", role: "status" });
  private readonly colours = h("span", {});
  private readonly scale: HTMLInputElement;
  private readonly proposed: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly playing: HTMLButtonElement;
  private readonly mode = h("span", {});

  constructor(private readonly app: App) {
    const studies =
      app.studies.length > 1
        ? choice("study", app.studies.map(([name]) => name), 0, (i) => app.open(i), "study")
        : null;
    const dark = button("◐", "dark or light", () => app.paint(app.theme.name === "light" ? DARK : LIGHT), { id: "theme" });
    const whole = button("full screen", "full screen", () => this.fullScreen(), { id: "full-screen" });
    const picture = button("PNG", "save the picture as PNG", () => this.savePicture(), { id: "save-picture" });
    this.header = h("div", { class: "tools" }, studies, this.status, picture, dark, whole);

    this.scale = h("input", { type: "number", id: "magnification", min: 0, step: "any", value: 1, "aria-label": "magnification of displacements" });
    this.scale.addEventListener("change", () => {
      const factor = Number(this.scale.value);
      app.setMagnification(Number.isFinite(factor) && factor > 0 ? factor : 1);
    });
    this.proposed = button("", "show displacements as large as can be seen", () => app.setMagnification(app.proposal), { id: "propose", class: "proposal" });
    const camera = choice("camera", ["perspective", "parallel"], 0, (i) => app.viewport.setPerspective(i === 0), "camera");
    const option = (name: Parameters<App["set"]>[0], text: string): HTMLElement =>
      tick(text, app.options[name], (isOn) => app.set(name, isOn), `show-${name}`);
    this.bar = h(
      "div",
      { class: "bar", role: "toolbar", "aria-label": "view" },
      h("span", { class: "group" }, ...VIEWS.map(([text, view, label]) => button(text, label, () => app.lookAgain(view), { id: `view-${text}` })), camera),
      this.colours,
      h("label", { class: "choice", for: "magnification" }, h("span", {}, "displacements ×"), this.scale),
      this.proposed,
      h(
        "details",
        { class: "more" },
        h("summary", {}, "show"),
        h(
          "div",
          { class: "ticks" },
          option("ghost", "undeformed"),
          option("loads", "loads"),
          option("reactions", "reactions"),
          option("names", "names"),
          option("surfaces", "contact surfaces"),
          option("frames", "section frames"),
        ),
      ),
    );
    this.slider = h("input", { type: "range", id: "slider", min: 0, max: 0, step: 1, value: 0, "aria-label": "point of the path" });
    this.slider.addEventListener("input", () => this.slide());
    this.playing = button("▶", "play (space)", () => app.play(), { id: "play" });
    this.path = h("div", { class: "path" }, this.playing, this.mode, this.slider);
  }

  /** The choices that depend on the study. */
  fill(quantities: { key: string; name: string }[]): void {
    const { app } = this;
    const keys = ["", ...quantities.map(({ key }) => key)];
    const names = ["one for each beam", ...quantities.map(({ name }) => name)];
    const chosen = Math.max(0, keys.indexOf(app.options.quantity));
    const has = quantities.length > 0;
    this.colours.replaceChildren(...(has ? [choice("colour", names, chosen, (i) => app.setQuantity(keys[i]!), "quantity")] : []));
    const { modes } = app.study;
    const list = modes.map((_, i) => `mode ${i + 1}`);
    this.mode.replaceChildren(...(list.length > 0 ? [choice("mode", list, 0, (i) => app.setMode(i), "mode")] : []));
    this.path.hidden = modes.length === 0 && app.study.branches.every((_, i) => app.shown(i).length < 2);
  }

  private slide(): void {
    const { app } = this;
    const value = Number(this.slider.value);
    if (app.study.modes.length > 0) app.setPhase(value / 100);
    else {
      const point = app.shown(app.spot.branch)[value];
      if (point !== undefined) app.go({ branch: app.spot.branch, point });
    }
  }

  /** What depends on where the path stands. */
  update(): void {
    const { app } = this;
    if (!app.study) return;
    const isGood = app.study.isConverged;
    this.status.textContent = app.study.document.status.replace(/_/g, " ");
    this.status.className = `chip ${isGood ? "good" : "bad"}`;
    this.scale.value = String(app.magnification);
    this.proposed.hidden = app.proposal === 1 || app.magnification === app.proposal;
    this.proposed.textContent = `× ${digits(app.proposal)} would show them`;
    this.playing.textContent = app.isPlaying ? "⏸" : "▶";
    if (app.study.modes.length > 0) {
      [this.slider.min, this.slider.max] = ["-100", "100"];
      this.slider.value = String(100 * app.phase);
      return;
    }
    const shown = app.shown(app.spot.branch);
    [this.slider.min, this.slider.max] = ["0", String(Math.max(0, shown.length - 1))];
    this.slider.value = String(Math.max(0, shown.indexOf(app.spot.point)));
    this.slider.setAttribute("aria-valuetext", `point ${app.spot.point + 1} of ${app.study.branches[app.spot.branch]?.points.length ?? 0}`);
  }

  private fullScreen(): void {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void document.documentElement.requestFullscreen?.().catch(() => undefined);
  }

  private savePicture(): void {
    save(fileName(this.app.study.document.model, "png"), this.app.viewport.picture());
  }
}
