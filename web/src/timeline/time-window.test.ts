import { describe, expect, it } from "vitest";
import { TimeWindow } from "./time-window.svelte";

function opened(): TimeWindow {
  const window = new TimeWindow();
  window.resize(1000, 100);
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

describe("a window that shows nothing but the piece", () => {
  function tight(): TimeWindow {
    const window = new TimeWindow({ tight: true });
    window.resize(600, 1200);
    return window;
  }

  it("is at first all of it, and all of it again when its place grows", () => {
    const window = tight();
    expect([window.from, window.to]).toEqual([0, 1200]);
    window.resize(900, 1200);
    expect([window.from, window.to]).toEqual([0, 1200]);
    window.zoom(0.1);
    expect([window.from, window.to]).toEqual([0, 1200]);
  });

  it("comes from twenty minutes down to a bar, and stays within the piece", () => {
    const window = tight();
    window.show(600, 602);
    expect([window.from, window.to]).toEqual([600, 602]);
    window.pan(1e9);
    expect(window.to).toBeCloseTo(1200, 6);
    window.resize(300, 1200);
    expect([window.from, window.to]).toEqual([1198, 1199]);
    expect(window.showsAll).toBe(false);
  });

  it("follows a playhead that leaves it, and not one that was left", () => {
    const window = tight();
    window.show(0, 10);
    window.follow(9.99, true, null);
    window.follow(10.01, true, null);
    expect(window.from).toBeCloseTo(9.01, 6);
    window.pan(6000);
    const away = window.from;
    window.follow(10.1, true, null);
    window.follow(5, true, { start: 5, end: 11 });
    expect(window.from).toBe(away);
    window.follow(30, false, null);
    expect(window.from).toBeCloseTo(29, 6);
    window.pan(6000);
    window.follow(30, true, null);
    expect(window.from).toBeCloseTo(29, 6);
  });
});
