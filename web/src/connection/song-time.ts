import type { TransportState } from "../generated/protocol";

/**
 * Song time at a moment of the server's clock, both in seconds, as the transport's last state has it.
 *
 * A loop is entered by playing into it; a clock that stands behind its end runs on to the end of the song.
 */
export function songTimeAt(transport: TransportState, serverTime: number, duration: number): number {
  const { playing, song_time_s: from, server_time_s: at, rate, loop } = transport;
  if (!playing) return from;
  const time = from + Math.max(serverTime - at, 0) * rate;
  if (loop !== null && from < loop.end_s && time >= loop.end_s) {
    return loop.start_s + ((time - loop.start_s) % (loop.end_s - loop.start_s));
  }
  return Math.min(time, Math.max(duration, from));
}
