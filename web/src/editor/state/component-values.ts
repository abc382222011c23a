import type { ShowParameter } from "../../generated/protocol";

/** Types of parameters that have a curve. */
const CURVED = ["number", "vector", "color"];

export function hasCurve(parameter: ShowParameter | null): parameter is ShowParameter {
  return parameter !== null && CURVED.includes(parameter.type);
}

/** What a value's components are called. */
export function componentNames(parameter: ShowParameter): readonly string[] {
  if (parameter.type === "color") return ["R", "G", "B"];
  return parameter.type === "vector" ? ["x", "y", "z"] : [""];
}

/** A keyframe's value as the floats of a frame: colours linear, as the server's curves are. */
export function componentsOf(parameter: ShowParameter, value: unknown): readonly number[] {
  if (parameter.type === "color" && typeof value === "string") {
    return [1, 3, 5].map((place) => linear(parseInt(value.slice(place, place + 2), 16) / 255));
  }
  return Array.isArray(value) ? value.map(Number) : [Number(value)];
}

/** A value as a show writes it, with some of its components moved; held within the parameter's range. */
export function withComponent(parameter: ShowParameter, value: unknown, component: number, by: number): unknown {
  const [low, high] =
    parameter.type === "color" ? [0, 1] : [parameter.minimum ?? -Infinity, parameter.maximum ?? Infinity];
  const moved = componentsOf(parameter, value).map((each, index) =>
    index === component ? Number(Math.min(Math.max(each + by, low), high).toFixed(6)) : Number(each.toFixed(6)),
  );
  return parameter.type === "number" ? moved[0] : moved;
}

/** The sRGB transfer function backwards, IEC 61966-2-1. */
function linear(encoded: number): number {
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}
