import type { Editor } from "../state/editor.svelte";
import type { Marker } from "../../generated/show";
import type { Edit } from "../state/edits";
import { does } from "../../words/editor-does/en";

/** A marker at a song time, seconds. */
export function addMarker(editor: Editor, at = editor.playhead): void {
  const { document } = editor.store;
  if (document === null) return;
  const markers = document.markers ?? [];
  const time = editor.axis.toTrackTime(document.time, at);
  const marker = { time, name: does.markerNumber({ number: markers.length + 1 }) };
  put(editor, does.markerAdded, [...markers, marker]);
  editor.marker = (editor.store.document?.markers ?? []).findIndex((each) => each.time === time);
}

/** Take a marker to another song time, seconds. */
export function moveMarker(editor: Editor, index: number, songTime: number): void {
  const { document } = editor.store;
  if (document === null) return;
  change(editor, does.markerMoved, index, { time: editor.axis.toTrackTime(document.time, songTime) });
}

export function nameMarker(editor: Editor, index: number, name: string): void {
  if (name.trim() !== "") change(editor, does.markerNamed, index, { name: name.trim() });
}

export function removeMarker(editor: Editor, index: number): void {
  const markers = editor.store.document?.markers ?? [];
  const marker = markers[index];
  if (marker === undefined) return;
  editor.marker = null;
  editor.remove(does.markerRemoved({ name: marker.name }), [without(markers, marker)]);
}

function without(markers: readonly Marker[], marker: Marker): Edit {
  return { edit: "change_show", changes: { markers: markers.filter((each) => each !== marker) } };
}

function change(editor: Editor, says: string, index: number, changes: Partial<Marker>): void {
  const markers = editor.store.document?.markers ?? [];
  const changed = markers.map((marker, place) => (place === index ? { ...marker, ...changes } : marker));
  const kept = changed[index];
  put(editor, says, changed);
  editor.marker = kept === undefined ? null : (editor.store.document?.markers ?? []).indexOf(kept);
}

function put(editor: Editor, says: string, markers: readonly Marker[]): void {
  editor.edit(says, [{ edit: "change_show", changes: { markers: [...markers].sort((a, b) => a.time - b.time) } }]);
}
