import { words } from "../words";

/** What easings, kinds of values and settings are called; words of paths stand in editor-parameters. */
export const names = words("editor-names", {
  step: "jump",
  straight: "straight",
  cubic_bezier: "own curve",
  cubic_spline: "own slopes",
  automatic: "smooth",
  clamped: "smooth, never beyond",
  boolean: "on or off",
  choice: "choice",
  color: "colour",
  number: "number",
  orientation: "turn",
  transform: "place and turn",
  vector: "three numbers",
  amplitude: "Swing",
  handles: "Handles",
  overshoot: "Goes beyond by",
  period: "Swing's length",
  bloom: "glow",
  fov: "angle of view",
});
