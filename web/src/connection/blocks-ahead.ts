import type { TransportState } from "../generated/protocol";
import { blockOf } from "./packed-block";
import { frameOf, songTimeAt } from "./song-time";

/** So far it is looked ahead, seconds of the server's clock. */
export const AHEAD_S = 2.5;
/** At four times the tempo a block lasts five of these. */
const STEP_S = 0.05;

/** A block that the picture comes to. */
export interface NeededBlock {
  readonly number: number;
  /** Seconds from now until it does; 0 where it is there. */
  readonly comes: number;
}

/**
 * Which blocks the picture comes to next, each once, in the order of need, along loops and over count-ins.
 *
 * @param serverTime now
 */
export function blocksAhead(
  transport: TransportState,
  serverTime: number,
  duration: number,
  fps: number,
): readonly NeededBlock[] {
  const needed: NeededBlock[] = [];
  for (let comes = 0; comes <= AHEAD_S; comes += STEP_S) {
    const number = blockOf(frameOf(songTimeAt(transport, serverTime + comes, duration), fps));
    if (!needed.some((one) => one.number === number)) needed.push({ number, comes });
  }
  return needed;
}
