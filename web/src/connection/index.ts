export { ClockSync } from "./clock-sync";
export { FrameQueue, type QueuedFrame } from "./frame-queue";
export { ProblemError } from "./problem";
export { ReinaApi, type SessionFiles } from "./rest";
export { countInAt, songTimeAt } from "./song-time";
export { Stream, streamAddress, type StreamListener, type StreamState } from "./stream";
