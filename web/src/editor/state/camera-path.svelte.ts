import type { PicturePoint, Place } from "../../scene";
import type { SampledCurve } from "./curves.svelte";
import type { Editor } from "./editor.svelte";
import { withEdits, type Edit } from "./edits";
import { FollowedCurves } from "./followed-curves.svelte";
import { trackOf, type ShowTrack } from "./show-document";
import { does } from "../../words/editor-does/en";

/** What a camera's path is of: where it stands, and where it looks. */
export const PATHS = ["camera/position", "camera/target"] as const;
export type PathName = (typeof PATHS)[number];

/** A stretch of a path between two jumps, as it lies in the picture. */
export interface PathLine {
  readonly name: PathName;
  /** An SVG path's data. */
  readonly data: string;
  /** The playhead is in it. */
  readonly now: boolean;
}

/** A keyframe's mark in the picture. */
export interface PathMark {
  readonly name: PathName;
  readonly key: string;
  readonly time: number;
  readonly chosen: boolean;
  readonly at: PicturePoint;
}

interface Held {
  readonly mark: PathMark;
  readonly keys: ReadonlySet<string>;
  /** Where the key stood. */
  readonly place: Place;
  by: Place;
}

const POINTS_PER_PIXEL = 0.5;
/** A preview while a key is held, at most one in so many milliseconds. */
const PREVIEW_MS = 60;
const NOWHERE: Place = [0, 0, 0];
const DIGITS = 4;

/** The camera's path over the time on screen, as the server samples it and as the stage's picture shows it. */
export class CameraPath {
  readonly #editor: Editor;
  readonly #curves: FollowedCurves;
  #held = $state.raw<Held | null>(null);
  #preview = $state.raw<{ readonly name: string; readonly curve: SampledCurve } | null>(null);
  #previewing = false;
  #wanted: ShowTrack | null = null;
  /** Raised with each picture of the stage. */
  #pictures = $state(0);

  constructor(editor: Editor) {
    this.#editor = editor;
    this.#curves = new FollowedCurves(editor, POINTS_PER_PIXEL);
  }

  /** Whether there is a path to be drawn: it is asked for, and seen from elsewhere than from itself. */
  readonly shown: boolean = $derived.by(() => {
    const { deck, pathShown, active } = this.#editor;
    return deck.cameraTaken && (pathShown || active?.startsWith("camera/") === true);
  });

  /** Whether the curves that are drawn are those of the show as the server has it. */
  get settled(): boolean {
    return this.#curves.settled;
  }

  /** Places that a view of the whole path has in it. */
  readonly places: readonly Place[] = $derived.by(() =>
    PATHS.flatMap((name) => {
      const curve = this.#curves.sampled.get(name);
      return curve === undefined ? [] : (curve.values[0] ?? []).map((_, index) => placeIn(curve, index));
    }),
  );

  readonly lines: readonly PathLine[] = $derived.by(() =>
    this.#pictures < 0 ? [] : PATHS.flatMap((name) => this.#linesOf(name)),
  );

  readonly marks: readonly PathMark[] = $derived.by(() =>
    this.#pictures < 0 ? [] : PATHS.flatMap((name) => this.#marksOf(name)),
  );

