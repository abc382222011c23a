import { describe, expect, it } from "vitest";
import type { AlignedBar, Alignment } from "../generated/protocol";
import { factsOf, stretches } from "./facts";

function bar(number: number, confidence = 0.9, is_heard = true): AlignedBar {
  const score_s = 2 * (number - 1);
  return { number, confidence, is_heard, beats: [{ score_s, song_s: 3 + score_s }] };
}

function found(given: Partial<NonNullable<Alignment["alignment"]>>, bars: AlignedBar[]): Alignment {
  return {
    status: "found",
    progress: 1,
    confidence: 0.9,
    detail: null,
    is_searchable: true,
    song_duration_s: 30,
    bars,
    alignment: { points: [], score_duration_s: 20, song_duration_s: 30, ...given },
  };
}

const EIGHT = [1, 2, 3, 4, 5, 6, 7, 8];

describe("what was found", () => {
  it("is a lead-in, another key and tuning, and applause", () => {
    const given = { transposition: 2, tuning_cents: -18.4, sounds_after: true };
    expect(
      factsOf(
        found(
          given,
          EIGHT.map((number) => bar(number)),
        ),
      ),
    ).toEqual([
      "The music begins at 0:03.0.",
      "There is other sound after it, such as applause.",
      "The recording sounds 2 semitones higher.",
      "It is tuned 18 cents lower than A = 440 Hz.",
    ]);
  });

  it("is what was counted in", () => {
    expect(factsOf(found({ count_in: 4 }, [bar(1)]))[0]).toBe("4 beats are counted in; the music begins at 0:03.0.");
  });

  it("is which bars are left out, and what the score has not", () => {
    const gaps = [{ score_from_s: 4, score_to_s: 10, song_from_s: 7, song_to_s: 12 }];
    const bars = EIGHT.map((number) => bar(number, 0.9, number < 3 || number > 5));
    expect(factsOf(found({ gaps }, bars)).slice(1)).toEqual([
      "Bars 3–5 are left out (6 s).",
      "From 0:07 to 0:12 there is something that the score has not, or a repeat.",
    ]);
  });

  it("is which bars are unsure, where they are few", () => {
    const bars = EIGHT.map((number) => bar(number, [2, 6, 7].includes(number) ? 0.3 : 0.9));
    expect(factsOf(found({}, bars)).at(-1)).toBe("Not sure: bars 2 and 6–7. Listen there.");
    const many = Array.from({ length: 20 }, (_, index) => bar(index + 1, index % 2 === 0 ? 0.3 : 0.9));
    expect(factsOf(found({}, many)).at(-1)).toBe("Many bars are not sure: listen to the dashed ones.");
  });

  it("is nothing where it is other music", () => {
    expect(factsOf({ ...found({}, [bar(1)]), status: "unlike" })).toEqual([]);
  });
});

it("finds stretches", () => {
  expect(stretches([true, true, false, true])).toEqual([
    [0, 1],
    [3, 3],
  ]);
});
