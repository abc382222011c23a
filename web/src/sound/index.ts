export { audioLength } from "./audio-length";
export { loadSong } from "./song-loader";
export { SongPlayer, type SongTime, type SoundState } from "./song-player";
