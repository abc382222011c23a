import { valueAt, yOf, type CurvesPlace, type Placed } from "../canvas/draw-curves";
import { carriedKeys } from "../commands/keys";
import { componentsOf, withComponent } from "../state/component-values";
import { handleEdit, handlesOf, type Handle } from "../state/curve-handles";
import type { CurvedTrack, CurveView } from "../state/curve-view.svelte";
import type { Editor } from "../state/editor.svelte";
import { withEdits, type Edit } from "../state/edits";
import { firstFrom } from "../state/key-times";
import { trackOf } from "../state/show-document";
import { movedBy, placed } from "../state/spans";
import type { Press } from "./lane-gestures.svelte";
import { does } from "../../words/editor-does/en";

interface KeyHit {
  readonly shown: CurvedTrack;
  readonly key: string;
  readonly component: number;
  readonly at: Placed;
}

type Held =
  | {
      readonly kind: "key";
      readonly hit: KeyHit;
      readonly begin: Press;
      readonly alone: boolean;
      moved: boolean;
      time: number;
      by: number;
    }
  | {
      readonly kind: "handle";
      readonly shown: CurvedTrack;
      readonly handle: Handle;
      readonly begin: Press;
      edit: Edit | null;
    };

const REACH = 10;
const REACH_TOUCH = 20;
const DRAG = 3;

/** What a pointer does on curves: choose, move keyframes in time and value, bend by handles. */
export class CurveGestures {
  readonly #editor: Editor;
  readonly #view: CurveView;
  readonly #place: () => CurvesPlace;
  #held = $state.raw<Held | null>(null);
  /** Raised with each move of what is held, which is changed in place. */
  #moves = $state(0);

  constructor(editor: Editor, view: CurveView, place: () => CurvesPlace) {
    this.#editor = editor;
    this.#view = view;
    this.#place = place;
  }

  get busy(): boolean {
    return this.#held !== null;
  }

  /** Take what is under the pointer; returns false where there is nothing to be taken. */
  down(press: Press): boolean {
    if (press.button !== 0) return false;
    const reach = press.touch ? REACH_TOUCH : REACH;
    const handle = this.#handleAt(press, reach);
    if (handle !== null && this.#editor.editable) {
      this.#held = { kind: "handle", ...handle, begin: press, edit: null };
      this.#view.hold();
      return true;
    }
    const hit = this.#keyAt(press, reach);
    if (hit === null) return false;
    const path = hit.shown.track.parameter;
    const { selection } = this.#editor;
    this.#editor.look(path);
    if (press.adds) {
      selection.toggle([[path, hit.key]]);
      return true;
    }
    const alone = selection.has(path, hit.key);
    if (!alone) selection.set([[path, hit.key]]);
    this.#held = { kind: "key", hit, begin: press, alone, moved: false, time: hit.at.time, by: 0 };
    this.#view.hold();
    return true;
  }

  /** The track whose curve runs at a point, or null. */
  trackAt(press: Press): CurvedTrack | null {
    const time = this.#editor.window.timeAt(press.x);
    const near = this.#view.tracks.flatMap((shown) => {
      const { curve } = shown;
      if (curve === null) return [];
      return curve.values.map((values) => {
        const share = (time - curve.from) / Math.max(curve.to - curve.from, 1e-9);
        const value = values[Math.round(share * (values.length - 1))] ?? Infinity;
        return { shown, distance: Math.abs(yOf(this.#place(), shown, value) - press.y) };
      });
    });
    const [best] = near.sort((a, b) => a.distance - b.distance);
    return best === undefined || best.distance > REACH_TOUCH ? null : best.shown;
  }

  /** The keyframe under a point: its track's path and its key. */
  keyAt(press: Press): [path: string, key: string] | null {
    const hit = this.#keyAt(press, press.touch ? REACH_TOUCH : REACH);
    return hit === null ? null : [hit.shown.track.parameter, hit.key];
  }

  move(press: Press, straight: boolean): void {
    const held = this.#held;
    if (held === null || !this.#editor.editable) return;
    if (held.kind === "handle") this.#moveHandle(held, press);
    else this.#moveKey(held, press, straight);
    this.#moves += 1;
  }

  up(): void {
    const held = this.#held;
    this.#held = null;
    this.#editor.moving = null;
    if (held === null) return;
    const edits =
      held.kind === "handle" ? (held.edit === null ? [] : [held.edit]) : held.moved ? this.#keyEdits(held) : [];
    this.#view.release(edits.length > 0);
    if (held.kind === "key" && !held.moved && held.alone) {
      this.#editor.selection.set([[held.hit.shown.track.parameter, held.hit.key]]);
    }
    this.#editor.edit(held.kind === "handle" ? does.curveBent : does.someMoved({ count: 2 }), edits);
  }

  /** Let go and leave the show as it is; returns whether there was anything. */
  cancel(): boolean {
    const was = this.#held !== null;
    this.#held = null;
    this.#editor.moving = null;
    this.#view.release(false);
    return was;
  }

  /** Where a chosen keyframe's mark is while it is held. */
  placeOf(shown: CurvedTrack, component: number, at: Placed): Placed {
    const { moving, axis } = this.#editor;
    const time = moving === null ? at.time : placed(axis, moving, at.time);
    const held = this.#moves >= 0 ? this.#held : null;
    const lifted =
      held?.kind === "key" &&
      held.hit.shown.track.parameter === shown.track.parameter &&
      held.hit.component === component;
    return { time, value: at.value + (lifted ? held.by : 0) };
  }

  /** The handles to be drawn, with their song times. */
  handles(shown: CurvedTrack): { handle: Handle; at: Placed; hangsOn: Placed }[] {
    const held = this.#moves >= 0 ? this.#held : null;
    if (!shown.active || held?.kind === "key") return [];
    const chosen = this.#editor.selection.byTrack.get(shown.track.parameter);
    if (chosen === undefined) return [];
    const { track } =
      held?.kind === "handle" && held.edit !== null ? { track: this.#draft(shown, [held.edit]) } : shown;
    const unit = this.#editor.times.unitOf(track);
    const songTime = (time: number) => this.#editor.axis.toSongTime(unit, time);
    return handlesOf(track, shown.parameter, chosen).map((handle) => ({
      handle,
      at: { time: songTime(handle.time), value: handle.value },
      hangsOn: { time: songTime(handle.at.time), value: handle.at.value },
    }));
  }

  /** Keys whose marks lie in a box of the curves' place. */
  keysIn(from: number, to: number, top: number, bottom: number): [string, string][] {
    const place = this.#place();
    return this.#view.tracks.flatMap((shown) => {
      const times = this.#editor.times.of(shown.track);
      return shown.track.keyframes.flatMap(({ key, value }, index): [string, string][] => {
        const time = times[index] ?? -1;
        if (time < from || time > to) return [];
        const inside = componentsOf(shown.parameter, value).some((each) => {
          const y = yOf(place, shown, each);
          return y >= top && y <= bottom;
        });
        return inside ? [[shown.track.parameter, key]] : [];
      });
    });
  }

  #moveHandle(held: Held & { kind: "handle" }, press: Press): void {
    const place = this.#place();
    const { shown, handle } = held;
    const unit = this.#editor.times.unitOf(shown.track);
    const time = this.#editor.axis.toTrackTime(unit, this.#editor.window.timeAt(press.x));
    held.edit = handleEdit(shown.track, shown.parameter, handle, time, valueAt(place, shown, press.y)) ?? held.edit;
    if (held.edit !== null) this.#view.preview(this.#draft(shown, [held.edit]));
  }

