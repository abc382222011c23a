import type * as wire from "../../generated/show";
import { inOtherUnit, rateOf, retimedKeyframes } from "./retime";
import type { ShowDocument, ShowKeyframe, ShowTrack } from "./show-document";
import { round, type TimeAxis } from "./time-axis";

/** What the page sends of what `POST show/edits` takes: keyframes are named, and move in beats. */
export type Edit =
  | Exclude<wire.Edit, wire.AddKeyframe | wire.MoveKeyframes | wire.PutTrack | wire.CopyTrack>
  | (Omit<wire.AddKeyframe, "replace"> & { readonly keyframe: ShowKeyframe })
  | (Omit<wire.MoveKeyframes, "value_by"> & {
      readonly time: "beats";
      readonly by: number;
      readonly stretch: Required<wire.Stretch>;
    })
  | (wire.PutTrack & { readonly track: ShowTrack });

/** Fields of something that change; null takes one back to its default. */
export type Changes = Readonly<Record<string, unknown>>;

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
        this.#head = { title: "", ...withoutNull({ ...this.#head, ...edit.changes }) } as ShowDocument;
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

  /** With another unit the keyframes stay where they are in the music, and all that is told in it gets other numbers. */
  #changeTrack(path: string, changes: wire.TrackChanges): void {
    const track = this.#tracks.get(path);
    if (track === undefined) return;
    const before = this.#unitOf(path);
    const changed = withoutNull({ ...track, ...changes }) as unknown as ShowTrack;
    this.#tracks.set(path, changed);
    const unit = this.#unitOf(path);
    if (unit === before) return;
    const keys = this.#keysOf(path);
    const first = Math.min(...[...keys.values()].map(({ time }) => time));
    for (const [key, keyframe] of keys) keys.set(key, inOtherUnit(this.#axis, before, unit, keyframe));
    if (changed.events === undefined || changes.events !== undefined) return;
    const rate = rateOf(this.#axis, before, unit, Number.isFinite(first) ? first : 0, 1);
    const { attack, hold, decay } = changed.events;
    const lengths = Object.entries({ attack, hold, decay })
      .filter(([, length]) => length !== undefined)
      .map(([name, length]) => [name, round((length ?? 0) * rate)] as const);
    this.#tracks.set(path, { ...changed, events: { ...changed.events, ...Object.fromEntries(lengths) } });
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
