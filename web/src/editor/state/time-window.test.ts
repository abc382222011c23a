import { describe, expect, it } from "vitest";
import { TimeWindow } from "./time-window.svelte";

function opened(): TimeWindow {
  const window = new TimeWindow();
  window.width = 1000;
  window.duration = 100;
  window.showAll();
  return window;
}

describe("the span of time on screen", () => {
  it("shows all with a little air", () => {
    const window = opened();
    expect(window.from).toBeLessThan(0);
    expect(window.to).toBeGreaterThan(100);
    expect(window.xOf(0)).toBeCloseTo(12, 6);
  });

  it("zooms about the pointer", () => {
    const window = opened();
    const held = window.timeAt(400);
    window.zoom(3, 400);
    expect(window.timeAt(400)).toBeCloseTo(held, 9);
  });

  it("comes to bounds in zoom and place", () => {
    const window = opened();
    window.zoom(1e9);
    expect(window.scale).toBe(4000);
    window.pan(1e9);
    expect(window.from).toBeLessThan(100);
    window.pan(-1e9);
    expect(window.xOf(0)).toBeCloseTo(12, 6);
  });
});
