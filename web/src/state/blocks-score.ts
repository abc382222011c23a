import type { Score } from "../generated/protocol";
import { playedScore, type ScoreView } from "../scene";
import { blockNotes } from "./line-notes";

/** A score as the stage's blocks show it: of each player the line as it is played, the rest faint. */
export function blocksScore(score: Pick<Score, "notes" | "bar_lines_s">, players: number): ScoreView {
  const played = playedScore(score, players);
  return { ...played, notes: blockNotes(played.notes) };
}
