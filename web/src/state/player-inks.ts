/** Colours of the players in the page's panels and strips, by their places in the cast. */
export interface PlayerInk {
  /** Over the page's dark panes. */
  readonly light: string;
  /** A shade of it, for what is to come or past. */
  readonly soft: string;
}

/**
 * Apart in hue and lightness, so that nobody sees two of them as one (after Okabe and Ito 2008); a number always
 * stands beside them. The first is the page's own brass.
 */
export const PLAYER_INKS: readonly PlayerInk[] = [
  { light: "#e8bf6e", soft: "rgb(232 191 110 / 0.62)" },
  { light: "#5aa9f0", soft: "rgb(90 169 240 / 0.72)" },
  { light: "#d9679b", soft: "rgb(217 103 155 / 0.72)" },
  { light: "#a9ecc9", soft: "rgb(169 236 201 / 0.62)" },
];

/** A player's colours. */
export function playerInk(player: number): PlayerInk {
  return PLAYER_INKS[player % PLAYER_INKS.length] ?? { light: "#f4efe6", soft: "rgb(244 239 230 / 0.6)" };
}
