import type { Score } from "../generated/protocol";
import type { Piece } from "../sound";
import { clicksBetween, countInClicks, countInLength, type Click, type Division } from "./beats";
import { remember, remembered } from "./storage";

export type CountInBars = 0 | 1 | 2;

/** A count-in begins this long before its first click, so that each page has heard of it by then. */
const LEAD_S = 0.25;
const SAME_S = 1e-6;

/** How this page practises: its metronome, and how many bars it counts in. None of it outlasts the page but the volume. */
export class PracticeChoices {
  metronome = $state(false);
  division = $state<Division>("beats");
  clickVolume = $state(remembered().clickVolume);
  /** Bars that are counted in before it plays. */
  countInBars = $state<CountInBars>(0);
  /** And before each further round of a loop. */
  countInRounds = $state(false);

  /** Notes that are stepped to are heard. */
  tones = $state(false);

  setClickVolume(volume: number): void {
    this.clickVolume = volume;
    remember({ clickVolume: volume });
  }

  /** Song seconds that are counted in before it plays from a place on, at a rate. */
  countInTo(score: Score, place: number, rate: number): number {
    const length = countInLength(score, place, this.countInBars);
    return length > 0 ? length + LEAD_S * rate : 0;
  }

  /** Song seconds that are counted in before each further round of a loop that begins at a place. */
  countInOfRounds(score: Score, place: number): number {
    return this.countInRounds ? countInLength(score, place, this.countInBars) : 0;
  }

  /**
   * What is clicked in a piece of what is played: a count-in is, wherever somebody hears the song.
   *
   * @param counted song seconds that are counted in, where the piece is of a count-in.
   * @param heard the page's sound is on.
   */
  clicksIn(
    score: Score,
    { from, to, countsTo }: Piece,
    { counted, rate, heard }: { readonly counted: number; readonly rate: number; readonly heard: boolean },
  ): readonly Click[] {
    if (countsTo === null) return this.metronome ? clicksBetween(score, from, to, this.division) : [];
    if (!this.metronome && !heard) return [];
    const division = this.metronome ? this.division : "beats";
    const clicks = countInClicks(score, countsTo, counted, division);
    const first = clicks.findIndex(({ kind }) => kind === "bar");
    const lead = (clicks[first]?.songTime ?? Infinity) - (countsTo - counted);
    return clicks
      .slice(lead <= LEAD_S * rate + SAME_S ? first : 0)
      .filter(({ songTime }) => songTime >= from - SAME_S && songTime < to - SAME_S);
  }
}
