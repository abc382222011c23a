import { filled, words } from "../words";

/** Views, light and quality. */
export const views = words("views", {
  title: "Views and light",
  panel: "views and light",
  camera: "Camera",
  showCamera: "The show's",
  inset: "Valves in a small picture",
  insetFeet: "Feet in a small picture",
  light: "Light",
  lighting: filled("Lighting: {mood}"),
  takingBack: "Taking the light back",
  backToBefore: "Back to the light before",
  lightMeans: "It lights the whole piece, in place of the show's own lights. Undo is in the show, too.",
  lightForbidden: "Whoever opened this session chooses its light.",
  quality: "Quality",
  automatic: "Automatic",
  full: "Full",
  medium: "Medium",
  low: "Low",
});
