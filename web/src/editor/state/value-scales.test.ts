import { describe, expect, it } from "vitest";
import type { ShowParameter } from "../../generated/protocol";
import { scaleName, valueSpans } from "./value-scales";

const of = (unit: string, minimum: number | null = null, maximum: number | null = null) =>
  ({ path: "a", type: "number", unit, minimum, maximum }) as ShowParameter;
const metres = of("m");
const angle = of("rad");
const share = of("", 0, 1);
const strength = of("", 0, 12);
const color = { path: "c", type: "color", unit: "" } as ShowParameter;

describe("the scales of curves", () => {
  it("are one a unit, degrees for angles, and numbers without one by their bounds", () => {
    expect([metres, angle, share, strength, color].map(scaleName)).toEqual(["m", "°", "0–1", "0–12", "0–1"]);
  });

  const curves = [
    { parameter: metres, values: [-2, 2] as const },
    { parameter: metres, values: [0, 4] as const },
    { parameter: angle, values: [0.3, 0.6] as const },
    { parameter: share, values: null },
  ];

  it("are filled by each unit alone where they are normalised", () => {
    const [first, second, turned, nothing] = valueSpans(curves, true);
    expect(first?.[0]).toBeCloseTo(-2.72, 9);
    expect(first?.[1]).toBe(4.72);
    expect(second).toEqual(first);
    expect(turned?.[0]).toBeCloseTo(0.3 - 0.036, 4);
    expect(turned?.[1]).toBeCloseTo(0.6 + 0.036, 4);
    expect(nothing).toEqual([0, 1]);
  });

  it("are one and the same for all numbers as they are shown where they are not", () => {
    const [first, , turned] = valueSpans(curves, false);
    const degrees = (0.6 * 180) / Math.PI;
    expect(first?.[0]).toBeCloseTo(-2 - 0.12 * (degrees + 2), 2);
    expect(first?.[1]).toBeCloseTo(degrees + 0.12 * (degrees + 2), 2);
    expect(((turned?.[1] ?? 0) * 180) / Math.PI).toBeCloseTo(first?.[1] ?? 0, 6);
  });

  it("have room about a value that never changes", () => {
    expect(valueSpans([{ parameter: share, values: [2, 2] }], true)).toEqual([[1.5, 2.5]]);
  });
});
