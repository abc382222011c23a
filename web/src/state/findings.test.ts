import { expect, test } from "vitest";
import type { Casting, Finding, Session } from "../generated/protocol";
import { arrivalOf, worthKnowing } from "./findings";

function finding(kind: string, about: Finding["about"], fields: Partial<Finding> = {}): Finding {
  return { kind, about, weight: "note", count: 1, values: {}, text: kind, player: null, details: [], ...fields };
}

function session(findings: Finding[], players = 1): Pick<Session, "findings" | "cast"> {
  const castings = Array.from({ length: players }, () => ({}) as Casting);
  return { findings, cast: { sequence: 0, auto: true, castings, unplayed: [] } };
}

const CHOSEN = finding("part_chosen", "choice", {
  text: "No trumpet in this file: the player plays Vocals",
  player: 0,
});
const CHORDS = finding("chord_note_dropped", "playing", { text: "Plays the top note of 62 chords", player: 0 });

test("who plays what comes first, then what is missing, what became of it, and how often the file was repaired", () => {
  const cut = finding("truncated_track", "file", { weight: "cut", text: "The file is cut short" });
  const repaired = [2, 1].map((count) => finding(`repair_${count}`, "file", { weight: "repaired", count }));
  const unpacked = finding("unpacked", "file");
  expect(arrivalOf(session([CHOSEN, CHORDS, cut, ...repaired, unpacked]))).toEqual({
    title: CHOSEN.text,
    detail: "",
    drumsAlone: false,
    lines: ["The file is cut short", CHORDS.text, "The file was repaired in 3 places"],
    offers: [],
  });
});

test("each player of several is told apart, and offered the octave that fits", () => {
  const far = finding("octave_fit_possible", "playing", {
    text: "9 of 9 notes lie outside",
    player: 1,
    count: 2,
    values: { side: "up" },
  });
  const told = arrivalOf(session([CHOSEN, finding("parts_heard", "choice", { text: "Flute is heard" }), far], 2));
  expect(told.lines).toEqual(["Flute is heard", "Player 2: 9 of 9 notes lie outside"]);
  expect(told.offers).toEqual([{ player: 1, octaves: 2 }]);
});

test("of drums alone the first sentence is the title", () => {
  const drums = finding("drums_alone", "choice", { text: "Drums alone in this file. They are heard. Open another" });
  const told = arrivalOf(session([drums]));
  expect([told.title, told.detail]).toEqual(["Drums alone in this file", "They are heard. Open another"]);
  expect(told.drumsAlone).toBe(true);
});

test("a choice as anybody would expect is not worth a line in the panel", () => {
  const usual = finding("part_chosen", "choice", { values: { side: "own" } });
  const none = finding("part_chosen", "choice", { values: { side: "none" } });
  expect(worthKnowing([usual, none, CHORDS])).toEqual([none, CHORDS]);
});
