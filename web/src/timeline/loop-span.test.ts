import { describe, expect, it } from "vitest";
import { LoopDrag } from "./loop-drag";
import { LoopGrid } from "./loop-span";

/** Bars of 2 s; the piece ends within the sixth. */
const grid = new LoopGrid([0, 2, 4, 6, 8, 10], 11);
const loop = { start: 2, end: 6 };

describe("loops by bars", () => {
  it("are drawn to bar lines in either direction, and are never shorter than the bar where they began", () => {
    expect(new LoopDrag(grid, "new", 2.3, null).at(5.4, false)).toEqual({ start: 2, end: 6 });
    expect(new LoopDrag(grid, "new", 5.4, null).at(2.3, false)).toEqual({ start: 2, end: 6 });
    expect(new LoopDrag(grid, "new", 5.1, null).at(5.2, false)).toEqual({ start: 4, end: 6 });
    expect(new LoopDrag(grid, "new", 9.6, null).at(40, false)).toEqual({ start: 10, end: 11 });
    expect(new LoopDrag(grid, "new", 2.3, null).at(5.4, true)).toEqual({ start: 2.3, end: 5.4 });
  });

  it("are resized at one end, past the other too, which stays", () => {
    const free = { start: 2.5, end: 6 };
    expect(new LoopDrag(grid, "end", 6, free).at(9.1, false)).toEqual({ start: 2.5, end: 10 });
    expect(new LoopDrag(grid, "start", 2.5, free).at(8.7, false)).toEqual({ start: 6, end: 8 });
    expect(new LoopDrag(grid, "end", 6, loop).at(2.1, false)).toEqual({ start: 2, end: 4 });
    expect(new LoopDrag(grid, "start", 2, loop).at(4.4, true)).toEqual({ start: 4.4, end: 6 });
  });

  it("are moved as a whole, and keep their bars within the piece", () => {
    expect(new LoopDrag(grid, "whole", 3, loop).at(5.2, false)).toEqual({ start: 4, end: 8 });
    expect(new LoopDrag(grid, "whole", 3, loop).at(90, false)).toEqual({ start: 8, end: 11 });
    expect(new LoopDrag(grid, "whole", 3, loop).at(-9, true)).toEqual({ start: 0, end: 4 });
  });

  it("step from bar line to bar line, and never to nothing", () => {
    expect(grid.stepped(loop, "end", 1)).toEqual({ start: 2, end: 8 });
    expect(grid.stepped({ start: 2, end: 4 }, "end", -1)).toEqual({ start: 2, end: 4 });
    expect(grid.stepped({ start: 2.5, end: 4 }, "start", -1)).toEqual({ start: 2, end: 4 });
    expect(grid.nudged(loop, "whole", 0.1)).toEqual({ start: 2.1, end: 6.1 });
  });

  it("begin or end at a place and keep their other end where it can stay", () => {
    expect(grid.from(3.9, loop)).toEqual({ start: 4, end: 6 });
    expect(grid.from(7.9, loop)).toEqual({ start: 8, end: 11 });
    expect(grid.to(1.8, loop)).toEqual({ start: 0, end: 2 });
    expect(grid.to(8.1, loop)).toEqual({ start: 2, end: 8 });
  });
});
