import type { TransportState } from "../generated/protocol";
import { BLOCK_FRAMES, type Block } from "./packed-block";

export const SAMPLE_REVISION = "00000000000000aa";

/**
 * A block for tests, of the sample manifest: joints that rest, and the light and the shot as high as the frame's index.
 *
 * @param cuts the frames that are cuts, counted from the block's first
 */
export function sampleBlock(
  number: number,
  { revision = SAMPLE_REVISION, cuts = [] }: { revision?: string; cuts?: readonly number[] } = {},
): Block {
  const bits = new Uint8Array(8);
  for (const cut of cuts) bits[cut >> 3] = (bits[cut >> 3] ?? 0) | (1 << (cut & 7));
  const frames = Array.from({ length: BLOCK_FRAMES }, (_, frame) => {
    const index = number * BLOCK_FRAMES + frame;
    return new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, index, index, 0, 0, 0, 1]);
  });
  return { number, revision, cuts: bits, frames };
}

/** A transport for tests: it plays from 0 at the server time 100. */
export function sampleTransport(change: Partial<TransportState> = {}): TransportState {
  return {
    playing: true,
    song_time_s: 0,
    server_time_s: 100,
    rate: 1,
    loop: null,
    count_in_s: 0,
    epoch: 1,
    ...change,
  };
}
