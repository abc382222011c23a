import type { ShowParameter } from "../../generated/protocol";
import type { CameraView } from "../../scene";
import { copied, freshKey, pasted, type Copied } from "../state/clipboard";
import type { Editor } from "../state/editor.svelte";
import { withEdits, type Changes, type Edit } from "../state/edits";
import { nearest } from "../state/key-times";
import { hasCurve } from "../state/component-values";
import { shownPath } from "../state/names";
import { valueOf } from "../state/parameter-value";
import { groupOf } from "../state/rows";
import { byTrack, keysOf } from "../state/selection.svelte";
import { trackOf, type ShowTrack } from "../state/show-document";
import { movedBy, stretched, type Retiming } from "../state/spans";
import { does } from "../../words/editor-does/en";

/** What was copied last, on whatever session. */
let clipboard: Copied | null = null;

/** How many keyframes were copied. */
export function copiedCount(): number {
  return clipboard?.count ?? 0;
}

/** Put a keyframe of each parameter at a song time; one that stands there takes the value instead. */
function keysHere(
  editor: Editor,
  values: readonly (readonly [path: string, value: unknown])[],
  at = editor.playhead,
): void {
  const { document } = editor.store;
  if (document === null) return;
  const keys: [string, string][] = [];
  const edits = values.map(([parameter, value]): Edit => {
    const track = editor.track(parameter);
    const there = track === null ? null : keyNear(editor, track, at);
    if (there !== null) {
      keys.push([parameter, there]);
      return { edit: "change_keyframe", parameter, key: there, changes: { value } };
    }
    const key = freshKey();
    keys.push([parameter, key]);
    const time = editor.axis.toTrackTime(track === null ? document.time : editor.times.unitOf(track), at);
    return { edit: "add_keyframe", parameter, keyframe: { key, time, value, ...wayTo(editor, track, parameter, at) } };
  });
  editor.edit(does.keyAdded({ count: values.length }), edits);
  editor.selection.set(keys);
}

/** The keyframe within half a frame of a song time. */
function keyNear(editor: Editor, track: ShowTrack, at: number): string | null {
  const times = editor.times.of(track);
  const index = nearest(times, at);
  const time = times[index];
  return time !== undefined && Math.abs(time - at) < 0.5 / editor.fps ? (track.keyframes[index]?.key ?? null) : null;
}

/** A new keyframe is come to as the one before it is; the first straight, or by a step where nothing else is possible. */
function wayTo(editor: Editor, track: ShowTrack | null, path: string, at: number): { interpolation: string } {
  const known = editor.parameter(path)?.interpolations ?? [];
  const times = track === null ? null : editor.times.of(track);
  const before = times === null ? undefined : track?.keyframes[times.findLastIndex((time) => time < at)];
  const way = before?.interpolation;
  const plain = way === "cubic_spline" ? "automatic" : way;
  if (plain !== undefined && known.includes(plain)) return { interpolation: plain };
  return { interpolation: known.includes("linear") ? "linear" : (known[0] ?? "step") };
}

/** A keyframe at the playhead on the track that is looked at, with the value on screen. */
export function addKeyHere(editor: Editor, path = editor.active): void {
  const parameter = path === null ? null : editor.parameter(path);
  if (parameter === null) {
    editor.reina.word(does.chooseTrack, does.thenEnter, {
      over: () => editor.active !== null,
    });
    return;
  }
  editor.toggleGroup(groupOf(parameter.path), true);
  keysHere(editor, [[parameter.path, editor.valueNow(parameter)]]);
  editor.look(parameter.path);
}

/** A keyframe on a track at a song time, seconds, with the value that its keyframes give it there. */
export async function addKeyAt(editor: Editor, path: string, at: number): Promise<void> {
  const parameter = editor.parameter(path);
  const track = editor.track(path);
  if (parameter === null || track === null || !editor.editable) return;
  try {
    const value = await valueThere(editor, track, parameter, at);
    keysHere(editor, [[path, value]], at);
    editor.look(path);
  } catch (error) {
    editor.reina.tell(error);
  }
}

/** The value of a track at a song time without its answer to the music, as the server samples it. */
async function valueThere(editor: Editor, track: ShowTrack, parameter: ShowParameter, at: number): Promise<unknown> {
  if (hasCurve(parameter)) {
    const { document } = editor.store;
    const silent: Edit = { edit: "change_track", parameter: parameter.path, changes: { events: null } };
    const draft = document === null ? null : withEdits(document, [silent], editor.axis);
    const alone = trackOf(draft, parameter.path) ?? track;
    const span = [at, at + 1 / editor.fps, 2] as const;
    // Of a track that is too long to be sent the server knows what it has.
    const curve =
      (await editor.curves.preview(alone, ...span)) ?? (await editor.curves.ofKeys(parameter.path, ...span));
    const values = curve?.values.map(([first = 0]) => Number(first.toPrecision(6)));
    if (values !== undefined) return valueOf(parameter, values);
  }
  // What has no curve jumps: it is what the keyframe before says.
  const before = editor.times.of(track).findLastIndex((time) => time <= at);
  return track.keyframes[Math.max(before, 0)]?.value ?? parameter.default;
}

/** Choose the keyframes of some tracks, all of them or those from a song time on. */
export function chooseKeys(editor: Editor, tracks: readonly ShowTrack[], from = -Infinity): void {
  editor.selection.set(
    tracks.flatMap((track) => {
      const times = editor.times.of(track);
      const keys = track.keyframes.filter((_, index) => (times[index] ?? 0) >= from);
      return keys.map(({ key }) => [track.parameter, key] as const);
    }),
  );
  editor.said = does.chosen({ count: editor.selection.size });
}

