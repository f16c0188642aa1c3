/** The result in words and numbers, as a table to read, to copy and to save. */

import type { Point, Study } from "../data/study";
import { quantity, vector } from "../units";
import type { Value } from "../data/types";
import { h } from "./dom";

/** A row: what, how it reads, and the number itself where it is one. */
export interface Row {
  name: string;
  text: string;
  value?: number | number[] | string | undefined;
  unit?: string;
}

export interface Group {
  title: string;
  rows: Row[];
}

const plain = (word: unknown): string => String(word ?? "").replace(/_/g, " ");

export function groupsOf(study: Study, point: Point | undefined): Group[] {
  const { document } = study;
  const groups: Group[] = [{ title: "Status", rows: statusRows(study, point) }];
  const here = point ? point.values.map((value, i): Row => {
    const { name, unit } = study.columns[i]!;
    return { name, text: quantity(value, unit, 6), value, unit };
  }) : [];
  const isSingle = study.branches.length === 1 && study.branches[0]!.points.length === 1;
  const outputs = isSingle ? Object.entries(document.outputs ?? {}).map(([name, value]) => outputRow(study, name, value)) : here;
  if (outputs.length > 0) groups.push({ title: isSingle ? "Outputs" : "At this point", rows: outputs });
  const stress = stressRows(study, point);
  if (stress.length > 0) groups.push({ title: "Largest stress", rows: stress });
  const parameters = Object.entries(document.parameters ?? {}).map(([name, value]): Row => {
    const unit = study.scene.units.parameters[name] ?? "";
    return { name, text: quantity(value, unit, 6), value, unit };
  });
  if (parameters.length > 0) groups.push({ title: "Parameters", rows: parameters });
  if (study.modes.length > 0) {
    const unit = study.scene.units.parameters[String(document.parameter)] ?? "";
    const rows = study.modes.map((mode, i): Row => ({
      name: `mode ${i + 1}`,
      text: quantity(mode.value, unit, 6),
      value: mode.value,
      unit,
    }));
    groups.push({ title: document.parameter ? `Critical ${String(document.parameter)}` : "Critical load fractions", rows });
  }
  groups.push({ title: "Solver", rows: solverRows(study) });
  return groups;
}

function outputRow(study: Study, name: string, value: Value): Row {
  const unit = study.scene.units.outputs[name] ?? "";
  if (Array.isArray(value)) return { name, text: vector(value, unit, 6), value, unit };
  return { name, text: quantity(value, unit, 6), value: value ?? undefined, unit };
}

function statusRows(study: Study, point: Point | undefined): Row[] {
  const { document } = study;
  const rows: Row[] = [{ name: "status", text: plain(document.status), value: document.status }];
  const reason = document.reason;
  if (reason) rows.push({ name: "reason", text: reason, value: reason });
  if (typeof document.load_fraction === "number") {
    rows.push({ name: "load reached", text: `${(100 * document.load_fraction).toPrecision(4)} %`, value: document.load_fraction });
  }
  if (point?.note || point?.kind === "fold" || point?.kind === "branch") {
    const isSpecial = point.kind === "fold" || point.kind === "branch" || point.kind === "event";
    rows.push({ name: "this point", text: [isSpecial ? plain(point.kind) : "", point.note].filter(Boolean).join(": ") });
  }
  if (study.kind !== "sweep" && study.kind !== "inverse_dynamics") {
    const words = point?.stable === true ? "stable" : point?.stable === false ? "unstable" : "not decided";
    rows.push({ name: "stability", text: words, value: words });
    const why = document.stability_reason;
    if (point?.stable === null && typeof why === "string") rows.push({ name: "why", text: why });
  }
  study.branches.forEach((branch, i) => {
    for (const end of branch.ends ?? []) {
      if (end.isBrokenOff) rows.push({ name: `branch ${i + 1}`, text: `${plain(end.word)}${end.reason ? `: ${end.reason}` : ""}` });
    }
  });
  for (const warning of document.warnings ?? []) rows.push({ name: "warning", text: warning, value: warning });
  return rows;
}

