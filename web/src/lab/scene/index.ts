export { ChainFigure } from "./chain_figure";
export { ClipFigure } from "./clip_figure";
export { type Drag, dragging } from "./drag";
export { RotationFigure } from "./rotation_figure";
export { type Figure, type Insets, LabUnavailableError, LabView } from "./view";
