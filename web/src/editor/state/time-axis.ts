import type { Score } from "../../generated/protocol";
import type { TimeUnit } from "./show-document";

type ScoreTime = Pick<Score, "tempi" | "bar_lines_s">;

/** Decimals of a time that the page writes into a show: a bar's millionth is far less than a frame. */
const DECIMALS = 6;

/** A score's three ways to count time, each turned into the others: seconds, quarter notes, bars gone by. */
export class TimeAxis {
  readonly #tempi: Score["tempi"];
  /** Where bars begin, quarter notes, with one bar more behind the last line. */
  readonly #bars: readonly number[];

  constructor(score: ScoreTime) {
    this.#tempi = score.tempi;
    const lines = score.bar_lines_s.map((line) => this.beatsAt(line));
    const first = lines[0] ?? 0;
    this.#bars = lines.length < 2 ? [first, first + 4] : lines;
  }

  /** Quarter notes at a song time, seconds. */
  beatsAt(songTime: number): number {
    const tempo = this.#tempi[lastAtMost(this.#tempi, songTime, onsetSeconds)] ?? this.#tempi[0];
    return tempo === undefined ? songTime * 2 : tempo.onset_beats + ((songTime - tempo.onset_s) * tempo.bpm) / 60;
  }

  /** Song time, seconds, of a place in quarter notes. */
  secondsAt(beats: number): number {
    const tempo = this.#tempi[lastAtMost(this.#tempi, beats, onsetBeats)] ?? this.#tempi[0];
    return tempo === undefined ? beats / 2 : tempo.onset_s + ((beats - tempo.onset_beats) * 60) / tempo.bpm;
  }

  /** A song time, seconds, in a track's unit, as it is written. */
  toTrackTime(unit: TimeUnit, songTime: number): number {
    return round(this.inUnit(unit, songTime));
  }

  /** A song time, seconds, in a unit. */
  inUnit(unit: TimeUnit, songTime: number): number {
    if (unit === "seconds") return songTime;
    const beats = this.beatsAt(songTime);
    if (unit === "beats") return beats;
    const index = this.#barOf(lastAtMost(this.#bars, beats, itself));
    const [from, to] = this.#bar(index);
    return index + (beats - from) / (to - from);
  }

  /** A time in a track's unit as song time, seconds. */
  toSongTime(unit: TimeUnit, time: number): number {
    if (unit === "seconds") return time;
    if (unit === "beats") return this.secondsAt(time);
    const index = this.#barOf(Math.floor(time + 1e-9));
    const [from, to] = this.#bar(index);
    return this.secondsAt(from + (time - index) * (to - from));
  }

  /** Quarter notes that the bar at a place in quarter notes lasts. */
  barLengthAt(beats: number): number {
    const [from, to] = this.#bar(this.#barOf(lastAtMost(this.#bars, beats, itself)));
    return to - from;
  }

  /** Behind the last bar line bars are as long as the last. */
  #barOf(index: number): number {
    return Math.min(Math.max(index, 0), this.#bars.length - 2);
  }

  #bar(index: number): readonly [number, number] {
    return [this.#bars[index] ?? 0, this.#bars[index + 1] ?? 1];
  }
}

/** Index of the last entry whose place is at most `place`; -1 before the first. Entries come in order. */
function lastAtMost<T>(entries: readonly T[], place: number, placeOf: (entry: T) => number): number {
  let low = 0;
  let high = entries.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    const entry = entries[middle];
    if (entry !== undefined && placeOf(entry) <= place + 1e-9) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

const itself = (place: number): number => place;
const onsetSeconds = (tempo: { onset_s: number }): number => tempo.onset_s;
const onsetBeats = (tempo: { onset_beats: number }): number => tempo.onset_beats;

export function round(time: number): number {
  return Number(time.toFixed(DECIMALS));
}
