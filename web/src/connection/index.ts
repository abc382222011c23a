export { BlockFeed } from "./block-feed";
export { type PlayedFrame } from "./block-player";
export { ClockSync } from "./clock-sync";
export { GivenUpError, ProblemError } from "./problem";
export { QuietProbes } from "./quiet-probes";
export { ReinaApi, type SessionFiles } from "./rest";
export { type Sending } from "./sending";
export { countInAt, songTimeAt } from "./song-time";
export { Stream, streamAddress, type StreamListener, type StreamState } from "./stream";
