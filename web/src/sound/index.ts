export { audioLength } from "./audio-length";
export { monoWav } from "./mono-wav";
export { loadSegment, loadWhole, plannedSong, songState } from "./song-loader";
export { sameMotion, SongPlayer, type SongTime, type SoundState } from "./song-player";
export { Metronome } from "./metronome";
export type { Piece } from "./playback-path";
export { SegmentedSong, WholeSong } from "./song-source";
export { soundTone } from "./tone";
