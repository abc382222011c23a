import { words } from "../words";

/** What the camera's views are called, by their names. */
export const viewNames = words("view-names", {
  whole_figure: "Whole figure",
  three_quarter: "Three-quarter",
  valves: "Valves",
  face: "Face",
  player: "Player's view",
  hall: "Hall",
  kit_behind: "Behind the drummer",
  kit_overhead: "Overhead",
  kit_hi_hat: "Hi-hat",
  kit_feet: "Feet",
});
