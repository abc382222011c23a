import type { Changes, Edit } from "../state/edits";
import type { Editor } from "../state/editor.svelte";
import { shownPath } from "../state/names";
import { does } from "../../words/editor-does/en";

/** Change how a track is played; null takes a field back to its default. */
export function setTrack(editor: Editor, path: string, says: string, changes: Changes): void {
  if (editor.track(path) !== null) editor.edit(says, [{ edit: "change_track", parameter: path, changes }]);
}

export function muteTrack(editor: Editor, path: string): void {
  const muted = editor.track(path)?.muted !== true;
  setTrack(editor, path, muted ? does.trackMuted : does.trackOn, { muted });
}

export function soloTrack(editor: Editor, path: string): void {
  const solo = editor.track(path)?.solo !== true;
  setTrack(editor, path, solo ? does.soloOn : does.soloOff, { solo });
}

/** Mute all tracks of a group; all on where all are muted. */
export function muteGroup(editor: Editor, paths: readonly string[]): void {
  const tracks = paths.flatMap((path) => editor.track(path) ?? []);
  const muted = !tracks.every((track) => track.muted === true);
  const edits = tracks
    .filter((track) => (track.muted === true) !== muted)
    .map((track): Edit => ({ edit: "change_track", parameter: track.parameter, changes: { muted } }));
  editor.edit(muted ? does.groupMuted : does.groupOn, edits);
}

export function removeTrack(editor: Editor, path: string): void {
  const track = editor.track(path);
  if (track === null) return;
  const count = track.keyframes.length;
  editor.remove(does.trackRemoved({ track: shownPath(path), count }), [{ edit: "remove_track", parameter: path }]);
  editor.selection.clear();
  if (editor.active === path) editor.look(null);
}
