/** The score as the stage draws it: the played part's notes and the bar lines. */

export interface ScoreNote {
  /** Seconds from the start of the score. */
  readonly onset_s: number;
  readonly duration_s: number;
  /** MIDI number as the player reads it. */
  readonly written_pitch: number;
  /** The valves that are down; [] is open, null is not playable. */
  readonly valves: readonly number[] | null;
}

export interface ScoreView {
  /** Of the played part alone. */
  readonly notes: readonly ScoreNote[];
  /** Seconds from the start of the score. */
  readonly bar_lines_s: readonly number[];
}
