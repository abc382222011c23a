import type { AlignedBar, Alignment, GapDocument } from "../generated/protocol";
import { clockTime } from "../state/readout";
import { list, number } from "../words";
import { inTime } from "../words/intime/en";
import { lineOf } from "./corrections";

/** Below this a bar is worth a look. */
export const UNSURE = 0.5;
/** Of a lead-in and of what is left out, less is not worth a word, seconds. */
const TOLD_S = 0.5;
const TOLD_CENTS = 10;
/** So many stretches of bars are named; what is more is many. */
const NAMED = 6;

/** What was found of a score in its recording, a line each. */
export function factsOf({ alignment, bars, status }: Alignment): string[] {
  if (alignment === null || status !== "found") return [];
  const { count_in = 0, sounds_after = false, transposition = 0, tuning_cents = 0, gaps = [] } = alignment;
  const begins = lineOf(bars.find(({ is_heard }) => is_heard))?.song_s ?? 0;
  const facts: string[] = [];
  if (count_in > 0) facts.push(inTime.countIn({ count: count_in, time: clockTime(begins, true) }));
  else if (begins >= TOLD_S) facts.push(inTime.leadIn({ time: clockTime(begins, true) }));
  if (sounds_after) facts.push(inTime.soundsAfter);
  if (transposition > 0) facts.push(inTime.higher({ count: transposition }));
  if (transposition < 0) facts.push(inTime.lower({ count: -transposition }));
  if (Math.abs(tuning_cents) >= TOLD_CENTS) {
    const cents = number(Math.round(Math.abs(tuning_cents)));
    facts.push(tuning_cents > 0 ? inTime.tunedHigher({ cents }) : inTime.tunedLower({ cents }));
  }
  facts.push(...gaps.flatMap((gap) => gapFacts(gap, bars)));
  const unsure = stretches(bars.map((bar) => bar.is_heard && bar.confidence < UNSURE));
  if (unsure.length > NAMED) facts.push(inTime.manyUnsure);
  else if (unsure.length > 0) facts.push(inTime.unsure({ bars: list(unsure.map((each) => named(each, bars))) }));
  return facts;
}

/** Stretches of places that are so, each with its first and its last. */
export function stretches(flags: readonly boolean[]): (readonly [number, number])[] {
  const found: [number, number][] = [];
  flags.forEach((flag, index) => {
    if (!flag) return;
    const last = found.at(-1);
    if (last?.[1] === index - 1) last[1] = index;
    else found.push([index, index]);
  });
  return found;
}

function gapFacts(gap: GapDocument, bars: readonly AlignedBar[]): string[] {
  const facts: string[] = [];
  if (gap.score_to_s - gap.score_from_s >= TOLD_S) {
    const left = stretches(
      bars.map((bar) => {
        const at = lineOf(bar)?.score_s ?? -1;
        return at >= gap.score_from_s - TOLD_S && at < gap.score_to_s - TOLD_S;
      }),
    );
    const seconds = number(gap.score_to_s - gap.score_from_s, { maximumFractionDigits: 1 });
    facts.push(
      left.length === 0
        ? inTime.secondsLeftOut({ seconds, time: clockTime(gap.song_from_s) })
        : inTime.leftOut({ bars: list(left.map((each) => named(each, bars))), seconds }),
    );
  }
  if (gap.song_to_s - gap.song_from_s >= TOLD_S) {
    facts.push(inTime.putIn({ from: clockTime(gap.song_from_s), to: clockTime(gap.song_to_s) }));
  }
  return facts;
}

function named([first, last]: readonly [number, number], bars: readonly AlignedBar[]): string {
  const [one, other] = [bars[first]?.number ?? 0, bars[last]?.number ?? 0];
  return one === other ? `${one}` : `${one}–${other}`;
}
