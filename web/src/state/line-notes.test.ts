import { describe, expect, it } from "vitest";
import type { WireNote } from "../generated/protocol";
import { blockNotes, lineNotes } from "./line-notes";

const note = (index: number, onset_s: number, duration_s: number, valves: number[] | null): WireNote =>
  ({ index, onset_s, duration_s, valves }) as unknown as WireNote;
const PART = [note(0, 0, 2, null), note(1, 0, 0.5, [1]), note(2, 1, 2, []), note(3, 2, 1, [2])];

describe("lineNotes", () => {
  it("are those that are played, one at a time", () => {
    expect(lineNotes(PART).map(({ index, duration_s }) => [index, duration_s])).toEqual([
      [1, 0.5],
      [2, 1],
      [3, 1],
    ]);
  });

  it("stand among the blocks beside what is not played", () => {
    expect(
      blockNotes(PART)
        .map(({ index }) => index)
        .sort(),
    ).toEqual([0, 1, 2, 3]);
  });
});
