/** Colours that readers with any kind of colour vision tell apart. */

/** For things: Okabe and Ito. */
export const THINGS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1"];

/** For values: viridis, whose lightness grows all along, so that it reads in grey too. */
const VALUES: [number, number, number][] = [
  [68, 1, 84],
  [71, 39, 119],
  [62, 73, 137],
  [48, 103, 141],
  [37, 130, 142],
  [30, 157, 136],
  [53, 183, 120],
  [109, 204, 88],
  [181, 221, 43],
  [253, 231, 36],
];

export type Rgb = [number, number, number];

/** The colour of a value between 0 and 1, components between 0 and 1. */
export function valueColour(value: number): Rgb {
  const place = Math.min(1, Math.max(0, Number.isFinite(value) ? value : 0)) * (VALUES.length - 1);
  const below = Math.min(VALUES.length - 2, Math.floor(place));
  const part = place - below;
  const [a, b] = [VALUES[below]!, VALUES[below + 1]!];
  return [0, 1, 2].map((i) => (a[i]! * (1 - part) + b[i]! * part) / 255) as Rgb;
}

export function hex(colour: string): Rgb {
  const number = Number.parseInt(colour.slice(1), 16);
  return [(number >> 16) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
}

export const css = ([r, g, b]: Rgb): string => `rgb(${[r, g, b].map((c) => Math.round(255 * c)).join(" ")})`;

/** What a picture is drawn in. */
export interface Theme {
  name: "light" | "dark";
  background: string;
  ink: string;
  faint: string;
  metal: string;
  ground: string;
  load: string;
  reaction: string;
  spring: string;
  cable: string;
  contact: string;
  soil: string;
  alarm: string;
  grid: string;
}

export const LIGHT: Theme = {
  name: "light",
  background: "#f7f8fa",
  ink: "#1d232b",
  faint: "#8d96a3",
  metal: "#6f7a88",
  ground: "#39424e",
  load: "#b2182b",
  reaction: "#1b7837",
  spring: "#7a5c1e",
  cable: "#7b3294",
  contact: "#9a6a00",
  soil: "#cbb384",
  alarm: "#b2182b",
  grid: "#dfe3e8",
};

export const DARK: Theme = {
  name: "dark",
  background: "#14181e",
  ink: "#e8ebef",
  faint: "#7d8794",
  metal: "#9aa5b3",
  ground: "#c3cad3",
  load: "#ff6b6b",
  reaction: "#5fd38a",
  spring: "#e0b861",
  cable: "#c79be8",
  contact: "#f2c14e",
  soil: "#7d6a45",
  alarm: "#ff6b6b",
  grid: "#2a313a",
};
