import { describe, expect, it } from "vitest";
import { heldAt, stepFrom } from "./note-steps";

const line = [0.5, 1, 1.51, 2].map((onset_s) => ({ onset_s }));

describe("heldAt", () => {
  it("is the first frame at the onset or later, at its own time", () => {
    expect(heldAt({ onset_s: 0.5 }, 60)).toBe(0.5);
    expect(heldAt({ onset_s: 1.51 }, 60)).toBeCloseTo(91 / 60, 12);
    // What floating point makes of a third of a second is still on the grid.
    expect(heldAt({ onset_s: 0.1 + 0.2 }, 60)).toBe(0.3);
  });
});

describe("stepFrom", () => {
  it("goes from note to note and back again", () => {
    let songTime = 0;
    const seen: number[] = [];
    for (const direction of [1, 1, 1, 1, 1, -1, -1] as const) {
      const note = stepFrom(line, songTime, direction, 60);
      if (note !== null) songTime = heldAt(note, 60);
      seen.push(note?.onset_s ?? NaN);
    }
    expect(seen).toEqual([0.5, 1, 1.51, 2, NaN, 1.51, 1]);
  });

  it("goes back to the note that it is in first", () => {
    expect(stepFrom(line, 1.3, -1, 60)?.onset_s).toBe(1);
    expect(stepFrom(line, 0.4, -1, 60)).toBeNull();
  });
});
