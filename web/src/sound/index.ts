export { audioLength } from "./audio-length";
export { AS_WRITTEN, isAsWritten, queriesOf, type Hearing } from "./hearing";
export { besideEachOther } from "./part-balance";
export { loadSegment, loadWhole, plannedSong, songState } from "./song-loader";
export { SongPlayer, type SongTime, type SoundState } from "./song-player";
export { SegmentedSong, WholeSong } from "./song-source";