  /** Ask for the path while it is to be seen; returns what calls that off. */
  follow(): () => void {
    return this.#curves.follow([...PATHS], () => {
      if (this.#held === null) this.#preview = null;
    });
  }

  /** The stage has drawn a picture. */
  pictureDrawn(): void {
    this.#pictures += 1;
  }

  /** Choose a mark's keyframe, and take it where the show can be changed. */
  take(mark: PathMark, adds: boolean): void {
    const { selection } = this.#editor;
    this.#editor.look(mark.name);
    if (adds) {
      selection.toggle([[mark.name, mark.key]]);
      return;
    }
    if (!selection.has(mark.name, mark.key)) selection.set([[mark.name, mark.key]]);
    const place = this.#placeOf(mark);
    const keys = new Set(selection.byTrack.get(mark.name) ?? []);
    if (place !== null && this.#editor.editable) this.#held = { mark, keys, place, by: NOWHERE };
  }

  /** Move what is held along the picture, by so many pixels from where it was taken. */
  move(right: number, down: number): void {
    const held = this.#held;
    const moved = held === null ? undefined : this.#editor.deck.hands.movedInPicture?.(held.place, right, down);
    if (held === null || moved === undefined) return;
    this.#held = { ...held, by: [moved[0] - held.place[0], moved[1] - held.place[1], moved[2] - held.place[2]] };
    this.#wanted = this.#draft(this.#edits(this.#held), held.mark.name);
    if (!this.#previewing) void this.#readPreviews();
  }

  /** Let go. */
  release(): void {
    const held = this.#held;
    this.#held = null;
    this.#wanted = null;
    if (held === null) return;
    const edits = held.by.some((each) => Math.abs(each) > 10 ** -DIGITS) ? this.#edits(held) : [];
    if (edits.length === 0) this.#preview = null;
    this.#editor.edit(does.someMoved({ count: edits.length }), edits);
  }

  /** Let go and leave the show as it is; returns whether there was anything. */
  cancel(): boolean {
    const was = this.#held !== null;
    this.#held = this.#preview = this.#wanted = null;
    return was;
  }

  #linesOf(name: PathName): PathLine[] {
    const curve = this.#preview?.name === name ? this.#preview.curve : this.#curves.sampled.get(name);
    const count = curve?.values[0]?.length ?? 0;
    if (curve === undefined || count < 2) return [];
    const { window, playhead, deck } = this.#editor;
    const step = (curve.to - curve.from) / (count - 1);
    const jumps = new Set(curve.jumps);
    const lines: PathLine[] = [];
    let [data, begin, drawing] = ["", 0, false];
    const end = (beyond: number): void => {
      const now = playhead >= curve.from + begin * step - step && playhead < curve.from + beyond * step;
      if (data !== "") lines.push({ name, data, now });
      [data, begin, drawing] = ["", beyond, false];
    };
    for (let index = 0; index < count; index += 1) {
      const time = curve.from + index * step;
      if (jumps.has(index)) end(index);
      if (time < window.from - step || time > window.to + step) continue;
      const point = deck.hands.pointOf?.(placeIn(curve, index)) ?? null;
      if (point !== null) data += `${drawing ? "L" : "M"}${point.x.toFixed(1)} ${point.y.toFixed(1)}`;
      drawing = point !== null;
    }
    end(count);
    return lines;
  }

  #marksOf(name: PathName): PathMark[] {
    const { store, times, window, held, deck } = this.#editor;
    const track = trackOf(store.document, name);
    if (track === null) return [];
    const own = times.of(track);
    return track.keyframes.flatMap(({ key, value }, index) => {
      const time = own[index] ?? 0;
      if (time < window.from || time > window.to || !Array.isArray(value)) return [];
      const [x = 0, y = 0, z = 0] = value as number[];
      const by = this.#held?.mark.name === name && this.#held.keys.has(key) ? this.#held.by : NOWHERE;
      const at = deck.hands.pointOf?.([x + by[0], y + by[1], z + by[2]]) ?? null;
      return at === null ? [] : [{ name, key, time, at, chosen: held.get(name)?.has(key) === true }];
    });
  }

  #placeOf({ name, key }: PathMark): Place | null {
    const value = this.#editor.track(name)?.keyframes.find((each) => each.key === key)?.value;
    if (!Array.isArray(value)) return null;
    const [x = 0, y = 0, z = 0] = value as number[];
    return [x, y, z];
  }

  #edits({ mark, keys, by }: Held): Edit[] {
    const keyframes = this.#editor.track(mark.name)?.keyframes.filter(({ key }) => keys.has(key)) ?? [];
    const parameter = this.#editor.parameter(mark.name);
    const [low, high] = [parameter?.minimum ?? -Infinity, parameter?.maximum ?? Infinity];
    return keyframes.map(({ key, value }): Edit => {
      const moved = (value as number[]).map((each, axis) =>
        Number(Math.min(Math.max(each + (by[axis] ?? 0), low), high).toFixed(DIGITS)),
      );
      return { edit: "change_keyframe", parameter: mark.name, key, changes: { value: moved } };
    });
  }

  #draft(edits: readonly Edit[], name: PathName): ShowTrack | null {
    const { document } = this.#editor.store;
    return document === null ? null : trackOf(withEdits(document, edits, this.#editor.axis), name);
  }

  async #readPreviews(): Promise<void> {
    const { window, curves } = this.#editor;
    this.#previewing = true;
    try {
      for (let track = this.#wanted; track !== null; track = this.#wanted) {
        this.#wanted = null;
        const curve = await curves.preview(track, window.from, window.to, window.width * POINTS_PER_PIXEL);
        if (curve !== null && this.#held !== null) this.#preview = { name: track.parameter, curve };
        await new Promise((resolve) => setTimeout(resolve, PREVIEW_MS));
      }
    } catch {
      // The pointer may hold a place that no show can have; the edit itself will say so.
    } finally {
      this.#previewing = false;
    }
  }
}

function placeIn({ values: [x, y, z] }: SampledCurve, index: number): Place {
  return [x?.[index] ?? 0, y?.[index] ?? 0, z?.[index] ?? 0];
}
