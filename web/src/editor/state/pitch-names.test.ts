import { describe, expect, it } from "vitest";
import { pitchName, PitchError, rangeName, readRange, type PitchReading } from "./pitch-names";

const C_MAJOR: PitchReading = { above: 0, fifths: 0, minor: false };
/** E♭ major, which a B♭ trumpet reads in F major. */
const TRUMPET: PitchReading = { above: 2, fifths: -3, minor: false };
const OCTAVE = Array.from({ length: 12 }, (_, index) => 60 + index);

/** As `reina.notation.spelling` calls a note that stands alone. */
const SPELLED: readonly (readonly [fifths: number, minor: boolean, names: string])[] = [
  [0, false, "C4 C♯4 D4 E♭4 E4 F4 F♯4 G4 A♭4 A4 B♭4 B4"],
  [-3, false, "C4 D♭4 D4 E♭4 E4 F4 G♭4 G4 A♭4 A4 B♭4 C♭5"],
  [-6, false, "C4 D♭4 D4 E♭4 F♭4 F4 G♭4 G4 A♭4 A4 B♭4 C♭5"],
  [6, false, "B♯3 C♯4 D4 D♯4 E4 E♯4 F♯4 G4 G♯4 A4 A♯4 B4"],
  [0, true, "C4 C♯4 D4 E♭4 E4 F4 F♯4 G4 G♯4 A4 B♭4 B4"],
  [3, true, "C4 C♯4 D4 D♯4 E4 E♯4 F♯4 G4 G♯4 A4 A♯4 B4"],
];

describe("a pitch's name", () => {
  it.each(SPELLED)("follows the key signature of %i, minor: %s", (fifths, minor, names) => {
    expect(OCTAVE.map((pitch) => pitchName(pitch, { above: 0, fifths, minor })).join(" ")).toBe(names);
  });

  it("is the written one in the written key where that is read", () => {
    expect(pitchName(70, TRUMPET)).toBe("C5");
    expect(pitchName(68, TRUMPET)).toBe("B♭4");
  });
});

describe("a range of pitches", () => {
  it("is read as names and numbers, alone, with two ends or open at one", () => {
    const read = (text: string) => readRange(text, C_MAJOR);
    expect(read("B♭4")).toEqual([70, 70]);
    expect(read("bb4")).toEqual([70, 70]);
    expect(read("70")).toEqual([70, 70]);
    for (const text of ["C5..G5", "c5 .. g5", "C5-G5", "C5 – G5", "C5 to G5", "72..79", "C5…79"])
      expect(read(text)).toEqual([72, 79]);
    expect(read("C-1..C#0")).toEqual([0, 13]);
    expect(read("F♯5..")).toEqual([78, 127]);
    expect(read("..F5")).toEqual([0, 77]);
    expect(read(" ")).toBeNull();
    expect(readRange("C5", TRUMPET)).toEqual([70, 70]);
    // A number is what sounds, whatever is read.
    expect(readRange("70", TRUMPET)).toEqual([70, 70]);
  });

  it("is written as it is read", () => {
    for (const range of [
      [70, 70],
      [72, 79],
      [0, 77],
      [78, 127],
    ] as const)
      expect(readRange(rangeName(range, TRUMPET), TRUMPET)).toEqual(range);
    expect(rangeName([0, 127], C_MAJOR)).toBe("");
  });

  it.each([
    ["H4", "“H4” is no pitch. Write a letter from A to G"],
    ["B♭", "B♭ is in every octave. Write which: B♭4."],
    ["G5..C5", "G5 is higher than C5. Write the lower one first: C5..G5."],
    ["C5..G5..C6", "has more than two ends"],
    ["200", "MIDI numbers go from 0 to 127, and 200 does not."],
    ["C12", "C12 is beyond what MIDI has, C-1 to G9."],
  ])("%s is refused, and what would be right is said", (text, message) => {
    expect(() => readRange(text, C_MAJOR)).toThrow(PitchError);
    expect(() => readRange(text, C_MAJOR)).toThrow(message);
  });
});
