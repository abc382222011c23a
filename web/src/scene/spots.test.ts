import { describe, expect, it } from "vitest";

import { Spot } from "./spots";

function reach(spot: Spot): number {
  return (spot.cone.material.uniforms["reach"]?.value as number | undefined) ?? 0;
}

describe("Spot", () => {
  it("shows its cone only when it is lit and there is haze", () => {
    const spot = new Spot();
    spot.light.position.set(0, 4, 0);
    spot.light.target.position.set(0, 1, 0);
    spot.arrange(1, 0);
    expect(spot.cone.visible).toBe(false);
    spot.light.intensity = 5;
    spot.arrange(0, 0);
    expect(spot.cone.visible).toBe(false);
    spot.arrange(1, 0);
    expect(spot.cone.visible).toBe(true);
  });

  it("ends its cone on the floor, and somewhere where it shines upward", () => {
    const spot = new Spot();
    spot.light.intensity = 5;
    spot.light.position.set(0, 4, 3);
    spot.light.target.position.set(0, 0, 0);
    spot.arrange(1, 0);
    expect(reach(spot)).toBeCloseTo(5, 6);
    spot.light.target.position.set(0, 6, 0);
    spot.arrange(1, 0);
    expect(reach(spot)).toBe(9);
  });
});
