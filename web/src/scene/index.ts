export type { CameraPreset, CameraView } from "./camera-presets";
export { StageUnavailableError } from "./errors";
export { LayoutError, type DrawnFrame } from "./frame";
export type { Insets } from "./framing";
export { measureTier } from "./measure-tier";
export type { ScoreNote, ScoreView } from "./score";
export { Stage, type StageOptions } from "./stage";
export type { Tier } from "./tiers";
export { RigError } from "../rig";
