import { describe, expect, it } from "vitest";
import type { AlignedBar } from "../generated/protocol";
import { boundsOf, moved, NOTHING, previewed, withBarAt, withoutAnchor, type Drag } from "./corrections";
import { History } from "./history";

/** Six bars of two seconds, heard a second late; the fourth is left out. */
const BARS: AlignedBar[] = Array.from({ length: 6 }, (_, bar) => ({
  number: bar + 1,
  confidence: 0.9,
  is_heard: bar !== 3,
  beats: [0, 1].map((beat) => ({ score_s: 2 * bar + beat, song_s: 1 + 2 * bar + beat })),
}));

function drag(given: Partial<Drag>): Drag {
  return { bars: BARS, corrections: NOTHING, index: 2, around: true, duration: 20, ...given };
}

describe("a bar line that is dragged", () => {
  it("is an anchor there, and the bars beside it stay: over one that is not heard", () => {
    expect(withBarAt(drag({}), 5.4)).toEqual({
      anchors: [
        { score_s: 2, song_s: 3 },
        { score_s: 4, song_s: 5.4 },
        { score_s: 8, song_s: 9 },
      ],
      offset_s: 0,
    });
  });

  it("takes all with it where nothing is to be held", () => {
    const then = withBarAt(drag({ around: false }), 5.5);
    expect(then.anchors).toEqual([{ score_s: 4, song_s: 5.5 }]);
    expect(previewed(BARS, NOTHING, then)).toEqual([1.5, 3.5, 5.5, 7.5, 9.5, 11.5]);
  });

  it("is put before the offset that moves everything", () => {
    const corrections = { anchors: [], offset_s: 0.25 };
    expect(withBarAt(drag({ corrections, around: false }), 5.5).anchors).toEqual([{ score_s: 4, song_s: 5.25 }]);
  });

  it("moves again where it was put, and no anchor beside it twice", () => {
    const once = withBarAt(drag({}), 5.4);
    const twice = withBarAt(drag({ corrections: once }), 5.2);
    expect(twice.anchors).toHaveLength(3);
    expect(twice.anchors[1]).toEqual({ score_s: 4, song_s: 5.2 });
  });

  it("stays between what is held, and within the song", () => {
    expect(boundsOf(drag({}))).toEqual([3.02, 8.98]);
    expect(withBarAt(drag({}), 12).anchors[1]?.song_s).toBe(8.98);
    expect(boundsOf(drag({ around: false }))).toEqual([0, 20]);
    expect(boundsOf(drag({ around: false, corrections: { anchors: [], offset_s: -0.5 } }))).toEqual([0, 19.5]);
  });

  it("stretches evenly what lies between it and the next anchors", () => {
    const then = withBarAt(drag({}), 6);
    expect(previewed(BARS, NOTHING, then)).toEqual([1, 3, 6, 7.5, 9, 11]);
    expect(withoutAnchor(then, 4).anchors.map(({ score_s }) => score_s)).toEqual([2, 8]);
  });
});

describe("an offset", () => {
  it("is kept to the millisecond, and moves every bar line", () => {
    let corrections = NOTHING;
    for (let press = 0; press < 3; press += 1) corrections = moved(corrections, 0.01);
    expect(corrections.offset_s).toBe(0.03);
    expect(previewed(BARS, NOTHING, moved(NOTHING, -0.5))[1]).toBe(2.5);
  });
});

describe("the history of corrections", () => {
  const same = (one: number, other: number): boolean => one === other;

  it("goes back and on, a step at a time", () => {
    const history = new History<number>(0, same).take(1).take(2);
    expect([history.undone?.present, history.undone?.undone?.present]).toEqual([1, 0]);
    expect(history.undone?.undone?.undone).toBeNull();
    expect(history.undone?.redone?.present).toBe(2);
    expect(history.redone).toBeNull();
  });

  it("forgets what was taken back once something else is put", () => {
    const history = new History<number>(0, same).take(1).undone?.take(5);
    expect([history?.redone, history?.undone?.present]).toEqual([null, 0]);
  });

  it("takes what somebody else put as a step, and the same as none", () => {
    const history = new History<number>(0, same).take(1).take(1);
    expect(history.undone?.present).toBe(0);
  });
});
