import { describe, expect, it } from "vitest";

import { angle, decimal, floats, millimetres, radians, small, spoken } from "./figures";

describe("figures", () => {
  it("writes numbers with a true minus and no negative zero", () => {
    expect(decimal(-1.25, 1)).toBe("−1.3");
    expect(decimal(-0.001, 1)).toBe("0.0");
    expect(angle(radians(-115))).toBe("−115.0°");
  });

  it("writes lengths in millimetres, down to rounding", () => {
    expect(millimetres(0.0123)).toBe("12.3 mm");
    expect(millimetres(0.00012)).toBe("0.12 mm");
    expect(millimetres(2e-6)).toBe("< 0.01 mm");
    expect(millimetres(3e-17)).toBe("0 mm");
  });

  it("writes small errors as powers", () => {
    expect(small(0.1234)).toBe("0.123");
    expect(small(2.2e-16)).toBe("2e−16");
    expect(small(0)).toBe("0");
  });

  it("speaks joint names", () => {
    expect(spoken("rightIndexProximal")).toBe("right index proximal");
    expect(spoken("damped_least_squares")).toBe("damped least squares");
  });

  it("reads little-endian floats", () => {
    const bytes = new Uint8Array(new Float32Array([1, -2.5, 0]).buffer);
    expect([...floats(btoa(String.fromCharCode(...bytes)))]).toEqual([1, -2.5, 0]);
  });
});
