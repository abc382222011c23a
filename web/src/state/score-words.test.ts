import { describe, expect, it } from "vitest";
import type { LyricLine } from "../generated/protocol";
import { lyricLineAt, placeWords, sungLines, sungSyllables, withoutHands } from "./score-words";

function line(start_s: number, end_s: number, ...texts: string[]): LyricLine {
  return { start_s, end_s, syllables: texts.map((text, number) => ({ onset_s: start_s + number, text })) };
}

function word(onset_s: number, text: string): { onset_s: number; onset_beats: number; text: string } {
  return { onset_s, onset_beats: 2 * onset_s, text };
}

describe("lyricLineAt", () => {
  const lines = [line(10, 14, "one "), line(14, 18, "two "), line(40, 44, "three ")];

  it("is the line that is sung, or that soon will be", () => {
    expect(lyricLineAt(lines, 5)).toBeNull();
    expect(lyricLineAt(lines, 6)).toBe(lines[0]);
    expect(lyricLineAt(lines, 13.9)).toBe(lines[0]);
    expect(lyricLineAt(lines, 14)).toBe(lines[1]);
    expect(lyricLineAt(lines, 20)).toBeNull();
    expect(lyricLineAt(lines, 37)).toBe(lines[2]);
    expect(lyricLineAt(lines, 60)).toBeNull();
    expect(lyricLineAt([], 0)).toBeNull();
  });

  it("counts the syllables that have begun", () => {
    const sung = line(10, 14, "Hel", "lo ", "you");
    expect([9, 10, 11.5, 13].map((time) => sungSyllables(sung, time))).toEqual([0, 1, 2, 3]);
  });
});

describe("withoutHands", () => {
  it("leaves out the hands that are written at strokes, and nothing else", () => {
    const strike = { type: "strike" };
    const notes = [
      { onset_s: 1, fingering: strike },
      { onset_s: 2, fingering: strike },
      { onset_s: 3, fingering: { type: "valves" } },
      { onset_s: 4, fingering: null },
    ];
    const texts = [word(1.001, "R"), word(2, " l "), word(2, "rit."), word(2.5, "L"), word(3, "R"), word(4, "D")];
    expect(withoutHands(texts, notes).map(({ text }) => text)).toEqual(["rit.", "L", "R", "D"]);
    const [hands, sung] = [line(1, 3, "R ", "L"), line(1, 3, "R ", "ain")];
    expect(sungLines([hands, sung], notes)).toEqual([sung]);
  });
});

describe("placeWords", () => {
  const all = { from: 0, to: 100, width: 500 };

  it("puts words at their time, markers first where there is room for one alone", () => {
    const placed = placeWords({ markers: [word(10, "Verse")], texts: [word(8, "softly"), word(60, "rit.")] }, all);
    expect(placed.map(({ x, label, marker }) => [x, label, marker])).toEqual([
      [40, null, false],
      [50, "Verse", true],
      [300, "rit.", false],
    ]);
  });

  it("makes one place of words at one time", () => {
    const placed = placeWords({ markers: [word(10, "A")], texts: [word(10, "Allegro"), word(10, "Allegro")] }, all);
    expect(placed).toEqual([{ time: 10, x: 50, marker: true, label: "A", all: "A · Allegro" }]);
  });

  it("leaves out what is not on screen, and labels that would not fit at the end", () => {
    const markers = [word(5, "before"), word(49.9, "Coda")];
    const placed = placeWords({ markers, texts: [] }, { from: 10, to: 50, width: 400 });
    expect(placed.map(({ label, all }) => [label, all])).toEqual([[null, "Coda"]]);
  });
});
