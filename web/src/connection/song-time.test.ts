import { describe, expect, it } from "vitest";
import type { TransportState } from "../generated/protocol";
import { songTimeAt } from "./song-time";

function transport(change: Partial<TransportState>): TransportState {
  return { playing: true, song_time_s: 10, server_time_s: 100, rate: 1, loop: null, epoch: 1, ...change };
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
    const loop = { start_s: 11, end_s: 13 };
    expect(songTimeAt(transport({ loop }), 102.5, 60)).toBeCloseTo(12.5, 9);
    expect(songTimeAt(transport({ loop }), 103.5, 60)).toBeCloseTo(11.5, 9);
    expect(songTimeAt(transport({ loop }), 107.5, 60)).toBeCloseTo(11.5, 9);
    expect(songTimeAt(transport({ loop, song_time_s: 20 }), 104, 60)).toBe(24);
  });
});
