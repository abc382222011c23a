import { retimedKeyframes } from "./retime";
import type { ShowDocument, ShowKeyframe, ShowMarker, ShowTrack } from "./show-document";
import type { TimeAxis } from "./time-axis";

/** Fields of something that change; null takes one back to its default. */
export type Changes = Readonly<Record<string, unknown>>;

/** One edit of a show, as `POST show/edits` takes it. */
export type Edit =
  | { readonly edit: "add_keyframe"; readonly parameter: string; readonly keyframe: ShowKeyframe }
  | { readonly edit: "change_keyframe"; readonly parameter: string; readonly key: string; readonly changes: Changes }
  | { readonly edit: "remove_keyframe"; readonly parameter: string; readonly key: string }
  | {
      readonly edit: "move_keyframes";
      /** Keys of each parameter's track. */
      readonly keyframes: Readonly<Record<string, readonly string[]>>;
      readonly time: "beats";
      readonly by: number;
      readonly stretch: { readonly about: number; readonly factor: number };
    }
  | { readonly edit: "put_track"; readonly track: ShowTrack }
  | { readonly edit: "change_track"; readonly parameter: string; readonly changes: Changes }
  | { readonly edit: "remove_track"; readonly parameter: string }
  | {
      readonly edit: "change_show";
      readonly changes: { readonly title?: string; readonly markers?: readonly ShowMarker[] };
    };

/** What every keyframe has, whatever its interpolation: all else are options of the one it has. */
const KEYFRAME_FIELDS = ["key", "time", "value", "interpolation", "in_tangent", "out_tangent"];

/**
 * The show as it will stand once the server has made the edits: what the page shows until it has answered.
 *
 * An edit of something that is not there is left out; the server says so.
 */
export function withEdits(document: ShowDocument, edits: readonly Edit[], axis: TimeAxis): ShowDocument {
  const draft = new Draft(document, axis);
  for (const edit of edits) draft.make(edit);
  return draft.finished();
}

/** A show while it is being edited: a track's keyframes are put in order once, at the end. */
class Draft {
  #head: ShowDocument;
  readonly #axis: TimeAxis;
  readonly #tracks: Map<string, ShowTrack>;
  readonly #keyed = new Map<string, Map<string, ShowKeyframe>>();

  constructor(document: ShowDocument, axis: TimeAxis) {
    this.#head = document;
    this.#axis = axis;
    this.#tracks = new Map(document.tracks.map((track) => [track.parameter, track]));
  }

  make(edit: Edit): void {
    switch (edit.edit) {
      case "add_keyframe":
        if (!this.#tracks.has(edit.parameter))
          this.#tracks.set(edit.parameter, { parameter: edit.parameter, keyframes: [] });
        this.#keysOf(edit.parameter).set(edit.keyframe.key, edit.keyframe);
        break;
      case "change_keyframe": {
        const keys = this.#keysOf(edit.parameter);
        const keyframe = keys.get(edit.key);
        if (keyframe !== undefined) keys.set(edit.key, changedKeyframe(keyframe, edit.changes));
        break;
      }
      case "remove_keyframe":
        this.#keysOf(edit.parameter).delete(edit.key);
        break;
      case "move_keyframes":
        for (const [path, keys] of Object.entries(edit.keyframes)) {
          const moved = retimedKeyframes(
            this.#axis,
            this.#unitOf(path),
            [...this.#keysOf(path).values()],
            new Set(keys),
            {
              ...edit.stretch,
              by: edit.by,
            },
          );
          this.#keyed.set(path, new Map(moved.map((keyframe) => [keyframe.key, keyframe])));
        }
        break;
      case "put_track":
        this.#tracks.set(edit.track.parameter, edit.track);
        this.#keyed.delete(edit.track.parameter);
        break;
      case "change_track":
        this.#changeTrack(edit.parameter, edit.changes);
        break;
      case "remove_track":
        this.#tracks.delete(edit.parameter);
        this.#keyed.delete(edit.parameter);
        break;
      case "change_show":
        this.#head = { ...this.#head, ...edit.changes };
        break;
    }
  }

  finished(): ShowDocument {
    for (const [path, keys] of this.#keyed) {
      const track = this.#tracks.get(path);
      if (track === undefined) continue;
      const keyframes = [...keys.values()].sort((a, b) => a.time - b.time);
      // A track that loses its last keyframe and answers no events goes with it.
      if (keyframes.length === 0 && track.events === undefined) this.#tracks.delete(path);
      else this.#tracks.set(path, { ...track, keyframes });
    }
    return { ...this.#head, tracks: [...this.#tracks.values()] };
  }

  #unitOf(path: string) {
    return this.#tracks.get(path)?.time ?? this.#head.time;
  }

  #keysOf(path: string): Map<string, ShowKeyframe> {
    const found = this.#keyed.get(path);
    if (found !== undefined) return found;
    const keys = new Map((this.#tracks.get(path)?.keyframes ?? []).map((keyframe) => [keyframe.key, keyframe]));
    this.#keyed.set(path, keys);
    return keys;
  }

  /** With another unit the keyframes stay where they are in the music, and get other numbers. */
  #changeTrack(path: string, changes: Changes): void {
    const track = this.#tracks.get(path);
    if (track === undefined) return;
    const before = this.#unitOf(path);
    const changed = withoutNull({ ...track, ...changes }) as unknown as ShowTrack;
    this.#tracks.set(path, changed);
    const unit = this.#unitOf(path);
    if (unit === before) return;
    for (const [key, keyframe] of this.#keysOf(path)) {
      const time = this.#axis.toTrackTime(unit, this.#axis.toSongTime(before, keyframe.time));
      this.#keysOf(path).set(key, { ...keyframe, time });
    }
  }
}

/** A show after an answer of the server: the tracks that changed, as it holds them now, and those that are gone. */
export function withTracks(
  document: ShowDocument,
  changed: readonly ShowTrack[],
  removed: readonly string[],
): ShowDocument {
  const tracks = new Map(document.tracks.map((track) => [track.parameter, track]));
  for (const track of changed) tracks.set(track.parameter, track);
  for (const path of removed) tracks.delete(path);
  return { ...document, tracks: [...tracks.values()] };
}

function changedKeyframe(keyframe: ShowKeyframe, changes: Changes): ShowKeyframe {
  const other = "interpolation" in changes && changes["interpolation"] !== keyframe.interpolation;
  const kept = other
    ? Object.fromEntries(Object.entries(keyframe).filter(([name]) => KEYFRAME_FIELDS.includes(name)))
    : keyframe;
  return withoutNull({ ...kept, ...changes }) as unknown as ShowKeyframe;
}

function withoutNull(fields: object): Record<string, unknown> {
  return Object.fromEntries(Object.entries(fields).filter(([, value]) => value !== null && value !== undefined));
}