/** Keyframes of the camera's four tracks from a view, as one step. */
export function addCameraKeys(editor: Editor, view: CameraView): void {
  keysHere(editor, [
    ["camera/position", view.position.map(short)],
    ["camera/target", view.target.map(short)],
    ["camera/fov", short(view.fov)],
    ["camera/roll", short(view.roll)],
  ]);
  editor.look("camera/position");
}

function short(value: number): number {
  return Number(value.toFixed(5));
}

/** Choose the keyframes of all tracks, or of those that are sought. */
export function selectAll(editor: Editor): void {
  const { found, known } = editor;
  chooseKeys(editor, found === null ? known : known.filter(({ parameter }) => found.has(parameter)));
}

export function removeKeys(editor: Editor): void {
  const edits = editor.chosen.map(({ track, keyframe }): Edit => {
    return { edit: "remove_keyframe", parameter: track.parameter, key: keyframe.key };
  });
  const paths = [...new Set(editor.chosen.map(({ track }) => track.parameter))];
  const count = edits.length;
  const says =
    paths.length > 1
      ? does.keyRemovedOf({ count, tracks: paths.length })
      : does.keyRemoved({ count, track: shownPath(paths[0] ?? "") });
  editor.remove(says, edits);
  editor.selection.clear();
}

export function copyKeys(editor: Editor): void {
  const taken = copied(editor.axis, editor.times, editor.chosen);
  if (taken === null) return;
  clipboard = taken;
  editor.said = does.keyCopied({ count: taken.count });
}

export function cutKeys(editor: Editor): void {
  copyKeys(editor);
  removeKeys(editor);
}

/** Put what was copied at the playhead: on the track that is looked at where it came from one of the same type. */
export function pasteKeys(editor: Editor, at = editor.playhead, from = clipboard, ontoActive = true): void {
  const { document } = editor.store;
  if (document === null || from === null) return;
  const source = from.tracks[0] === undefined ? null : editor.parameter(from.tracks[0].parameter);
  const target = editor.active === null ? null : editor.parameter(editor.active);
  const onto =
    ontoActive && from.tracks.length === 1 && target !== null && target.type === source?.type ? target.path : null;
  const { edits, keys } = pasted(editor.axis, editor.times, document, from, at, onto);
  editor.edit(does.keyPasted({ count: keys.length }), edits);
  editor.selection.set(keys);
}

/** The chosen keyframes once more, whole bars later. */
export function duplicateKeys(editor: Editor): void {
  const { axis, span } = editor;
  const taken = copied(axis, editor.times, editor.chosen);
  if (taken === null || span === null) return;
  const from = axis.beatsAt(span.start);
  const bar = axis.barLengthAt(from);
  const bars = Math.max(Math.ceil((axis.beatsAt(span.end) - from) / bar + 1e-6), 1);
  pasteKeys(editor, axis.secondsAt(from + bars * bar), taken, false);
}

/** Take the chosen keyframes to other times, and with them what they are one cut with. */
export function retime(editor: Editor, says: string, retiming: Retiming): void {
  const { about, factor, by } = retiming;
  if (editor.chosen.length === 0 || (factor === 1 && by === 0)) return;
  editor.edit(says, [
    { edit: "move_keyframes", keyframes: carriedKeys(editor), time: "beats", by, stretch: { about, factor } },
  ]);
}

/** The keys that move with the chosen ones, as an edit names them: those that are still there. */
export function carriedKeys(editor: Editor): Record<string, string[]> {
  const moved = byTrack(keysOf(editor.store.document, editor.carried));
  return Object.fromEntries([...moved].map(([track, keyframes]) => [track.parameter, keyframes.map(({ key }) => key)]));
}

/** Move the chosen keyframes so that their first comes to a song time, seconds. */
export function moveTo(editor: Editor, songTime: number): void {
  const { span } = editor;
  if (span !== null)
    retime(editor, does.keyMoved({ count: editor.chosen.length }), movedBy(editor.axis, span.start, songTime));
}

/** Stretch the chosen keyframes so that their last comes to a song time, seconds. */
export function stretchTo(editor: Editor, songTime: number): void {
  const { span } = editor;
  if (span === null || span.end <= span.start) return;
  retime(
    editor,
    does.keyStretched({ count: editor.chosen.length }),
    stretched(editor.axis, span.start, span.end, songTime),
  );
}

export type NudgeStep = "frame" | "beat" | "bar";

/** Move the chosen keyframes a little. */
export function nudge(editor: Editor, step: NudgeStep, direction: 1 | -1): void {
  const { axis, span } = editor;
  if (span === null) return;
  const beats = axis.beatsAt(span.start);
  const to =
    step === "frame"
      ? span.start + direction / editor.fps
      : axis.secondsAt(beats + direction * (step === "bar" ? axis.barLengthAt(beats) : 1));
  moveTo(editor, Math.max(to, editor.lead));
}

/** Change the chosen keyframes alike, as far as their parameters take it. */
export function changeKeys(editor: Editor, says: string, changes: Changes): void {
  const way = changes["interpolation"];
  const edits = editor.chosen.flatMap(({ track, keyframe }): Edit[] => {
    const known = editor.parameter(track.parameter)?.interpolations ?? [];
    if (typeof way === "string" && !known.includes(way)) return [];
    return [{ edit: "change_keyframe", parameter: track.parameter, key: keyframe.key, changes }];
  });
  editor.edit(says, edits);
}