  #moveKey(held: Held & { kind: "key" }, press: Press, straight: boolean): void {
    const [dx, dy] = [press.x - held.begin.x, press.y - held.begin.y];
    held.moved ||= Math.hypot(dx, dy) >= DRAG;
    if (!held.moved) return;
    const { window, axis, span } = this.#editor;
    const { shown, at } = held.hit;
    const alongTime = !straight || Math.abs(dx) >= Math.abs(dy);
    const least = at.time - (span?.start ?? 0) + this.#editor.lead;
    const time = alongTime ? Math.max(this.#editor.snap(at.time + dx / window.scale, press.alt), least) : at.time;
    held.by = !straight || !alongTime ? valueAt(this.#place(), shown, dy) - valueAt(this.#place(), shown, 0) : 0;
    held.time = time;
    this.#editor.moving = movedBy(axis, at.time, time);
    this.#view.preview(this.#draft(shown, this.#keyEdits(held)));
  }

  #keyEdits({ hit, time, by }: Held & { kind: "key" }): Edit[] {
    const { axis, chosen } = this.#editor;
    const retiming = movedBy(axis, hit.at.time, time);
    const { parameter } = hit.shown;
    const lifted = by === 0 ? [] : chosen.filter(({ track }) => track.parameter === parameter.path);
    const values = lifted.map(({ keyframe }): Edit => {
      const value = withComponent(parameter, keyframe.value, hit.component, by);
      return { edit: "change_keyframe", parameter: parameter.path, key: keyframe.key, changes: { value } };
    });
    if (retiming.by === 0) return values;
    return [
      ...values,
      {
        edit: "move_keyframes",
        keyframes: carriedKeys(this.#editor),
        time: "beats",
        by: retiming.by,
        stretch: { about: 0, factor: 1 },
      },
    ];
  }

  #draft(shown: CurvedTrack, edits: readonly Edit[]) {
    const { document } = this.#editor.store;
    const draft = document === null ? null : withEdits(document, edits, this.#editor.axis);
    return trackOf(draft, shown.track.parameter) ?? shown.track;
  }

  #handleAt(press: Press, reach: number): { shown: CurvedTrack; handle: Handle } | null {
    const shown = this.#view.tracks.at(-1);
    if (shown === undefined) return null;
    const found = this.handles(shown).find(({ at }) => this.#distance(press, shown, at) <= reach);
    return found === undefined ? null : { shown, handle: found.handle };
  }

  #keyAt(press: Press, reach: number): KeyHit | null {
    // The one that is looked at is drawn last, and taken first.
    for (const shown of [...this.#view.tracks].reverse()) {
      const found = this.#keysNear(press, shown, reach).sort((a, b) => a.distance - b.distance)[0];
      if (found !== undefined) return found.hit;
    }
    return null;
  }

  #keysNear(press: Press, shown: CurvedTrack, reach: number): { hit: KeyHit; distance: number }[] {
    const { window } = this.#editor;
    const times = this.#editor.times.of(shown.track);
    const first = firstFrom(times, window.timeAt(press.x - reach));
    const near = shown.track.keyframes.slice(first, firstFrom(times, window.timeAt(press.x + reach)));
    return near.flatMap(({ key, value }, index) =>
      componentsOf(shown.parameter, value).flatMap((each, component) => {
        const at = { time: times[first + index] ?? 0, value: each };
        const distance = this.#distance(press, shown, at);
        return distance <= reach ? [{ hit: { shown, key, component, at }, distance }] : [];
      }),
    );
  }

  #distance(press: Press, shown: CurvedTrack, at: Placed): number {
    return Math.hypot(this.#editor.window.xOf(at.time) - press.x, yOf(this.#place(), shown, at.value) - press.y);
  }
}
