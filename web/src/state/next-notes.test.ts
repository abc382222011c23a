import { describe, expect, it } from "vitest";
import { placeIn } from "./next-notes";

/** Two notes that touch, a rest, and a third. */
const NOTES = [
  { onset_s: 0.5, duration_s: 0.5 },
  { onset_s: 1, duration_s: 0.25 },
  { onset_s: 2, duration_s: 1 },
];

describe("placeIn", () => {
  it.each([
    [0, 0, false],
    [0.5, 0, true],
    [0.999, 0, true],
    [1, 1, true],
    [1.25, 2, false],
    [1.9, 2, false],
    [2.5, 2, true],
    [3, 3, false],
  ])("at %f s the note is number %i, sounding: %s", (songTime, first, sounds) => {
    expect(placeIn(NOTES, songTime)).toEqual({ first, sounds });
  });

  it("takes a frame's time for the note's, whatever floating point leaves between them", () => {
    expect(placeIn([{ onset_s: 0.1 + 0.2, duration_s: 1 }], 0.3)).toEqual({ first: 0, sounds: true });
    expect(placeIn([{ onset_s: 0.1, duration_s: 0.2 }], 0.3)).toEqual({ first: 1, sounds: false });
  });

  it.each([
    [0, 0, true],
    [0.2, 0, true],
    [0.45, 2, false],
    [0.5, 2, true],
    [1, 3, true],
    [1.8, 5, false],
    [3, 5, false],
  ])("at %f s of a drummer's part is stroke number %i, sounding: %s", (songTime, first, sounds) => {
    const strokes = [
      { onset_s: 0, duration_s: 0.1 },
      { onset_s: 0, duration_s: 0.4 },
      { onset_s: 0.5, duration_s: 4 },
      { onset_s: 1, duration_s: 0.1 },
      { onset_s: 1, duration_s: 0.1 },
    ];
    expect(placeIn(strokes, songTime)).toEqual({ first, sounds });
  });

  it("is nowhere among no notes", () => {
    expect(placeIn([], 4)).toEqual({ first: 0, sounds: false });
  });

  it("agrees with a search one by one", () => {
    const notes = Array.from({ length: 40 }, (_, number) => ({
      onset_s: number * 0.7,
      duration_s: 0.1 + (number % 5) * 0.12,
    }));
    for (let time = 0.005; time < 30; time += 0.13) {
      const first = notes.findIndex(({ onset_s, duration_s }) => onset_s + duration_s > time);
      expect(placeIn(notes, time).first).toBe(first === -1 ? notes.length : first);
    }
  });
});
