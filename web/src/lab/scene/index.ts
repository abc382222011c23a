export { ChainFigure } from "./chain-figure";
export { ClipFigure } from "./clip-figure";
export { type Drag, dragging } from "./drag";
export { RotationFigure } from "./rotation-figure";
export { type Figure, type Insets, LabUnavailableError, LabView } from "./view";
