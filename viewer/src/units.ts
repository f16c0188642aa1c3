/** Numbers as people read them: SI prefixes, a few digits, degrees beside radians. */

const PREFIXES: [number, string][] = [
  [1e12, "T"],
  [1e9, "G"],
  [1e6, "M"],
  [1e3, "k"],
  [1, ""],
  [1e-3, "m"],
  [1e-6, "µ"],
  [1e-9, "n"],
  [1e-12, "p"],
];
/** Units that a prefix goes in front of; others are written as they are. */
const PREFIXED = /^(m|N|Pa|J|W|Hz|s|N·m|N\*m|N m|N\/m|g|V|A)$/;

export const MINUS = "−";

/** A number with so many digits, without an exponent where it can be read without. */
export function digits(value: number, count = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text =
    size >= 1e6 || size < 1e-4 ? value.toExponential(count - 1) : String(Number(value.toPrecision(count)));
  return text.replace("e+", "e").replace(/-/g, MINUS);
}

/** A way to write values of one kind, up to a size. */
export interface Scale {
  factor: number;
  unit: string;
}

export function scaleOf(unit: string, largest: number): Scale {
  const size = Math.abs(largest);
  const own = unit.replace(/\*/g, "·");
  if (own === "kg" && size < 1) return { factor: 1e3, unit: "g" };
  if (own === "rad") return { factor: 180 / Math.PI, unit: "°" };
  if (own === "" || !PREFIXED.test(own) || !(size > 0) || !Number.isFinite(size)) return { factor: 1, unit: own };
  if (own === "g" || own === "m") {
    // Metres have no kilo here: drawings are in metres, millimetres or micrometres.
    const found = PREFIXES.find(([factor]) => factor <= 1 && size >= 0.9995 * factor) ?? [1e-9, "n"];
    return { factor: 1 / found[0], unit: found[1] + own };
  }
  const found = PREFIXES.find(([factor]) => size >= 0.9995 * factor) ?? [1e-12, "p"];
  return { factor: 1 / found[0], unit: found[1] + own };
}

/** A value with its unit. */
export function quantity(value: number | null | undefined, unit: string, count = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const scale = scaleOf(unit, value);
  const number = digits(value * scale.factor, count);
  return scale.unit === "" ? number : scale.unit === "°" ? number + "°" : `${number} ${scale.unit}`;
}

/** Components of a vector in one common unit. */
export function vector(values: readonly number[], unit: string, count = 4): string {
  const largest = Math.max(...values.map(Math.abs));
  const scale = scaleOf(unit, largest);
  const negligible = (v: number): number => (Math.abs(v) < 1e-9 * largest ? 0 : v);
  const list = values.map((value) => digits(negligible(value) * scale.factor, count)).join(", ");
  return `(${list})${scale.unit === "" || scale.unit === "°" ? scale.unit : " " + scale.unit}`;
}
