import type { Loop } from "../generated/protocol";

/** How a song is cut into segments; times in seconds. */
export interface SongShape {
  readonly duration: number;
  /** Segment n begins at n times this; the last is shorter. */
  readonly segmentLength: number;
}

/** What one AudioBufferSource plays: song from one place to another within a segment. */
export interface Part {
  readonly segment: number;
  readonly begin: number;
  readonly end: number;
  /** The song goes on in the next segment, which is faded over to. */
  readonly joinsNext: boolean;
}

/** Places closer than this are the same: far less than a sample, far more than a double's rounding. */
const SAME_S = 1e-7;

/** The segment that a place in the song lies in. */
export function segmentAt(position: number, { segmentLength }: SongShape): number {
  return Math.max(Math.floor((position + SAME_S) / segmentLength), 0);
}

/** What is to be played from a place on, up to a segment's, a loop's or the song's end; null behind the song's. */
export function partFrom(position: number, loop: Loop | null, song: SongShape): Part | null {
  if (position >= song.duration - SAME_S) return null;
  const segment = segmentAt(position, song);
  const segmentEnd = (segment + 1) * song.segmentLength;
  const last = Math.min(song.duration, loop !== null && position < loop.end_s ? loop.end_s : Infinity);
  return { segment, begin: position, end: Math.min(segmentEnd, last), joinsNext: segmentEnd < last - SAME_S };
}

/**
 * The segments that will be needed, the most urgent first: where the song is, what follows, and a loop's begin.
 *
 * @param ahead how many beyond the first
 */
export function segmentsAhead(position: number, loop: Loop | null, song: SongShape, ahead: number): readonly number[] {
  const first = segmentAt(position, song);
  const inLoop = loop !== null && position < loop.end_s;
  const end = Math.min(inLoop ? loop.end_s : Infinity, song.duration);
  const wanted: number[] = [];
  for (let segment = first; segment <= first + ahead && segment * song.segmentLength < end - SAME_S; segment += 1) {
    wanted.push(segment);
  }
  if (inLoop) {
    const back = segmentAt(loop.start_s, song);
    if (loop.start_s < song.duration && !wanted.includes(back)) wanted.push(back);
  }
  return wanted;
}
