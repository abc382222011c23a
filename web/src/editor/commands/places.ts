import { barBeatAt } from "../../state/score-time";
import { clockTime } from "../../state/readout";
import type { Editor } from "../state/editor.svelte";
import { firstFrom } from "../state/key-times";
import { shownPath } from "../state/names";
import { does } from "../../words/editor-does/en";

/** Less than this is never shown by itself, seconds. */
const ALONE_S = 4;
/** Nearer than this, the playhead stands on a keyframe, seconds. */
const ON_KEY_S = 1e-3;

/** Go to the keyframe before or after the playhead, on the track that is looked at or on any, and choose it. */
export function goToKey(editor: Editor, direction: 1 | -1): void {
  const active = editor.track(editor.active);
  const tracks = active === null ? (editor.store.document?.tracks ?? []) : [active];
  const at = editor.chosen.length === 1 && editor.span !== null ? editor.span.start : editor.playhead;
  let found: { path: string; key: string; time: number } | null = null;
  for (const track of tracks) {
    const times = editor.times.of(track);
    const index = direction === 1 ? firstFrom(times, at + ON_KEY_S) : firstFrom(times, at - ON_KEY_S) - 1;
    const time = times[index];
    const key = track.keyframes[index]?.key;
    if (time === undefined || key === undefined) continue;
    if (found === null || (time - found.time) * direction < 0) found = { path: track.parameter, key, time };
  }
  if (found === null) {
    editor.said = direction === 1 ? does.noneBehind : does.noneBefore;
    return;
  }
  chooseKey(editor, found.path, found.key);
}

/** Choose one keyframe, bring it into view, go there and say what it is. */
export function chooseKey(editor: Editor, path: string, key: string): void {
  const track = editor.track(path);
  const index = track?.keyframes.findIndex((each) => each.key === key) ?? -1;
  const keyframe = track?.keyframes[index];
  if (track === null || keyframe === undefined) return;
  editor.selection.set([[path, key]]);
  editor.look(path);
  const time = editor.songTimeOf({ track, keyframe });
  editor.window.reveal(time);
  if (editor.view.canControl) void editor.view.seek(time);
  editor.said = does.keyAt({
    track: shownPath(path),
    number: index + 1,
    all: track.keyframes.length,
    place: placeName(editor, time),
  });
}

/** A song time as a musician says it. */
export function placeName(editor: Editor, songTime: number): string {
  const { bar, beat } = barBeatAt(editor.view.score, songTime);
  return does.placeAt({ bar, beat, time: clockTime(songTime, true) });
}

/** Show what is chosen, or the whole piece. */
export function showChosen(editor: Editor): void {
  const { span } = editor;
  if (span === null) editor.window.showAll();
  else {
    // One keyframe alone is shown with the music around it.
    const air = Math.max((ALONE_S - (span.end - span.start)) / 2, 0);
    editor.window.show(span.start - air, span.end + air);
  }
}
