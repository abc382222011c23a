import { describe, expect, it } from "vitest";
import type { WireNote } from "../generated/protocol";
import { barNumberStep, phrasesOf, pitchRange } from "./overview";

function note(onset: number, duration: number, pitch = 70): WireNote {
  return {
    index: 0,
    part: 0,
    onset_s: onset / 2,
    duration_s: duration / 2,
    onset_beats: onset,
    duration_beats: duration,
    sounding_pitch: pitch,
    written_pitch: pitch + 2,
    sounding_name: "B♭4",
    written_name: "C5",
    velocity: 0.8,
    valves: [],
    usual_valves: [],
    reason: "",
    fingering: { type: "valves", valves: [] },
    player: 0,
    in_played_part: true,
  };
}

describe("phrasesOf", () => {
  it("groups notes up to a rest of a beat, overlapping ones too", () => {
    const notes = [note(0, 1), note(1, 3), note(2, 0.5), note(4.5, 0.5), note(6, 1)];
    expect(phrasesOf(notes)).toEqual([
      { start: 0, end: 2.5 },
      { start: 3, end: 3.5 },
    ]);
  });

  it("ends a phrase that would never end", () => {
    const notes = Array.from({ length: 100 }, (_, i) => note(i, 1));
    expect(phrasesOf(notes)).toHaveLength(2);
  });

  it("has none without notes", () => {
    expect(phrasesOf([])).toEqual([]);
  });
});

describe("the overview's scales", () => {
  it("spans at least an octave", () => {
    expect(pitchRange([note(0, 1, 70), note(1, 1, 70)])).toEqual([64, 76]);
    expect(pitchRange([note(0, 1, 50), note(1, 1, 90)])).toEqual([50, 90]);
    expect(pitchRange([])).toEqual([54, 78]);
  });

  it("numbers as many bars as there is room for", () => {
    expect(barNumberStep(32, 1200, 40)).toBe(2);
    expect(barNumberStep(32, 300, 40)).toBe(8);
    expect(barNumberStep(10, 1200, 40)).toBe(1);
  });
});
