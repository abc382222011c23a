import { describe, expect, it } from "vitest";
import type { PartEntry, PartHead, PartMeasure, PartNote, PartPitch, WrittenPart } from "../generated/protocol";
import { entriesOfHits } from "./drum-layout";
import { fingeringText } from "./fingering";
import { INDENT, layOut, systemAt } from "./layout";
import { staffPlace } from "./staff";

const A4: PartPitch = { name: "A4", letter: "A", octave: 4, accidental: null };

function entry(change: Partial<PartEntry> = {}): PartEntry {
  return {
    begin_ticks: 0,
    ticks: 48,
    value: 4,
    dots: 0,
    note: 0,
    is_bar_rest: false,
    written: A4,
    sounding: A4,
    tied_from: false,
    tied_to: false,
    beam: null,
    tuplet: null,
    is_staccato: false,
    graces: [],
    trill: null,
    voice: null,
    heads: [],
    ...change,
  };
}

function measure(number: number, change: Partial<PartMeasure> = {}): PartMeasure {
  return {
    number,
    bars: 1,
    begin_s: 2 * number - 2,
    end_s: 2 * number,
    ticks: 192,
    numerator: 4,
    denominator: 4,
    fifths: 0,
    written_fifths: 2,
    entries: Array.from({ length: 4 }, () => entry()),
    ...change,
  };
}

function part(measures: PartMeasure[], change: Partial<WrittenPart> = {}): WrittenPart {
  return {
    title: "",
    part_name: "",
    player: 0,
    instrument: "trumpet",
    instrument_title: "B♭ trumpet",
    clef: "treble",
    written_above_sounding: 2,
    swing: false,
    keys: [],
    tempi: [],
    notes: [],
    measures,
    ...change,
  };
}

const TWENTY = part(Array.from({ length: 20 }, (_, at) => measure(at + 1)));

describe("layOut", () => {
  it("puts every measure into one line, in order, and fills the lines", () => {
    for (const width of [300, 700, 1200]) {
      const systems = layOut(TWENTY, "written", width);
      expect(systems.flatMap(({ measures }) => measures.map(({ index }) => index))).toEqual(
        Array.from({ length: 20 }, (_, at) => at),
      );
      for (const { measures, full } of systems) {
        const used = measures.reduce((sum, one) => sum + one.width, INDENT);
        if (full) expect(used).toBeCloseTo(width);
        else expect(used).toBeLessThan(width);
      }
      expect(systems.slice(0, -1).every(({ full }) => full)).toBe(true);
    }
    expect(layOut(TWENTY, "written", 1200).length).toBeLessThan(layOut(TWENTY, "written", 700).length);
  });

  it("gives a line of its own to a measure that is wider than the page, and squeezes it", () => {
    const dense = measure(1, { entries: Array.from({ length: 32 }, () => entry({ ticks: 6, value: 32 })) });
    const [first, second] = layOut(part([dense, measure(2)]), "written", 400);
    expect(first?.measures.map(({ index }) => index)).toEqual([0]);
    expect(first?.measures[0]?.width).toBeCloseTo(400 - INDENT);
    expect(second?.measures.map(({ index }) => index)).toEqual([1]);
  });

  it("prints a metre where it changes and a signature as the part is read", () => {
    const changes = part([
      measure(1),
      measure(2, { numerator: 3 }),
      measure(3, { numerator: 3, written_fifths: -3 }),
      measure(4, { numerator: 3, written_fifths: -3, fifths: 1 }),
    ]);
    const shown = (reading: "written" | "sounding") =>
      layOut(changes, reading, 2000)
        .flatMap(({ measures }) => measures)
        .map(({ showsKey, showsMetre }) => [showsKey, showsMetre]);
    expect(shown("written")).toEqual([
      [false, true],
      [false, true],
      [true, false],
      [false, false],
    ]);
    expect(shown("sounding").map(([key]) => key)).toEqual([false, false, false, true]);
  });

  it("makes room for notes above and below the staff, for tempi and for trills", () => {
    const height = (one: PartEntry, change: Partial<WrittenPart> = {}) =>
      layOut(part([measure(1, { entries: [one] })], change), "written", 700)[0]?.height ?? 0;
    const plain = height(entry());
    expect(height(entry({ written: { ...A4, octave: 6 } }))).toBeGreaterThan(plain);
    expect(height(entry({ written: { ...A4, octave: 3 } }))).toBeGreaterThan(plain);
    expect(height(entry({ trill: 1 }))).toBeGreaterThan(plain);
    expect(height(entry(), { tempi: [{ measure: 0, begin_ticks: 0, bpm: 100, word: "" }] })).toBeGreaterThan(plain);
  });

  it("has no line for no measures", () => {
    expect(layOut(part([]), "written", 700)).toEqual([]);
  });
});

