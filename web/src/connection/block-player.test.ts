import { describe, expect, it } from "vitest";
import type { TransportState } from "../generated/protocol";
import { BlockPlayer, type PlayedFrame } from "./block-player";
import { sampleBlock, SAMPLE_REVISION, sampleTransport } from "./sample-blocks";
import { SAMPLE_MANIFEST } from "./sample-frames";

const STEP = 1 / 60;
const DURATION = 30;
const EDITED = "00000000000000bb";
/** Where in the floats a frame's index stands: blended, and held. */
const LIGHT = 12;
const SHOT = 13;

/** A player that has some blocks. */
function having(...numbers: number[]): BlockPlayer {
  const player = new BlockPlayer(SAMPLE_MANIFEST, SAMPLE_REVISION);
  for (const number of numbers) player.add(sampleBlock(number));
  return player;
}

/** The picture at some seconds after the transport's own time. */
function at(player: BlockPlayer, seconds: number, transport = sampleTransport(), duration = DURATION): PlayedFrame {
  const frame = player.frameAt(transport, transport.server_time_s + seconds, duration);
  if (frame === null) throw new Error("there was no picture yet");
  return frame;
}

function paused(song_time_s: number): TransportState {
  return sampleTransport({ playing: false, song_time_s });
}

describe("BlockPlayer", () => {
  it("has nothing to draw until the block has come", () => {
    const player = having(1);
    expect(player.frameAt(sampleTransport(), 100, DURATION)).toBeNull();
    expect(player.drawn).toBeNull();
    player.add(sampleBlock(0));
    expect(at(player, 0).index).toBe(0);
    expect(player.drawn).toMatchObject({ index: 0, playing: true, epoch: 1, revision: SAMPLE_REVISION });
  });

  it("draws the frame of the moment asked for, bit for bit", () => {
    const drawn = at(having(0), 0, paused(11 * STEP));
    expect(drawn).toMatchObject({ index: 11, songTime: 11 / 60, playing: false });
    expect([...drawn.floats]).toEqual([...(sampleBlock(0).frames[11] ?? [])]);
  });

  it.each([0.25, 1, 1.7, 4])("blends the two frames around a moment between them at rate %d", (rate) => {
    const drawn = at(having(0, 1), (20.25 * STEP) / rate, sampleTransport({ rate }));
    expect(drawn.index).toBe(20);
    expect(drawn.songTime).toBeCloseTo(20.25 / 60, 9);
    expect(drawn.floats[LIGHT]).toBeCloseTo(20.25, 5);
    expect(drawn.floats[SHOT]).toBe(20);
  });

  it("blends over the end of a block", () => {
    const drawn = at(having(0, 1), 59.5 * STEP);
    expect(drawn.index).toBe(59);
    expect(drawn.floats[LIGHT]).toBeCloseTo(59.5, 5);
    expect(at(having(0), 59.5 * STEP).songTime).toBe(59 / 60);
  });

  it("draws exactly one frame while paused", () => {
    const drawn = at(having(0), 0, paused(20.7 * STEP));
    expect(drawn).toMatchObject({ index: 20, songTime: 20 / 60 });
    expect(drawn.floats[LIGHT]).toBe(20);
    expect(at(having(0), 9, paused(21 * STEP - 1e-9)).index).toBe(21);
  });

  it("does not blend into a cut, and counts it when it is come to", () => {
    const player = new BlockPlayer(SAMPLE_MANIFEST, SAMPLE_REVISION);
    player.add(sampleBlock(0, { cuts: [20, 40] }));
    const { cuts } = at(player, 18 * STEP);
    expect(at(player, 19.9 * STEP)).toMatchObject({ index: 19, songTime: 19 / 60, cuts });
    expect(at(player, 20.1 * STEP)).toMatchObject({ index: 20, cuts: cuts + 1 });
    expect(at(player, 39.5 * STEP).cuts).toBe(cuts + 1);
    expect(at(player, 45 * STEP).cuts).toBe(cuts + 2);
  });

  it("does not blend over a loop's end, and goes on at its start as at a cut", () => {
    const loop = { start_s: 10 * STEP, end_s: 30.5 * STEP, count_in_s: 0 };
    const player = having(0, 1);
    const transport = sampleTransport({ loop });
    const { cuts } = at(player, 29.9 * STEP, transport);
    expect(at(player, 30.4 * STEP, transport)).toMatchObject({ index: 30, songTime: 30 / 60, cuts, playing: true });
    const drawn = at(player, 31 * STEP, transport);
    expect(drawn).toMatchObject({ index: 10, cuts: cuts + 1 });
    expect(drawn.floats[LIGHT]).toBeCloseTo(10.5, 5);
    expect(at(player, 31 * STEP + 7 * 20.5 * STEP, transport).songTime).toBeCloseTo(10.5 / 60, 9);
  });

  it("ends a loop on the grid with the frame before its end", () => {
    const transport = sampleTransport({ loop: { start_s: 0, end_s: 30 * STEP, count_in_s: 0 } });
    expect(at(having(0), 29.8 * STEP, transport).songTime).toBe(29 / 60);
  });

  it("stands at its place while it is counted in, before the song and before a loop's rounds", () => {
    const player = having(0);
    const counted = sampleTransport({ song_time_s: 20 * STEP, count_in_s: 2, rate: 2 });
    expect(at(player, 0.9, counted)).toMatchObject({ index: 20, songTime: 20 / 60, playing: true });
    expect(at(player, 1 + 5 * STEP, counted).index).toBe(30);
    const loop = { start_s: 10 * STEP, end_s: 30 * STEP, count_in_s: 1 };
    const round = sampleTransport({ loop });
    expect(at(player, 30 * STEP + 0.9, round)).toMatchObject({ index: 10, songTime: 10 / 60 });
    expect(at(player, 30 * STEP + 1 + 3.5 * STEP, round).songTime).toBeCloseTo(13.5 / 60, 9);
  });

  it("stands at the song's last frame, and says that it plays no more", () => {
    const duration = 50.5 * STEP;
    expect(at(having(0), 50.4 * STEP, sampleTransport(), duration)).toMatchObject({ songTime: 50 / 60, playing: true });
    expect(at(having(0), 99, sampleTransport(), duration)).toMatchObject({ songTime: 50 / 60, playing: false });
  });

  it("lets the last picture stand where its block is not here, and goes on when it has come", () => {
    const player = having(0);
    at(player, 30 * STEP);
    expect(at(player, 80 * STEP)).toMatchObject({ index: 30 });
    expect(at(player, 0, { ...paused(9), epoch: 2 })).toMatchObject({ index: 30, epoch: 1 });
    player.add(sampleBlock(1));
    expect(at(player, 80 * STEP).index).toBe(80);
  });

  it("draws what is here in a new epoch at once", () => {
    const player = having(0, 5);
    at(player, 0);
    expect(at(player, 0, { ...paused(5), epoch: 2 })).toMatchObject({ index: 300, epoch: 2 });
  });

  it("draws the blocks of before an edit until the present one has come", () => {
    const player = having(0, 1);
    at(player, 0.5);
    player.follow(EDITED);
    const edited = sampleTransport({ epoch: 2 });
    expect(player.has(0)).toBe(false);
    expect(at(player, 0.9, edited)).toMatchObject({ index: 54, epoch: 1, revision: SAMPLE_REVISION });
    player.add(sampleBlock(3, { revision: EDITED }));
    expect(at(player, 1.1, edited)).toMatchObject({ index: 66, epoch: 1 });
    player.add(sampleBlock(1, { revision: EDITED }));
    expect(at(player, 1.2, edited)).toMatchObject({ index: 72, epoch: 2, revision: EDITED });
    // What was of before the edit is gone now.
    expect(at(player, 0.5, edited).index).toBe(72);
  });

  it("draws the last revision that was seen through several edits", () => {
    const player = having(0);
    at(player, 0.2);
    player.follow(EDITED);
    player.follow("00000000000000cc");
    expect(at(player, 0.5)).toMatchObject({ index: 30, revision: SAMPLE_REVISION });
    player.add(sampleBlock(0, { revision: "00000000000000cc" }));
    expect(at(player, 0.6).revision).toBe("00000000000000cc");
  });

  it("ignores blocks of another revision, and keeps all where the same is told again", () => {
    const player = having(0);
    player.follow(SAMPLE_REVISION);
    expect(player.has(0)).toBe(true);
    player.follow(EDITED);
    player.add(sampleBlock(0));
    expect(player.has(0)).toBe(false);
  });

  it("keeps more blocks than the server takes for kept, and of the others those used last", () => {
    const player = having(...Array.from({ length: 32 }, (_, number) => number));
    at(player, 0, paused(0));
    for (let number = 32; number < 62; number++) player.add(sampleBlock(number));
    const kept = Array.from({ length: 62 }, (_, number) => number).filter((number) => player.has(number));
    expect(kept).toEqual([0, 31, ...Array.from({ length: 30 }, (_, i) => 32 + i)]);
  });

  it("gives out the same object each time", () => {
    const player = having(0);
    expect(at(player, 0.1)).toBe(at(player, 0.2));
    expect(player.drawn).toBe(at(player, 0.3));
  });
});
