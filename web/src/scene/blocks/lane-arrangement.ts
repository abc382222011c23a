/** Where the lanes of several players lie, so that none crosses another or a player's face. */

import { LANE } from "./lane";

/** How large lanes are drawn where so many play, as a share of one that is alone. */
const SCALES = [1, 1, 0.86, 0.86, 0.76] as const;

/** From the middle of one lane to the next at full size, metres: a staff, and room for ledger lines. */
const SPACING = 0.4;

/** Height of the topmost ribbon to a kit, metres: above its cymbals, and above the heads of those before it. */
const KIT_TOP = { alone: 1.8, behind: 2.02 } as const;

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
 * that it passes below the others' instruments. Those to a kit run behind everybody, over their heads. On the desk the lanes lie as staves in a score, the first player's on top.
 *
 * @param places of the players across the stage, metres; positive is the audience's right.
 * @param atKits whether each plays at a kit.
 */
export function arrangeLanes(places: readonly number[], atKits: readonly boolean[] = []): LaneArrangement {
  const count = places.length;
  const scale = SCALES[Math.min(count, SCALES.length - 1)] ?? 1;
  const atKit = (i: number): boolean => atKits[i] === true;
  const before = places.filter((_, i) => !atKit(i)).length;
  const spacing = SPACING * scale;
  const toTheRight = (i: number): number =>
    places.filter((place, j) => atKit(j) === atKit(i) && (place > (places[i] ?? 0) || (place === places[i] && j > i)))
      .length;
  const top = (i: number): number => {
    if (atKit(i)) return before > 0 ? KIT_TOP.behind : KIT_TOP.alone;
    return before > 1 ? TOP : LANE.bell.height;
  };
  return {
    scale,
    heights: places.map((_, i) => top(i) - toTheRight(i) * spacing),
    shifts: places.map((_, i) => ((count - 1) / 2 - i) * spacing),
  };
}
