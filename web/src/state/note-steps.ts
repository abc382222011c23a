import type { WireNote } from "../generated/protocol";

type Onset = Pick<WireNote, "onset_s">;

/** What floating point leaves of a time on the grid of frames, in frames. */
const SAME_FRAMES = 1e-6;
const SAME_S = 1e-4;

/**
 * The song time at which a note is looked at, seconds: that of the first frame at its onset or later. Its valves are
 * down by its onset, and those of the next note do not move before it; a later frame of a quick note may show them move.
 *
 * @param fps frames a second of song time.
 */
export function heldAt({ onset_s }: Onset, fps: number): number {
  return Math.ceil(onset_s * fps - SAME_FRAMES) / fps;
}

/**
 * The note to step to from a song time: the next one (1), or the one before (-1), which from within a note is that note
 * itself. Null where there is none.
 *
 * @param line notes by onset, one at a time.
 */
export function stepFrom<T extends Onset>(
  line: readonly T[],
  songTime: number,
  direction: 1 | -1,
  fps: number,
): T | null {
  const at = (note: T): number => heldAt(note, fps);
  const found =
    direction === 1
      ? line.find((note) => at(note) > songTime + SAME_S)
      : line.findLast((note) => at(note) < songTime - SAME_S);
  return found ?? null;
}
