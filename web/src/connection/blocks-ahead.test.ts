import { describe, expect, it } from "vitest";
import type { TransportState } from "../generated/protocol";
import { blocksAhead } from "./blocks-ahead";
import { sampleTransport } from "./sample-blocks";

const DURATION = 30;

/** What is needed some seconds after the transport's own time: number and how soon, to a tenth. */
function needed(transport: TransportState, seconds = 0): [number, number][] {
  const blocks = blocksAhead(transport, transport.server_time_s + seconds, DURATION, 60);
  return blocks.map(({ number, comes }) => [number, Math.round(comes * 10) / 10]);
}

describe("blocksAhead", () => {
  it("is the present block alone while paused", () => {
    expect(needed(sampleTransport({ playing: false, song_time_s: 7.5 }))).toEqual([[7, 0]]);
  });

  it("is what the next seconds come to", () => {
    expect(needed(sampleTransport(), 4.3).map(([number]) => number)).toEqual([4, 5, 6]);
    expect(needed(sampleTransport(), 4.3)[1]?.[1]).toBeCloseTo(0.7, 6);
  });

  it("goes as fast as the song", () => {
    expect(needed(sampleTransport({ rate: 4 })).map(([number]) => number)).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    expect(needed(sampleTransport({ rate: 0.25 })).map(([number]) => number)).toEqual([0]);
  });

  it("goes round a loop, each block once", () => {
    const loop = { start_s: 3.5, end_s: 5.2, count_in_s: 0 };
    expect(needed(sampleTransport({ song_time_s: 4.5, loop }))).toEqual([
      [4, 0],
      [5, 0.5],
      [3, 0.7],
    ]);
  });

  it("waits for count-ins", () => {
    expect(needed(sampleTransport({ song_time_s: 1.5, count_in_s: 1 })).map(([number]) => number)).toEqual([1, 2, 3]);
    const loop = { start_s: 3, end_s: 4, count_in_s: 2 };
    expect(needed(sampleTransport({ song_time_s: 3.5, loop })).map(([number]) => number)).toEqual([3]);
  });

  it("ends with the song", () => {
    expect(needed(sampleTransport({ song_time_s: 29.5 }))).toEqual([
      [29, 0],
      [30, 0.5],
    ]);
  });
});
