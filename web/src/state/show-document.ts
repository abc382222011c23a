import type { Score } from "../generated/protocol";
import { beatsAt } from "./score-time";

/** A show as its JSON has it; what the page does not edit is carried along as it stands. */
export interface ShowDocument {
  readonly version: number;
  readonly title: string;
  readonly time: TimeUnit;
  readonly tracks: readonly ShowTrack[];
}

export type TimeUnit = "seconds" | "beats" | "bars";

export interface ShowTrack {
  readonly parameter: string;
  /** The unit of its keyframes' times; the show's where it names none. */
  readonly time?: TimeUnit;
  readonly muted?: boolean;
  readonly keyframes: readonly ShowKeyframe[];
}

export interface ShowKeyframe {
  readonly key: string;
  readonly time: number;
  readonly value: unknown;
  readonly interpolation: string;
}

type ScoreTime = Pick<Score, "tempi" | "bar_lines_s">;

/** A song time, seconds, in a track's unit. */
export function toTrackTime(score: ScoreTime, unit: TimeUnit, songTime: number): number {
  if (unit === "seconds") return songTime;
  if (unit === "beats") return beatsAt(score.tempi, songTime);
  const { index, from, to } = barAround(score.bar_lines_s, (line) => line <= songTime + 1e-9);
  const beats = [songTime, from, to].map((time) => beatsAt(score.tempi, time)) as [number, number, number];
  return index + (beats[0] - beats[1]) / (beats[2] - beats[1]);
}

/** A time in a track's unit as song time, seconds. */
export function toSongTime(score: ScoreTime, unit: TimeUnit, time: number): number {
  if (unit === "seconds") return time;
  if (unit === "beats") return secondsAt(score, time);
  const { index, from, to } = barAround(score.bar_lines_s, (_, place) => place <= time + 1e-9);
  const [first, last] = [beatsAt(score.tempi, from), beatsAt(score.tempi, to)];
  return secondsAt(score, first + (time - index) * (last - first));
}

function secondsAt(score: ScoreTime, beats: number): number {
  const tempo = score.tempi.findLast((each) => each.onset_beats <= beats + 1e-9) ?? score.tempi[0];
  return tempo === undefined ? beats / 2 : tempo.onset_s + ((beats - tempo.onset_beats) * 60) / tempo.bpm;
}

/** The last bar that begins where `begun` holds; behind the last bar line bars are as long as the last. */
function barAround(
  lines: readonly number[],
  begun: (line: number, place: number) => boolean,
): { index: number; from: number; to: number } {
  if (lines.length < 2) return { index: 0, from: lines[0] ?? 0, to: (lines[0] ?? 0) + 2 };
  const index = Math.min(Math.max(lines.findLastIndex(begun), 0), lines.length - 2);
  return { index, from: lines[index] ?? 0, to: lines[index + 1] ?? 1 };
}
