import { describe, expect, it } from "vitest";
import type { TransportState } from "../generated/protocol";
import { countInAt, songTimeAt } from "./song-time";

function transport(change: Partial<TransportState>): TransportState {
  return {
    playing: true,
    song_time_s: 10,
    server_time_s: 100,
    rate: 1,
    loop: null,
    count_in_s: 0,
    epoch: 1,
    ...change,
  };
}

describe("songTimeAt", () => {
  it("stands still while paused", () => {
    expect(songTimeAt(transport({ playing: false }), 500, 60)).toBe(10);
  });

  it("runs with the server's clock at the rate", () => {
    expect(songTimeAt(transport({}), 104, 60)).toBe(14);
    expect(songTimeAt(transport({ rate: 0.5 }), 104, 60)).toBe(12);
  });

  it("stops at the end", () => {
    expect(songTimeAt(transport({}), 1000, 60)).toBe(60);
  });

  it("goes round a loop that it plays into, and past one that it stands behind", () => {
    const loop = { start_s: 11, end_s: 13, count_in_s: 0 };
    expect(songTimeAt(transport({ loop }), 102.5, 60)).toBeCloseTo(12.5, 9);
    expect(songTimeAt(transport({ loop }), 103.5, 60)).toBeCloseTo(11.5, 9);
    expect(songTimeAt(transport({ loop }), 107.5, 60)).toBeCloseTo(11.5, 9);
    expect(songTimeAt(transport({ loop, song_time_s: 20 }), 104, 60)).toBe(24);
  });

  it("stands while a count-in is on, and runs when it is over", () => {
    const counted = transport({ count_in_s: 2, rate: 0.5 });
    expect([100, 103, 104, 105].map((at) => songTimeAt(counted, at, 60))).toEqual([10, 10, 10, 10.5]);
    expect([100, 103, 104, 105].map((at) => countInAt(counted, at))).toEqual([2, 0.5, 0, 0]);
    expect(countInAt({ ...counted, playing: false }, 100)).toBe(0);
  });

  it("counts in each further round of a loop", () => {
    const looping = transport({ loop: { start_s: 9, end_s: 11, count_in_s: 1 } });
    const times = [100.5, 101, 101.5, 102, 103.5, 104, 104.5, 105.5];
    expect(times.map((at) => songTimeAt(looping, at, 60))).toEqual([10.5, 9, 9, 9, 10.5, 9, 9, 9.5]);
    expect(times.map((at) => countInAt(looping, at))).toEqual([0, 1, 0.5, 0, 0, 1, 0.5, 0]);
  });
});
