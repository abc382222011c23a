/** Where the lanes of several players lie, so that none crosses another or a player's face. */

import { LANE } from "./lane";

/** How large lanes are drawn where so many play, as a share of one that is alone. */
const SCALES = [1, 1, 0.86, 0.86, 0.76] as const;

/** From the middle of one lane to the next at full size, metres: a staff, and room for ledger lines. */
const SPACING = 0.4;

/** Height of the topmost ribbon where several play, metres: under the faces. */
const TOP = 1.5;

export interface LaneArrangement {
  readonly scale: number;
  /** Height that each player's ribbon goes to, metres. */
  readonly heights: readonly number[];
  /** How far up the desk each player's lane lies from its middle, metres. */
  readonly shifts: readonly number[];
}

/**
 * Arrange the lanes of players.
 *
 * Ribbons run to the audience's right, past whoever stands there: the farther left a player, the lower the ribbon, so
 * that it passes below the others' instruments. On the desk the lanes lie as staves in a score, the first player's on top.
 *
 * @param places of the players across the stage, metres; positive is the audience's right.
 */
export function arrangeLanes(places: readonly number[]): LaneArrangement {
  const count = places.length;
  const scale = SCALES[Math.min(count, SCALES.length - 1)] ?? 1;
  if (count < 2) return { scale, heights: [LANE.bell.height], shifts: [0] };
  const spacing = SPACING * scale;
  const toTheRight = (i: number): number =>
    places.filter((place, j) => place > (places[i] ?? 0) || (place === places[i] && j > i)).length;
  return {
    scale,
    heights: places.map((_, i) => TOP - toTheRight(i) * spacing),
    shifts: places.map((_, i) => ((count - 1) / 2 - i) * spacing),
  };
}
