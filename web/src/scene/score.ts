/** The score as the stage draws it: the notes that are played and the bar lines. */

/** How percussion plays a note: with a hand or with a foot; the other is null. */
export interface Strike {
  readonly type: "strike";
  readonly hand: "left" | "right" | null;
  readonly foot: "left" | "right" | null;
  readonly piece: string;
}

export interface ScoreNote {
  /** Seconds from the start of the score. */
  readonly onset_s: number;
  readonly duration_s: number;
  /** MIDI number as the player reads it. */
  readonly written_pitch: number;
  /** The valves that are down; [] is open, null is not playable. */
  readonly valves: readonly number[] | null;
  /** How it is played, by the kind of instrument; null where it is not. */
  readonly fingering?: Strike | { readonly type: "valves" | "slide" | "keys" } | null;
  /** Who plays it: a place in the cast, 0 being the first; its block lies in that player's lane. */
  readonly player: number;
}

/** Valves of a note that is played, but whose block does not say how. */
export const UNTOLD: readonly number[] = [7];

export interface ScoreView {
  /** Of the played parts alone. */
  readonly notes: readonly ScoreNote[];
  /** Seconds from the start of the score. */
  readonly bar_lines_s: readonly number[];
  /** How many play; each has a lane. */
  readonly players: number;
}

type WireScore = Pick<ScoreView, "bar_lines_s"> & {
  readonly notes: readonly (Omit<ScoreNote, "player"> & { readonly player: number | null })[];
};

/** What of a score is played, for so many players. */
export function playedScore(score: WireScore, players: number): ScoreView {
  const isPlayed = (note: WireScore["notes"][number]): note is ScoreNote =>
    note.player !== null && note.player < players;
  return { notes: score.notes.filter(isPlayed), bar_lines_s: score.bar_lines_s, players };
}
