import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { barIndexAt, beatsAt } from "../../state/score-time";
import type { Score } from "../../generated/protocol";
import { withEdits, type Edit } from "./edits";
import { TIME_UNITS, type ShowDocument } from "./show-document";
import { TimeAxis } from "./time-axis";

interface Golden {
  readonly score: Pick<Score, "tempi" | "bar_lines_s">;
  readonly places: readonly { readonly seconds: number; readonly beats: number; readonly bars: number }[];
  readonly show: ShowDocument;
  readonly cases: readonly { readonly name: string; readonly edits: readonly Edit[]; readonly edited: ShowDocument }[];
}

/** What the server makes of the music's time and of edits: it is written there, and the server is held to it too. */
const golden = JSON.parse(
  readFileSync(new URL("../../../../tests/golden/show_edits.json", import.meta.url), "utf8"),
) as Golden;
const axis = new TimeAxis(golden.score);

/** Every number of a document, and everything else of it: the page rounds the times that it writes. */
function takenApart(value: unknown): [numbers: Record<string, number>, rest: unknown] {
  const numbers: Record<string, number> = {};
  const named = (_: string, item: unknown) => (typeof item === "number" ? "a number" : item);
  const rest = JSON.parse(JSON.stringify(value, named)) as unknown;
  const walk = (item: unknown, place: string): void => {
    if (typeof item === "number") numbers[place] = item;
    else if (typeof item === "object" && item !== null)
      for (const [name, inner] of Object.entries(item)) walk(inner, `${place}/${name}`);
  };
  walk(value, "");
  return [numbers, rest];
}

describe("the music's time, as the server tells it", () => {
  it.each(golden.places)("$seconds s is beat $beats and bar $bars", (place) => {
    for (const unit of TIME_UNITS) {
      expect(axis.inUnit(unit, place.seconds)).toBeCloseTo(place[unit], 8);
      expect(axis.toSongTime(unit, place[unit])).toBeCloseTo(place.seconds, 8);
    }
    expect(beatsAt(golden.score.tempi, place.seconds)).toBeCloseTo(place.beats, 5);
    const last = golden.score.bar_lines_s.length - 1;
    const bar = Math.min(Math.floor(place.bars + 1e-6), last);
    expect(barIndexAt(golden.score.bar_lines_s, place.seconds)).toBe(bar);
  });
});

describe("edits, as the server makes them", () => {
  it.each(golden.cases)("$name", ({ edits, edited }) => {
    const [numbers, rest] = takenApart(withEdits(golden.show, edits, axis));
    const [expected, all] = takenApart(edited);
    expect(rest).toEqual(all);
    for (const [place, number] of Object.entries(expected)) expect(numbers[place], place).toBeCloseTo(number, 5);
  });
});
