import type { Loop, TransportState } from "../generated/protocol";

/** Frames: a song time this close before a frame counts as on it. */
const GRID_TOLERANCE = 1e-6;

/**
 * Song time at a moment of the server's clock, both in seconds, as the transport's last state has it.
 *
 * A loop is entered by playing into it; a clock that stands behind its end runs on to the end of the song. While a
 * count-in is on it stands.
 */
export function songTimeAt(transport: TransportState, serverTime: number, duration: number): number {
  const { playing, song_time_s: from } = transport;
  if (!playing) return from;
  const run = runAt(transport, serverTime);
  const loop = loopAhead(transport);
  if (loop !== null && run >= loop.end_s) {
    const round = loop.count_in_s + loop.end_s - loop.start_s;
    return loop.start_s + Math.max(((run - loop.end_s) % round) - loop.count_in_s, 0);
  }
  return Math.min(Math.max(run, from), Math.max(duration, from));
}

/** Song seconds that are still counted in at a moment of the server's clock; they pass at the transport's rate. */
export function countInAt(transport: TransportState, serverTime: number): number {
  const { playing, song_time_s: from } = transport;
  if (!playing) return 0;
  const run = runAt(transport, serverTime);
  const loop = loopAhead(transport);
  if (loop !== null && run >= loop.end_s) {
    const round = loop.count_in_s + loop.end_s - loop.start_s;
    return Math.max(loop.count_in_s - ((run - loop.end_s) % round), 0);
  }
  return Math.max(from - run, 0);
}

/** The loop whose end playing on comes to; null where there is none. */
export function loopAhead({ loop, song_time_s: from }: TransportState): Loop | null {
  return loop !== null && from < loop.end_s ? loop : null;
}

/** The frame that is on screen at a song time: the last that is not behind it. */
export function frameOf(songTime: number, fps: number): number {
  return Math.floor(songTime * fps + GRID_TOLERANCE);
}

/** Where song time would be without loops, and if what is counted in were song before it. */
function runAt(transport: TransportState, serverTime: number): number {
  const { song_time_s: from, count_in_s: countIn, server_time_s: at, rate } = transport;
  return from - countIn + Math.max(serverTime - at, 0) * rate;
}
