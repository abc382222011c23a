import type { WireNote } from "../generated/protocol";

/** Whether a note is fingered otherwise than a beginner's chart shows. */
export function isAlternate({ valves, usual_valves }: Pick<WireNote, "valves" | "usual_valves">): boolean {
  return valves !== null && usual_valves !== null && valves.join() !== usual_valves.join();
}
