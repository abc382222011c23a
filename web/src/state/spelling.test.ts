import { describe, expect, it } from "vitest";
import { pitchName, spellingOf } from "./spelling";

describe("spelling", () => {
  it("follows the scale that the music is in", () => {
    const scale = (tonic: number) => [0, 2, 4, 5, 7, 9, 11, 12].map((step) => tonic + step);
    expect(spellingOf(scale(60))).toBe("mixed");
    expect(spellingOf(scale(64))).toBe("sharps");
    expect(spellingOf(scale(63))).toBe("flats");
    expect(spellingOf([])).toBe("mixed");
  });

  it("names pitches", () => {
    expect([60, 70, 54].map((pitch) => pitchName(pitch))).toEqual(["C4", "B♭4", "F♯3"]);
    expect(pitchName(68, "sharps")).toBe("G♯4");
    expect(pitchName(66, "flats")).toBe("G♭4");
  });
});
