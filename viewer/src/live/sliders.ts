/** One slider for each parameter, with its value to be typed. */

import { h } from "../panel/dom";
import { quantity } from "../units";
import type { Parameter } from "./solver";

const STEPS = 1000;

interface Row {
  parameter: Parameter;
  slider: HTMLInputElement;
  field: HTMLInputElement;
}

export class Sliders {
  readonly element = h("div", { class: "sliders", id: "sliders" });
  private rows: Row[] = [];

  constructor(
    private readonly moved: (name: string, value: number) => void,
    private readonly typed: (name: string, text: string) => void,
  ) {}

  fill(parameters: Parameter[], isFound: (parameter: Parameter) => boolean): void {
    this.rows = parameters.map((parameter) => this.row(parameter, isFound(parameter)));
    this.element.replaceChildren(
      ...this.rows.map(({ parameter, slider, field }) =>
        h("div", { class: "parameter" }, h("label", { for: slider.id }, parameter.name), field, slider),
      ),
    );
    if (parameters.length === 0) this.element.replaceChildren(h("p", { class: "faint" }, "the file has no parameters to move"));
  }

  private row(parameter: Parameter, isFound: boolean): Row {
    const [low, high] = parameter.range;
    const slider = h("input", { type: "range", id: `parameter-${parameter.name}`, min: 0, max: STEPS, step: "any", disabled: isFound });
    const field = h("input", { type: "text", class: "value", "aria-label": `value of ${parameter.name}, with its unit`, disabled: isFound, id: `value-${parameter.name}` });
    slider.addEventListener("input", () => {
      const along = low + ((high - low) * Number(slider.value)) / STEPS;
      const value = parameter.is_structural ? Math.round(along) : along;
      this.show({ parameter, slider, field }, value, true);
      this.moved(parameter.name, value);
    });
    field.addEventListener("change", () => this.typed(parameter.name, field.value.replace(/−/g, "-")));
    const row = { parameter, slider, field };
    this.show(row, parameter.value, false);
    return row;
  }

  private show({ parameter, slider, field }: Row, value: number, isSliding: boolean): void {
    const [low, high] = parameter.range;
    if (!isSliding) slider.value = String(high > low ? (STEPS * (value - low)) / (high - low) : 0);
    const text = quantity(value, parameter.unit, 5);
    slider.setAttribute("aria-valuetext", text);
    if (document.activeElement !== field) field.value = text;
  }

  /** The values as they are; a slider that is being moved is left alone. */
  update(values: [string, number][], isMoving: boolean): void {
    const known = new Map(values);
    for (const row of this.rows) {
      const value = known.get(row.parameter.name);
      if (value === undefined || (isMoving && document.activeElement === row.slider)) continue;
      this.show(row, value, false);
    }
  }

  range(name: string): [number, number] | undefined {
    return this.rows.find(({ parameter }) => parameter.name === name)?.parameter.range;
  }
}
