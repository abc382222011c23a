/** The page's colours as the lab draws them on ink: the darker ones lit, so that thin lines stay readable. */

export const INK = "#14171f";
export const PAPER = "#f4efe6";
export const BRASS = "#d9a441";
export const DUSK = "#7f9fd1";
export const RIBBON = "#e0695f";

/** Of the axes x, y, z. */
export const AXIS_COLOURS = { x: RIBBON, y: BRASS, z: DUSK } as const;
export type AxisName = keyof typeof AXIS_COLOURS;
