import { describe, expect, it } from "vitest";
import type { Score } from "../generated/protocol";
import { beatLength, clicksBetween, countInClicks, countInLength, type Click } from "./beats";

type Grid = Pick<Score, "tempi" | "metres" | "bar_lines_s">;

const tempo = (onset_beats: number, onset_s: number, bpm: number) => ({ onset_beats, onset_s, bpm });
const metre = (onset_beats: number, onset_s: number, numerator: number, denominator: number) => ({
  onset_beats,
  onset_s,
  numerator,
  denominator,
});

/** 4/4 at 120. */
const march: Grid = { tempi: [tempo(0, 0, 120)], metres: [metre(0, 0, 4, 4)], bar_lines_s: [0, 2, 4, 6] };

function times(clicks: readonly Click[]): number[] {
  return clicks.map(({ songTime }) => Math.round(songTime * 1e6) / 1e6);
}

function kinds(clicks: readonly Click[]): string {
  return clicks.map(({ kind }) => ({ bar: "B", beat: "b", division: "." })[kind]).join("");
}

describe("beatLength", () => {
  it("is the metre's own note value, dotted in compound metres", () => {
    const lengths = [
      [4, 4, 1],
      [2, 2, 2],
      [3, 8, 0.5],
      [6, 8, 1.5],
      [12, 8, 1.5],
      [9, 16, 0.75],
      [3, 4, 1],
      [6, 4, 1],
      [5, 8, 0.5],
    ];
    for (const [numerator = 0, denominator = 0, length] of lengths) {
      expect(beatLength({ numerator, denominator }), `${numerator}/${denominator}`).toBe(length);
    }
  });
});

describe("clicksBetween", () => {
  it("clicks beats, the first of a bar apart, and neither end twice", () => {
    const clicks = clicksBetween(march, 1, 4, "beats");
    expect(times(clicks)).toEqual([1, 1.5, 2, 2.5, 3, 3.5]);
    expect(kinds(clicks)).toBe("bbBbbb");
    const halves = [...clicksBetween(march, 1, 2.5, "beats"), ...clicksBetween(march, 2.5, 4, "beats")];
    expect(halves).toEqual(clicks);
  });

  it("goes on to the end of the last bar", () => {
    expect(times(clicksBetween(march, 5.9, 60, "beats"))).toEqual([6, 6.5, 7, 7.5]);
  });

  it("divides beats into eighths: two of a quarter, three of a dotted one, four of a half", () => {
    expect(kinds(clicksBetween(march, 0, 2, "eighths"))).toBe("B.b.b.b.");
    const jig: Grid = { ...march, metres: [metre(0, 0, 6, 8)], bar_lines_s: [0, 1.5, 3] };
    expect(kinds(clicksBetween(jig, 0, 3, "eighths"))).toBe("B..b..B..b..");
    expect(kinds(clicksBetween(jig, 0, 3, "beats"))).toBe("BbBb");
    const breve: Grid = { ...march, metres: [metre(0, 0, 2, 2)] };
    expect(kinds(clicksBetween(breve, 0, 2, "eighths"))).toBe("B...b...");
    const five: Grid = { ...march, metres: [metre(0, 0, 5, 8)], bar_lines_s: [0, 1.25] };
    expect(kinds(clicksBetween(five, 0, 1.25, "eighths"))).toBe("Bbbbb");
  });

  it("follows changes of tempo and metre", () => {
    const changing: Grid = {
      tempi: [tempo(0, 0, 120), tempo(2, 1, 60)],
      metres: [metre(0, 0, 4, 4), metre(4, 3, 3, 4)],
      bar_lines_s: [0, 3, 6],
    };
    const clicks = clicksBetween(changing, 0, 6, "beats");
    expect(times(clicks)).toEqual([0, 0.5, 1, 2, 3, 4, 5]);
    expect(kinds(clicks)).toBe("BbbbBbb");
  });

  it("counts a pickup to its bar's end, and leaves a recording's lead-in alone", () => {
    const pickup: Grid = { ...march, bar_lines_s: [0, 0.5, 2.5] };
    expect(kinds(clicksBetween(pickup, 0, 2.5, "beats"))).toBe("bBbbb");
    const recorded: Grid = { ...march, tempi: [tempo(0, 3, 120)], metres: [metre(0, 3, 4, 4)], bar_lines_s: [3, 5, 7] };
    expect(times(clicksBetween(recorded, 0, 4, "beats"))).toEqual([3, 3.5]);
  });
});

describe("a count-in", () => {
  it("is whole bars in the tempo of the bar that follows", () => {
    expect(countInLength(march, 2, 1)).toBeCloseTo(2, 9);
    expect(countInLength(march, 2, 2)).toBeCloseTo(4, 9);
    expect(countInLength(march, 2, 0)).toBe(0);
    const clicks = countInClicks(march, 2, 4, "beats");
    expect(times(clicks)).toEqual([-2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5]);
    expect(kinds(clicks)).toBe("BbbbBbbb");
  });

  it("takes the mean tempo of a bar that is not even, as of a recording", () => {
    const uneven: Grid = {
      tempi: [tempo(0, 0, 100), tempo(1, 0.6, 120), tempo(2, 1.1, 150), tempo(3, 1.5, 120)],
      metres: [metre(0, 0, 4, 4)],
      bar_lines_s: [0, 2, 4],
    };
    expect(times(countInClicks(uneven, 0, countInLength(uneven, 0, 1), "beats"))).toEqual([-2, -1.5, -1, -0.5]);
  });

  it("begins with a first beat, wherever the music begins", () => {
    const pickup: Grid = { ...march, bar_lines_s: [0, 0.5, 2.5, 4.5] };
    expect(kinds(countInClicks(pickup, 0, countInLength(pickup, 0, 1), "beats"))).toBe("Bbb");
    expect(kinds(countInClicks(pickup, 0, countInLength(pickup, 0, 2), "beats"))).toBe("BbbbBbb");
    const second = countInLength(march, 2.5, 1);
    expect(kinds(countInClicks(march, 2.5, second, "beats"))).toBe("BbbbB");
    expect(kinds(countInClicks(march, 3, countInLength(march, 3, 1), "beats"))).toBe("Bb");
  });

  it("leads on into the beat, where the music does not begin on one", () => {
    const length = countInLength(march, 2.2, 1);
    expect(times(countInClicks(march, 2.2, length, "beats"))).toEqual([0, 0.5, 1, 1.5, 2]);
  });

  it("counts dotted beats of a compound metre", () => {
    const jig: Grid = { ...march, metres: [metre(0, 0, 6, 8)], bar_lines_s: [0, 1.5, 3] };
    expect(times(countInClicks(jig, 1.5, countInLength(jig, 1.5, 1), "beats"))).toEqual([0, 0.75]);
  });
});
