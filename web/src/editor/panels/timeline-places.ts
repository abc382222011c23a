import { yOf, type CurvesPlace } from "../canvas/draw-curves";
import { headHeight, type Layout } from "../canvas/layout";
import type { CurveGestures } from "../gestures/curve-gestures.svelte";
import { componentsOf } from "../state/component-values";
import type { CurveView } from "../state/curve-view.svelte";
import type { Editor } from "../state/editor.svelte";
import { CAMERA_GROUP } from "../state/shots";
import type { Point, TimelinePlaces } from "../state/show-measures";

/** What a timeline is drawn from. */
interface Timeline {
  readonly editor: Editor;
  readonly lanes: HTMLElement | undefined;
  readonly layout: Layout;
  /** Null while the rows are shown. */
  readonly curves: CurveView | null;
  readonly bending: CurveGestures;
  readonly place: CurvesPlace;
}

/** Where a timeline has drawn keyframes, times, grips and handles, in the window. */
export function timelinePlaces({ editor, lanes, layout, curves, bending, place }: Timeline): TimelinePlaces {
  const { window: span } = editor;
  const head = headHeight(layout);
  const at = (x: number, y: number): Point => {
    const box = lanes?.getBoundingClientRect();
    return { x: (box?.left ?? 0) + x, y: (box?.top ?? 0) + y };
  };
  return {
    key(path, key, component) {
      const track = editor.track(path);
      const index = track?.keyframes.findIndex((each) => each.key === key) ?? -1;
      const time = track === null ? undefined : editor.times.of(track)[index];
      if (track === null || time === undefined) return null;
      const shown = curves?.tracks.find((each) => each.track.parameter === path);
      if (shown !== undefined) {
        const value = componentsOf(shown.parameter, track.keyframes[index]?.value)[component] ?? 0;
        return at(span.xOf(time), yOf(place, shown, value));
      }
      const row = editor.rows.findIndex((each) => each.kind === "track" && each.track.parameter === path);
      return row < 0 ? null : at(span.xOf(time), head + (row + 0.5) * layout.row - editor.scrollTop);
    },
    shot(index) {
      const shot = editor.shots[index];
      const row = editor.rows.findIndex((each) => each.kind === "group" && each.name === CAMERA_GROUP);
      if (shot === undefined || row < 0) return null;
      return at(span.xOf((shot.start + shot.end) / 2), head + (row + 0.5) * layout.row - editor.scrollTop);
    },
    time: (songTime) => at(span.xOf(songTime), (layout.loop + layout.ruler) / 2),
    loop: (songTime) => at(span.xOf(songTime), layout.loop / 2),
    grips() {
      if (editor.span === null) return null;
      const y = head - layout.span / 2;
      return [at(span.xOf(editor.span.start) + 2, y), at(span.xOf(editor.span.end) - 2, y)];
    },
    curvesSettled: () => curves?.settled === true,
    handles() {
      const shown = curves?.tracks.at(-1);
      if (shown === undefined) return [];
      return bending.handles(shown).map((each) => at(span.xOf(each.at.time), yOf(place, shown, each.at.value)));
    },
  };
}
