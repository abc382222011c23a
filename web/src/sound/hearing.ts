/** What of a rendered song this page hears. */
export interface Hearing {
  /** The part apart from the rest, so that the two can be weighed against each other. */
  readonly apart: boolean;
  /** Whose part, a place in the cast. */
  readonly player: number;
  /** Semitones by which all but the drums sounds higher. */
  readonly semitones: number;
}

export const MOST_SEMITONES = 12;
export const AS_WRITTEN: Hearing = { apart: false, player: 0, semitones: 0 };

/** What the server is asked for, a query each: one song, or the part and the rest. */
export function queriesOf({ apart, player, semitones }: Hearing): readonly string[] {
  const moved = semitones === 0 ? "" : `semitones=${semitones}`;
  if (!apart) return [moved === "" ? "" : `?${moved}`];
  return ["part", "rest"].map((stem) => `?stem=${stem}&player=${player}${moved === "" ? "" : `&${moved}`}`);
}

/** Whether it is the song that everybody has. */
export function isAsWritten({ apart, semitones }: Hearing): boolean {
  return !apart && semitones === 0;
}
