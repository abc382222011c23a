import type { Score } from "../generated/protocol";
import { playedScore, UNTOLD, type ScoreView } from "../scene";
import { blockNotes } from "./line-notes";

/**
 * A score as the stage's blocks show it: of each player the line as it is played, the rest faint.
 *
 * @param untold whether the blocks do not say which valves are down.
 */
export function blocksScore(score: Pick<Score, "notes" | "bar_lines_s">, players: number, untold = false): ScoreView {
  const played = playedScore(score, players);
  const notes = blockNotes(played.notes);
  if (!untold) return { ...played, notes };
  return { ...played, notes: notes.map((note) => (note.valves === null ? note : { ...note, valves: UNTOLD })) };
}
