export { ClockSync } from "./clock-sync";
export { FrameQueue, type QueuedFrame } from "./frame-queue";
export { LeadControl } from "./lead-control";
export { GivenUpError, ProblemError } from "./problem";
export { QuietProbes } from "./quiet-probes";
export { ReinaApi, type SessionFiles } from "./rest";
export { type Sending } from "./sending";
export { countInAt, songTimeAt } from "./song-time";
export { Stream, streamAddress, type StreamListener, type StreamState } from "./stream";
