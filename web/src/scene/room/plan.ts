/** Measures of the band room, metres: x to the player's left, z to the front, the player at the origin. */

export const ROOM = { halfWidth: 4.4, back: -3.6, front: 9.5, height: 4.7 } as const;

/** Tall windows in both side walls; the sun stands behind those on the key's side. */
export const WINDOWS = {
  /** Centres of the first and how far apart they follow, along z. */
  first: -2.1,
  pitch: 2.15,
  count: 5,
  width: 1.36,
  sill: 0.85,
  head: 4.25,
  /** Panes across and up, and the width of the bars between them. */
  panes: [2, 4],
  bar: 0.055,
} as const;

/** Height of the wooden panelling on the walls. */
export const PANELLING = 1.02;

/** Steps at the back of the room on which rows sit, metres. */
export const RISERS = [{ left: -2.3, right: 1.95, back: ROOM.back, front: -2.3, height: 0.2 }] as const;
