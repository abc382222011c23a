import type { Look } from "../../generated/show";
import type { NewLook } from "../../state/looks.svelte";
import type { Editor } from "../state/editor.svelte";
import { groupOf } from "../state/rows";
import { CAMERA_GROUP } from "../state/shots";
import { byTrack } from "../state/selection.svelte";
import type { ShowKeyframe } from "../state/show-document";
import { round } from "../state/time-axis";
import { looksWords } from "../../words/editor-looks/en";

/** What a look is made of. */
export type LookSource = "light" | "stage" | "keyframes";

/** What takes part in a light: as in the server's own moods. */
const LIGHT = ["lights", "stage/fog/density"];

/** Put a look into the show: from the playhead on, or throughout. */
export function applyLook(editor: Editor, title: string, { values, tracks, rest }: Look, throughout: boolean): void {
  const look: Look = {
    ...(values === undefined ? {} : { values }),
    ...(tracks === undefined ? {} : { tracks }),
    ...(rest === undefined ? {} : { rest }),
  };
  const at = throughout ? {} : ({ at: round(editor.playhead), time: "seconds" } as const);
  editor.edit(looksWords.applied({ title }), [{ edit: "apply_look", look, ...at }]);
}

/** A look of what is on screen, or of the chosen keyframes, which move as they do from the first of them on. */
export function lookOf(editor: Editor, title: string, source: LookSource): NewLook {
  if (source === "keyframes") return { title, tracks: chosenTracks(editor) };
  const { parameters } = editor.reina;
  const groups = new Set(parameters.map(({ path }) => groupOf(path)).filter((name) => name !== CAMERA_GROUP));
  const rest = source === "light" ? LIGHT : [...groups];
  const taken = parameters.filter(({ path }) => rest.some((each) => path === each || path.startsWith(`${each}/`)));
  const values = taken.flatMap((parameter) => {
    const value = editor.valueNow(parameter);
    // What is as it is at rest is said by `rest`.
    return isDefault(value, parameter.default) ? [] : [[parameter.path, value] as const];
  });
  return { title, values: Object.fromEntries(values), rest };
}

function chosenTracks(editor: Editor): NonNullable<NewLook["tracks"]> {
  const begin = editor.span?.start ?? 0;
  return [...byTrack(editor.chosen)].map(([track, keyframes]) => {
    const time = editor.times.unitOf(track);
    const first = editor.axis.toTrackTime(time, begin);
    const moved = keyframes.map((each): ShowKeyframe => ({ ...each, time: round(each.time - first) }));
    const space = track.color_space === undefined ? {} : { color_space: track.color_space };
    return { parameter: track.parameter, time, ...space, keyframes: moved };
  });
}

function isDefault(value: unknown, rests: unknown): boolean {
  if (typeof value === "number" && typeof rests === "number") return Math.abs(value - rests) < 1e-5;
  if (Array.isArray(value) && Array.isArray(rests)) return value.every((each, index) => isDefault(each, rests[index]));
  return JSON.stringify(value) === JSON.stringify(rests);
}