describe("systemAt", () => {
  it("finds the line that is played", () => {
    const systems = [{ beginS: 0 }, { beginS: 4 }, { beginS: 8 }];
    expect([0, 3.99, 4, 7, 8, 100].map((time) => systemAt(systems, time))).toEqual([0, 0, 1, 1, 2, 2]);
    expect(systemAt([], 3)).toBe(0);
  });
});

describe("staffPlace", () => {
  it("counts letters from C0", () => {
    expect(staffPlace({ letter: "C", octave: 0 })).toBe(0);
    expect(staffPlace({ letter: "B", octave: 4 }) - staffPlace({ letter: "E", octave: 4 })).toBe(4);
  });
});

describe("fingeringText", () => {
  it("is as players write it", () => {
    expect([[], [1], [1, 3], null].map(fingeringText)).toEqual(["0", "1", "1-3", "×"]);
  });
});

const NOTE: PartNote = {
  index: 0,
  onset_s: 0,
  end_s: 1,
  sounding_name: "snare",
  written_name: "snare",
  valves: null,
  usual_valves: null,
  reason: "",
  piece: "snare",
  limb: "right_hand",
};

function hit(letter: PartHead["letter"], octave: number, change: Partial<PartHead> = {}): PartHead {
  return { note: 0, letter, octave, shape: "plain", mark: null, is_ghost: false, hand: "R", ...change };
}

describe("a drum part", () => {
  const eighths = Array.from({ length: 8 }, (_, at) =>
    entry({ begin_ticks: 24 * at, ticks: 24, value: 8, voice: "hands", heads: [hit("G", 5, { shape: "cross" })] }),
  );
  const kick = entry({ voice: "feet", heads: [hit("F", 4, { hand: null })] });
  const rest = entry({ begin_ticks: 48, ticks: 144, note: null, written: null, voice: "feet" });

  function drums(...measures: PartEntry[][]): WrittenPart {
    return part(
      measures.map((entries, at) => measure(at + 1, { entries })),
      { clef: "percussion", written_above_sounding: 0 },
    );
  }

  it("is as wide as what goes on in both voices, and not as both after one another", () => {
    const [alone] = layOut(drums(eighths), "written", 2000);
    const [both] = layOut(drums([...eighths, kick, rest]), "written", 2000);
    expect(both?.measures[0]?.width).toBe(alone?.measures[0]?.width);
  });

  it("has room for stems above, for feet below and for a line of each hand", () => {
    const [hands] = layOut(drums(eighths), "written", 2000);
    const [both] = layOut(drums([...eighths, kick, rest]), "written", 2000);
    const marked = eighths.map((one) => ({ ...one, heads: [hit("A", 5, { mark: "accent" })] }));
    const [higher] = layOut(drums(marked), "written", 2000);
    expect(hands?.hasSecond).toBe(true);
    expect(both?.top).toBe(hands?.top);
    expect(both?.height).toBeGreaterThan((hands?.height ?? 0) + 30);
    expect(higher?.top).toBeGreaterThan((hands?.top ?? 0) + 10);
  });

  it("knows what each hit stands above on paper", () => {
    const notes = [0, 1, 2, 3].map((index) => ({ ...NOTE, index }));
    const flam = { note: 0, written: A4, sounding: A4, head: hit("C", 5) };
    const hands = entry({
      note: 2,
      voice: "hands",
      heads: [hit("C", 5, { note: 1 }), hit("G", 5, { note: 2 })],
      graces: [flam],
    });
    const feet = entry({ note: 3, voice: "feet", heads: [hit("F", 4, { note: 3 })] });
    expect(entriesOfHits({ ...drums([hands, feet]), notes })).toEqual([2, 2, 2, 3]);
  });
});
