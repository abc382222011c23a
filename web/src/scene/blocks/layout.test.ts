import { describe, expect, it } from "vitest";

import { playedScore, type ScoreNote } from "../score";
import { CHUNK_NOTES, layOut, STRUCK, UNPLAYABLE, valveMask } from "./layout";
import { DRUM_PIECES, staffStep } from "./staff";

function melody(count: number): ScoreNote[] {
  return Array.from({ length: count }, (_, i) => ({
    onset_s: i * 0.25,
    duration_s: 0.2,
    written_pitch: 60 + ((i * 7) % 24),
    valves: i % 5 === 0 ? null : [1, 3].slice(0, i % 3),
    player: 0,
  }));
}

describe("valveMask", () => {
  it("has a bit for each valve, and its own value for what cannot be played", () => {
    expect(valveMask([])).toBe(0);
    expect(valveMask([1])).toBe(1);
    expect(valveMask([2, 3])).toBe(6);
    expect(valveMask([1, 2, 3])).toBe(7);
    expect(valveMask(null)).toBe(UNPLAYABLE);
  });
});

describe("layOut", () => {
  it("says of each hit which piece it comes to, and of other notes none", () => {
    const [note] = melody(1);
    if (note === undefined) throw new Error("none");
    const hit = (piece: string): ScoreNote => ({
      ...note,
      fingering: { type: "strike", hand: "left", foot: null, piece },
    });
    const [chunk] = layOut({ notes: [note, hit("snare"), hit("tambourine")], bar_lines_s: [], players: 1 });
    expect([...(chunk?.notePieces ?? [])]).toEqual([0, DRUM_PIECES.indexOf("snare") + 1, 0]);
  });

  it("keeps every note once, in time, whatever order it came in", () => {
    const notes = melody(3 * CHUNK_NOTES + 5);
    const chunks = layOut({ notes: [...notes].reverse(), bar_lines_s: [], players: 1 });
    expect(chunks).toHaveLength(4);
    const columns = chunks.flatMap((chunk) => [...chunk.notes]);
    expect(columns).toHaveLength(4 * notes.length);
    notes.forEach((note, i) => {
      expect(columns.slice(4 * i, 4 * i + 4)).toEqual([
        Math.fround(note.onset_s),
        Math.fround(note.duration_s),
        staffStep(note.written_pitch),
        valveMask(note.valves),
      ]);
    });
  });

  it("lays hits on the drum staff, short, with the limb's mark", () => {
    const hit = (piece: string, hand: "left" | "right" | null, foot: "left" | "right" | null): ScoreNote => ({
      onset_s: 1,
      duration_s: 2,
      written_pitch: 60,
      valves: null,
      fingering: { type: "strike", hand, foot, piece },
      player: 0,
    });
    const hits = [
      hit("snare", "left", null),
      hit("hi_hat", "right", null),
      hit("kick", null, "right"),
      hit("hi_hat", null, "left"),
    ];
    const [chunk] = layOut({ notes: hits, bar_lines_s: [], players: 1 });
    const columns = [...(chunk?.notes ?? [])];
    expect([0, 1, 2, 3].map((at) => columns[4 * at + 2])).toEqual([5, 9, 1, -1]);
    expect([0, 1, 2, 3].map((at) => columns[4 * at + 3])).toEqual([STRUCK + 2, STRUCK + 3, STRUCK + 1, STRUCK]);
    expect(Math.max(...[0, 1, 2, 3].map((at) => columns[4 * at + 1] ?? 9))).toBeLessThan(0.2);
  });

  it("keeps every bar line once, on the staff's height", () => {
    const bars = Array.from({ length: 60 }, (_, i) => i);
    const chunks = layOut({ notes: melody(150), bar_lines_s: bars, players: 1 });
    const drawn: number[] = [];
    for (const { lines } of chunks) {
      for (let i = 0; i < lines.length; i += 4) {
        const [start, end, low, high] = lines.subarray(i, i + 4);
        if (low === high) continue;
        expect([low, high]).toEqual([0, 8]);
        expect(start).toBe(end);
        drawn.push(start ?? Number.NaN);
      }
    }
    expect(drawn).toEqual(bars);
  });

  it("covers its own notes and lines with each chunk's time", () => {
    for (const { startS, endS, notes, lines } of layOut({
      notes: melody(200),
      bar_lines_s: [0, 2, 4, 70],
      players: 1,
    })) {
      for (let i = 0; i < notes.length; i += 4) {
        const onset = notes[i] ?? Number.NaN;
        expect(onset).toBeGreaterThanOrEqual(startS);
        expect(onset + (notes[i + 1] ?? Number.NaN)).toBeLessThanOrEqual(endS + 1e-5);
      }
      for (let i = 0; i < lines.length; i += 4) {
        expect(lines[i]).toBeGreaterThanOrEqual(startS - 1e-5);
        expect(lines[i + 1]).toBeLessThanOrEqual(endS + 1e-5);
      }
    }
  });

  it("rules a ledger line under a low note, as long as the note", () => {
    const [chunk] = layOut({
      notes: [{ onset_s: 1, duration_s: 2, written_pitch: 60, valves: [], player: 0 }],
      bar_lines_s: [],
      players: 1,
    });
    expect([...(chunk?.lines ?? [])]).toEqual([1, 3, -2, -2]);
  });

  it("draws the bar lines of an empty part, and nothing of an empty score", () => {
    expect(layOut({ notes: [], bar_lines_s: [0, 2], players: 1 })[0]?.lines).toHaveLength(8);
    expect(layOut({ notes: [], bar_lines_s: [], players: 1 })).toEqual([]);
  });

  it("keeps each player's notes in their own lane, and rules bar lines in all of them", () => {
    const notes = melody(CHUNK_NOTES + 20).map((note, i) => ({ ...note, player: i % 3 }));
    const chunks = layOut({ notes, bar_lines_s: [0, 4, 8], players: 3 });
    const lanes = chunks.flatMap(({ noteLanes }) => [...noteLanes]);
    expect(lanes).toEqual(notes.map(({ player }) => player));
    const bars = chunks.flatMap(({ lines, lineLanes }) =>
      [...lineLanes].filter((_, i) => lines[4 * i + 2] !== lines[4 * i + 3]),
    );
    expect(bars).toEqual([0, 1, 2, 0, 1, 2, 0, 1, 2]);
    for (const { notes: columns, noteLanes, lines, lineLanes } of chunks) {
      expect([columns.length, lines.length]).toEqual([4 * noteLanes.length, 4 * lineLanes.length]);
    }
  });
});

describe("playedScore", () => {
  it("leaves out what nobody on the stage plays", () => {
    const [first, second, third] = melody(3);
    if (first === undefined || second === undefined || third === undefined) throw new Error("three notes");
    const wire = [
      { ...first, player: null },
      { ...second, player: 1 },
      { ...third, player: 2 },
    ];
    expect(playedScore({ notes: wire, bar_lines_s: [1] }, 2)).toEqual({
      notes: [wire[1]],
      bar_lines_s: [1],
      players: 2,
    });
  });
});
