import type { Score } from "../../generated/protocol";
import { barIndexAt, firstBarNumber } from "../../state/score-time";
import type { TimeAxis } from "./time-axis";

/** A song time as bar and beat with its fraction: `5 · 2.5`; beats are quarter notes, counted from 1. */
export function placeText(score: Score, axis: TimeAxis, songTime: number): string {
  const index = barIndexAt(score.bar_lines_s, songTime);
  const begin = axis.beatsAt(score.bar_lines_s[index] ?? 0);
  const beat = Number((axis.beatsAt(songTime) - begin + 1).toFixed(3));
  return `${index + firstBarNumber(score)} · ${beat}`;
}

/** The song time, seconds, of what was typed: `5`, `5·2`, `5 2.5`, `5.2.5`; null where it says none. */
export function placeTyped(score: Score, axis: TimeAxis, text: string): number | null {
  const found = /^\s*(\d+)(?:\s*[·:.,\s]\s*(\d+(?:[.,]\d+)?))?\s*$/.exec(text);
  if (found === null) return null;
  const index = Number(found[1]) - firstBarNumber(score);
  const beat = Number((found[2] ?? "1").replace(",", ".")) - 1;
  if (index < 0 || beat < 0) return null;
  const begin = axis.beatsAt(axis.toSongTime("bars", index));
  return axis.secondsAt(begin + beat);
}
