import type { ShowParameter } from "../../generated/protocol";
import { shownNumber, shownUnit, typedNumber } from "./parameter-value";

/** Lowest and highest value, in a parameter's own unit. */
export type ValueSpan = readonly [low: number, high: number];

/** The values of a curve that has been read, and of its keyframes, to be brought on screen. */
export interface Spanned {
  readonly parameter: ShowParameter;
  /** Null where nothing is known of its values yet. */
  readonly values: ValueSpan | null;
}

const AIR = 0.12;
const NOTHING: ValueSpan = [0, 1];

/** What shares a scale: a unit, or, of numbers without one, what has the same bounds. */
export function scaleName({ type, unit, minimum, maximum }: ShowParameter): string {
  if (type === "color") return "0–1";
  if (unit !== "") return shownUnit(unit);
  return minimum === null || maximum === null ? "" : `${minimum}–${maximum}`;
}

/**
 * The span of values that the room of each curve shows.
 *
 * @param normalised whether each unit fills the room by itself; otherwise all numbers, as they are shown, share one scale.
 * @returns in the order of the curves.
 */
export function valueSpans(curves: readonly Spanned[], normalised: boolean): ValueSpan[] {
  const shared = new Map<string, [number, number]>();
  const nameOf = (parameter: ShowParameter) => (normalised ? scaleName(parameter) : "");
  for (const { parameter, values } of curves) {
    if (values === null) continue;
    const [low, high] = values.map((value) => shownNumber(value, parameter.unit)) as [number, number];
    const [lowest, highest] = shared.get(nameOf(parameter)) ?? [Infinity, -Infinity];
    shared.set(nameOf(parameter), [Math.min(low, lowest), Math.max(high, highest)]);
  }
  return curves.map(({ parameter }) => {
    const span = shared.get(nameOf(parameter));
    if (span === undefined) return NOTHING;
    const [low, high] = withAir(span);
    return [typedNumber(low, parameter.unit), typedNumber(high, parameter.unit)];
  });
}

function withAir([low, high]: ValueSpan): ValueSpan {
  const air = high - low > 1e-9 ? (high - low) * AIR : Math.max(Math.abs(high) * 0.25, 0.25);
  return [low - air, high + air];
}
