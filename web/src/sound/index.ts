export { audioLength } from "./audio-length";
export { loadSegment, loadWhole, plannedSong, songState } from "./song-loader";
export { Metronome } from "./metronome";
export type { Piece } from "./playback-path";
export { SongPlayer, type SongTime, type SoundState } from "./song-player";
export { SegmentedSong, WholeSong } from "./song-source";
export { soundTone } from "./tone";
