import { describe, expect, it } from "vitest";
import { FLAG_CUT, FLAG_FIRST, FLAG_PLAYING } from "../generated/protocol";
import { epochsAhead, FrameQueue } from "./frame-queue";
import { encodeSampleFrames, SAMPLE_MANIFEST } from "./sample-frames";

const STEP = 1 / 60;

function queueOf(epoch = 0, capacity = 8): FrameQueue {
  return new FrameQueue(SAMPLE_MANIFEST, epoch, capacity);
}

describe("FrameQueue", () => {
  it("has nothing to draw until a frame has come", () => {
    expect(queueOf().frameAt(0)).toBeNull();
  });

  it("draws the frame due at the moment asked for, bit for bit", () => {
    const queue = queueOf();
    const floats = Array.from({ length: 18 }, (_, i) => Math.fround(Math.sin(i + 0.1)));
    queue.push(encodeSampleFrames({ index: 10, due: 5 }, { index: 11, due: 5 + STEP, floats }));
    const drawn = queue.frameAt(5 + STEP);
    expect(drawn).toMatchObject({ index: 11, songTime: 11 / 60, playing: true });
    expect([...(drawn?.floats ?? [])]).toEqual(floats);
  });

  it("blends the two frames around a moment between them", () => {
    const queue = queueOf();
    queue.push(encodeSampleFrames({ index: 10, due: 5 }, { index: 11, due: 5 + STEP }));
    const drawn = queue.frameAt(5 + STEP / 4);
    expect(drawn?.index).toBe(10);
    expect(drawn?.songTime).toBeCloseTo(10.25 / 60, 9);
  });

  it("holds the first frame before its time and the last one after it", () => {
    const queue = queueOf();
    queue.push(encodeSampleFrames({ index: 10, due: 5 }, { index: 11, due: 5 + STEP }));
    expect(queue.frameAt(1)?.index).toBe(10);
    expect(queue.frameAt(99)?.index).toBe(11);
    expect(queue.frameAt(100)?.songTime).toBeCloseTo(11 / 60, 9);
  });

  it("takes a frame that is sent twice once, but the music's end anew", () => {
    const queue = queueOf();
    const frames = [10, 11, 12].map((index) => ({ index, due: 5 + (index - 10) * STEP }));
    expect(queue.push(encodeSampleFrames(...frames))).toBe(3);
    expect(queue.firstDue).toBe(5);
    const again = frames.slice(1).map(({ index, due }) => ({ index, due: due + 1e-9 }));
    expect(queue.push(encodeSampleFrames(...again, { index: 13, due: 5 + 3 * STEP }))).toBe(1);
    expect(queue.firstDue).toBeCloseTo(5 + 3 * STEP, 9);
    expect(queue.frameAt(5 + 2.5 * STEP)?.songTime).toBeCloseTo(12.5 / 60, 9);
    expect(queue.push(encodeSampleFrames({ index: 13, due: 5 + 3 * STEP, flags: 0 }))).toBe(1);
    expect(queue.frameAt(6)).toMatchObject({ index: 13, playing: false });
  });

  it.each([
    ["a cut", FLAG_PLAYING | FLAG_CUT],
    ["a new beginning", FLAG_PLAYING | FLAG_FIRST],
  ])("does not blend into %s", (_, flags) => {
    const queue = queueOf();
    queue.push(encodeSampleFrames({ index: 10, due: 5 }, { index: 11, due: 5 + STEP, flags }));
    expect(queue.frameAt(5 + STEP * 0.9)?.songTime).toBe(10 / 60);
    expect(queue.frameAt(5 + STEP)?.songTime).toBe(11 / 60);
  });

  it("does not blend backwards over a loop's end", () => {
    const queue = queueOf();
    queue.push(encodeSampleFrames({ index: 100, due: 5 }, { index: 40, due: 5 + STEP }));
    expect(queue.frameAt(5 + STEP / 2)?.songTime).toBe(100 / 60);
  });

  it("drops frames of an older epoch and lets a newer one replace what is held", () => {
    const queue = queueOf(7);
    expect(queue.push(encodeSampleFrames({ epoch: 6, index: 1, due: 1 }))).toBe(0);
    queue.push(encodeSampleFrames({ epoch: 7, index: 2, due: 1 }, { epoch: 7, index: 3, due: 2 }));
    expect(queue.push(encodeSampleFrames({ epoch: 8, index: 90, due: 9 }))).toBe(1);
    expect(queue.length).toBe(1);
    expect(queue.frameAt(1)).toMatchObject({ index: 90, epoch: 8 });
    expect(queue.push(encodeSampleFrames({ epoch: 7, index: 4, due: 3 }))).toBe(0);
  });

  it("counts epochs modulo 256", () => {
    const queue = queueOf(255);
    expect(queue.push(encodeSampleFrames({ epoch: 0, index: 5, due: 1 }))).toBe(1);
    expect(queue.push(encodeSampleFrames({ epoch: 255, index: 4, due: 1 }))).toBe(0);
    expect(epochsAhead(3, 250)).toBe(9);
    expect(epochsAhead(250, 3)).toBe(-9);
    expect(epochsAhead(8, 8)).toBe(0);
  });

  it("keeps showing what it drew when a transport message empties it", () => {
    const queue = queueOf(1);
    queue.push(encodeSampleFrames({ epoch: 1, index: 30, due: 1 }));
    queue.frameAt(1);
    queue.enterEpoch(2);
    expect(queue.length).toBe(0);
    expect(queue.frameAt(2)?.index).toBe(30);
    queue.enterEpoch(1);
    expect(queue.epoch).toBe(2);
  });

  it("lets the oldest frames go when it is full, and stays in order as the ring wraps", () => {
    const queue = queueOf(0, 4);
    for (let k = 0; k < 11; k++) queue.push(encodeSampleFrames({ index: k, due: k * STEP }));
    expect(queue.length).toBe(4);
    expect(queue.frameAt(0)?.index).toBe(7);
    expect(queue.lastDue).toBeCloseTo(10 * STEP, 12);
    expect(queue.frameAt(10 * STEP)?.index).toBe(10);
  });

  it("gives out the same object each time", () => {
    const queue = queueOf();
    queue.push(encodeSampleFrames({ index: 1, due: 1 }, { index: 2, due: 2 }));
    expect(queue.frameAt(1)).toBe(queue.frameAt(2));
  });

  it("refuses what is not whole frames of its version", () => {
    const queue = queueOf();
    expect(() => queue.push(new ArrayBuffer(100))).toThrow(/whole frames of 96 bytes/);
    const other = encodeSampleFrames({ index: 1, due: 1 });
    new Uint8Array(other)[0] = 9;
    expect(() => queue.push(other)).toThrow(/version 9/);
  });
});
