import type { Score } from "../generated/protocol";
import type { Piece } from "../sound";
import { clicksBetween, countInClicks, countInLength, type Click, type Division } from "./beats";
import { remember, remembered } from "./storage";

export type CountInBars = 0 | 1 | 2;

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

  /** Song seconds that are counted in before it plays from a place on. */
  countInTo(score: Score, place: number): number {
    return countInLength(score, place, this.countInBars);
  }

  /** Song seconds that are counted in before each further round of a loop that begins at a place. */
  countInOfRounds(score: Score, place: number): number {
    return this.countInRounds ? countInLength(score, place, this.countInBars) : 0;
  }

  /**
   * What is clicked in a piece of what is played: a count-in is, wherever somebody hears the song.
   *
   * @param heard the page's sound is on.
   */
  clicksIn(score: Score, { from, to, countsTo }: Piece, heard: boolean): readonly Click[] {
    if (countsTo === null) return this.metronome ? clicksBetween(score, from, to, this.division) : [];
    if (!this.metronome && !heard) return [];
    const division = this.metronome ? this.division : "beats";
    return countInClicks(score, countsTo, countsTo - from, division).filter(({ songTime }) => songTime < to - 1e-6);
  }
}
