import { describe, expect, it } from "vitest";
import type { AlignedBar } from "../generated/protocol";
import { NOTHING } from "./corrections";
import { readTaps, unitOf, type Tapping } from "./taps";

/** Bars of four beats, half a second each, heard from `begins` on and `slower` times as long. */
function bars(count: number, begins = 0, slower = 1): AlignedBar[] {
  return Array.from({ length: count }, (_, bar) => ({
    number: bar + 1,
    confidence: 0.9,
    is_heard: true,
    beats: Array.from({ length: 4 }, (_, beat) => {
      const score_s = 0.5 * (4 * bar + beat);
      return { score_s, song_s: begins + slower * score_s };
    }),
  }));
}

/** What a hand adds to each tap, seconds. */
const HAND = [0.012, -0.018, 0.006, 0.02, -0.011, -0.004, 0.015, -0.02, 0.003, 0.009];

function taps(count: number, begins: number, beat: number): number[] {
  return Array.from({ length: count }, (_, index) => begins + beat * index + (HAND[index % HAND.length] ?? 0));
}

function tapping(given: Partial<Tapping> & Pick<Tapping, "taps">): Tapping {
  return { bars: bars(16), corrections: NOTHING, firstBar: null, around: false, duration: 60, ...given };
}

describe("taps", () => {
  it("move all alike where they are as late everywhere", () => {
    const read = readTaps(tapping({ taps: taps(16, 2.12, 0.5) }));
    expect(read?.placed).toBe(0);
    expect(Math.abs((read?.by ?? 0) - 0.12)).toBeLessThan(0.01);
    expect(read?.corrections).toEqual({ anchors: [], offset_s: read?.by });
  });

  it("add to the offset that is there", () => {
    const read = readTaps(tapping({ taps: taps(8, 1.1, 0.5), corrections: { anchors: [], offset_s: 0.25 } }));
    expect(read?.corrections.offset_s).toBeCloseTo(0.35, 2);
  });

  it("put bar lines where the tempo is another", () => {
    const read = readTaps(tapping({ taps: taps(17, 3, 0.65), firstBar: 0 }));
    expect(read?.by).toBeNull();
    const { anchors = [] } = read?.corrections ?? {};
    expect(anchors.map(({ score_s }) => score_s)).toEqual([0, 2, 4, 6, 8]);
    for (const { score_s, song_s } of anchors) expect(Math.abs(song_s - (3 + 1.3 * score_s))).toBeLessThan(0.02);
  });

  it("go on by their own pulse where it slows down, and over a beat that was left out", () => {
    const times = [3];
    for (let beat = 1; beat <= 24; beat += 1) times.push((times.at(-1) ?? 0) + 0.5 * 1.02 ** beat);
    const read = readTaps(tapping({ taps: times.filter((_, index) => index !== 10), firstBar: 0 }));
    const { anchors = [] } = read?.corrections ?? {};
    expect(anchors.map(({ score_s }) => score_s)).toEqual([0, 2, 4, 6, 8, 10, 12]);
    anchors.forEach(({ song_s }, bar) => expect(Math.abs(song_s - (times[4 * bar] ?? 0))).toBeLessThan(0.03));
  });

  it("leave out a slip of the hand and a tap that is awry", () => {
    const hands = taps(16, 2.1, 0.5);
    const read = readTaps(tapping({ taps: [...hands.slice(0, 6), (hands[5] ?? 0) + 0.08, ...hands.slice(6)] }));
    expect([read?.placed, read?.left]).toEqual([0, 1]);
    const awry = readTaps(tapping({ taps: hands.map((tap, index) => (index === 7 ? tap + 0.2 : tap)) }));
    expect(awry?.left).toBe(1);
    expect(Math.abs((awry?.by ?? 0) - 0.1)).toBeLessThan(0.01);
  });

  it("may be one a bar", () => {
    const read = readTaps(tapping({ taps: taps(6, 2.2, 2) }));
    expect(read?.by).toBeCloseTo(0.2, 1);
  });

  it("replace what was put where they were tapped, and hold what is beside", () => {
    const there = {
      anchors: [
        { score_s: 6, song_s: 6.5 },
        { score_s: 30, song_s: 31 },
      ],
      offset_s: 0,
    };
    const late = taps(17, 4, 0.5).map((tap, index) => tap + 0.012 * index);
    const read = readTaps(tapping({ taps: late, corrections: there, around: true, firstBar: 2 }));
    const places = read?.corrections.anchors.map(({ score_s }) => score_s) ?? [];
    expect(places).toEqual([2, 4, 6, 8, 10, 12, 14, 30]);
    expect(read?.corrections.anchors[0]).toEqual({ score_s: 2, song_s: 2 });
    const times = read?.corrections.anchors.map(({ song_s }) => song_s) ?? [];
    expect(times).toEqual([...times].sort((one, other) => one - other));
  });

  it("say nothing where they are few", () => {
    expect(readTaps(tapping({ taps: [1, 1.5, 2] }))).toBeNull();
    expect(readTaps(tapping({ taps: taps(8, 2, 0.5), bars: [] }))).toBeNull();
  });

  it.each([
    [0.5, 1],
    [0.7, 1],
    [0.38, 1],
    [1.02, 2],
    [1.9, 4],
    [0.26, 0.5],
  ])("every %s s are one in %s beats of half a second", (interval, unit) => {
    expect(unitOf(interval, 0.5)).toBe(unit);
  });
});