/** Of every beam with a stress: the largest, where it is, and the safety against yield. */
function stressRows(study: Study, point: Point | undefined): Row[] {
  const rows: Row[] = [];
  for (const [name, line] of point?.state?.().lines ?? []) {
    const list = line.values.stress;
    if (!list || list.length === 0) continue;
    const largest = Math.max(...list);
    const s = line.s[list.indexOf(largest)] ?? 0;
    const yields = study.scene.beams[name]?.yield_strength;
    const safety = yields && largest > 0 ? `, safety ${(yields / largest).toPrecision(3)}` : "";
    rows.push({ name, text: `${quantity(largest, "Pa")} at s = ${quantity(s, "m")}${safety}`, value: largest, unit: "Pa" });
  }
  if (rows.length <= 12) return rows;
  const worst = rows.sort((a, b) => Number(b.value) - Number(a.value)).slice(0, 12);
  return [...worst, { name: "", text: `and ${rows.length - 12} beams with less` }];
}

function solverRows(study: Study): Row[] {
  const { document } = study;
  const rows: Row[] = [];
  for (const key of ["residual", "error_estimate", "energy"]) {
    const value = document[key];
    if (typeof value === "number") rows.push({ name: plain(key), text: quantity(value, key === "energy" ? "J" : "", 4), value });
  }
  const work = document.work;
  if (work && typeof work === "object") {
    for (const [key, value] of Object.entries(work)) {
      if (typeof value === "number") rows.push({ name: plain(key), text: String(value), value });
    }
  }
  rows.push({ name: "flexura", text: document.flexura, value: document.flexura });
  return rows;
}

export function render(groups: Group[]): HTMLElement {
  const table = h("table", { class: "results" });
  for (const group of groups) {
    table.append(h("tbody", {}, h("tr", {}, h("th", { colspan: 2, scope: "rowgroup" }, group.title)), ...group.rows.map(rowOf)));
  }
  return table;
}

function rowOf(row: Row): HTMLElement {
  const exact = typeof row.value === "number" ? `${row.value} ${row.unit ?? ""}`.trim() : undefined;
  const kind = row.name === "warning" ? "warning" : row.name === "status" ? `status ${row.text === "converged" ? "good" : "bad"}` : undefined;
  return h("tr", { class: kind }, h("td", {}, row.name), h("td", { title: exact }, row.text));
}

/** Tab-separated, for a spreadsheet. */
export const asText = (groups: Group[]): string =>
  groups
    .flatMap((group) => group.rows.map((row) => [group.title, row.name, exactly(row), row.unit ?? ""].join("\t")))
    .join("\n");

const exactly = (row: Row): string =>
  row.value === undefined ? row.text : Array.isArray(row.value) ? row.value.join(" ") : String(row.value);

/** A cell, in quotes where it holds what separates cells; one that a spreadsheet would take for a formula is told apart. */
function cell(text: string): string {
  const safe = /^[=+@\t\r]/.test(text) || /^-(?![\d.])/.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(safe) ? `"${safe.replace(/"/g, '""')}"` : safe;
}

const line = (cells: string[]): string => `${cells.map(cell).join(",")}\n`;
const headed = (name: string, unit: string): string => (unit ? `${name} [${unit}]` : name);

/** Every point of every branch, or the rows of a single result. */
export function csvOf(study: Study): string {
  const isSingle = study.branches.length === 1 && study.branches[0]!.points.length === 1;
  if (isSingle) {
    const groups = groupsOf(study, study.branches[0]!.points[0]);
    const rows = groups.flatMap((group) => group.rows.map((row) => [group.title, row.name, exactly(row), row.unit ?? ""]));
    return line(["group", "name", "value", "unit"]) + rows.map(line).join("");
  }
  let text = line(["branch", "point", "kind", ...study.columns.map(({ name, unit }) => headed(name, unit)), "stable", "note"]);
  study.branches.forEach((branch, b) => {
    branch.points.forEach((point, p) => {
      const numbers = point.values.map((value) => (Number.isFinite(value) ? String(value) : ""));
      text += line([String(b + 1), String(p + 1), point.kind, ...numbers, point.stable === null ? "" : String(point.stable), point.note]);
    });
  });
  return text;
}
