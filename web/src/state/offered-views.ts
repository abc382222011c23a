import { CAMERA_PRESETS, KIT_VIEWS } from "../scene";
import type { InstrumentSummary } from "../generated/protocol";

/** What of an instrument says which views of its player there are. */
export type ViewFacts = Pick<InstrumentSummary, "valves" | "pieces">;
export type ViewName = (typeof CAMERA_PRESETS)[number]["name"] | (typeof KIT_VIEWS)[number]["name"];

/** The view of the hands at work, which has the same key whatever is played. */
const HANDS = "valves";
const HANDS_AT_KIT = "kit_overhead";

/**
 * The views of who plays an instrument: first those with a key, in the keys' order (null where it has none), then the rest.
 *
 * @param instrument null where that is not known yet: every view is then offered.
 */
export function offeredViews(instrument: ViewFacts | null): readonly (ViewName | null)[] {
  const struck = instrument !== null && instrument.pieces.length > 0;
  const keyed = CAMERA_PRESETS.map(({ name }): ViewName | null => {
    if (name !== HANDS) return name;
    if (struck) return HANDS_AT_KIT;
    return hasValves(instrument) ? name : null;
  });
  return struck ? [...keyed, ...KIT_VIEWS.flatMap(({ name }) => (name === HANDS_AT_KIT ? [] : name))] : keyed;
}

/** What the small picture over the stage shows; null where there is nothing to look at so closely. */
export function insetSubject(instrument: ViewFacts | null): "valves" | "feet" | null {
  if (instrument !== null && instrument.pieces.length > 0) return "feet";
  return hasValves(instrument) ? "valves" : null;
}

function hasValves(instrument: ViewFacts | null): boolean {
  return instrument === null || instrument.valves > 0;
}
