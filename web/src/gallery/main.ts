/**
 * A page for development that stands each part, pose and light alone: `npm run dev`, then /gallery.
 * The pictures in docs/ are taken from it: docs/images/renew.py calls `window.gallery.show`.
 */

import "../styles/page.css";
import "./gallery.css";

import { playedScore, Stage, type Tier } from "../scene";
import { FINISHES, LENSES, LIGHTS, MUTES, type Overrides, PARTS, STYLES } from "./choices";
import { SessionFrames } from "./frames";
import { RigAtRest, withRigs } from "./rig-at-rest";

/** What is shown; what is left out stays as it is. */
export interface GalleryView {
  readonly time: number;
  readonly part: string;
  readonly light: string;
  readonly camera: string;
  readonly style: string;
  readonly finish: string;
  readonly mute: string;
  readonly lens: string;
  /** Any other show parameters, by path: a camera of one's own with the show's camera, say. */
  readonly values: Overrides;
}

export interface Gallery {
  /** Draw a view; done when it is on the canvas. */
  show(view: Partial<GalleryView>): Promise<void>;
  readonly duration: number;
}

declare global {
  interface Window {
    gallery?: Gallery;
  }
}

const SHOW_CAMERA = "the show's";
const TIERS: readonly Tier[] = ["full", "medium", "low"];

function element<T extends HTMLElement>(id: string, kind: new () => T): T {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`gallery.html has no ${kind.name} #${id}`);
  return found;
}

function addChoice(
  form: HTMLElement,
  name: string,
  options: readonly string[],
  value: string,
  pick: (value: string) => void,
): void {
  const label = document.createElement("label");
  const select = document.createElement("select");
  select.append(...options.map((option) => new Option(option, option, false, option === value)));
  select.addEventListener("change", () => pick(select.value));
  label.append(name, select);
  form.append(label);
}

function addTime(form: HTMLElement, duration: number, value: number, pick: (value: number) => void): void {
  const label = document.createElement("label");
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: "0", max: String(duration), step: String(1 / 60), value: String(value) });
  slider.addEventListener("input", () => pick(slider.valueAsNumber));
  label.append("Time", slider);
  form.append(label);
}

async function open(): Promise<Gallery> {
  const asked = new URLSearchParams(location.search);
  const tier = TIERS.find((name) => name === asked.get("tier")) ?? "full";
  const canvas = element("stage", HTMLCanvasElement);
  const stage = new Stage(canvas, { tier, reducedMotion: true, wholeParts: true });
  const frames = await SessionFrames.open(asked.get("session"));
  const { manifest, score } = frames;
  // Rigs beside those of the session, or alone: `?alone&rig=drumkit@0,0.2,-2.15`.
  const alone = asked.has("alone");
  const rigs = await RigAtRest.loadAll(asked.getAll("rig"), manifest);
  const skeletons = [...(alone ? [] : manifest.skeletons), ...rigs.map(({ layout }) => layout)];
  await stage.load({ ...manifest, skeletons }, (rig) => manifest.links.rigs[rig] ?? `/api/v1/rigs/${rig}`);
  const players = Math.max(...manifest.skeletons.map(({ player }) => player)) + 1;
  if (!alone) stage.setScore(playedScore(score, players));
  new ResizeObserver(() => stage.resize(canvas.clientWidth, canvas.clientHeight, devicePixelRatio)).observe(canvas);
  stage.resize(canvas.clientWidth, canvas.clientHeight, devicePixelRatio);

  let view: GalleryView = {
    time: Number(asked.get("t") ?? 4),
    part: asked.get("part") ?? "stage",
    light: asked.get("light") ?? "as the show has it",
    camera: asked.get("camera") ?? "three_quarter",
    style: asked.get("style") ?? "as the show has it",
    finish: asked.get("finish") ?? "as the show has it",
    mute: asked.get("mute") ?? "as the score has it",
    lens: asked.get("lens") ?? "as the show has it",
    values: {},
  };

  async function show(change: Partial<GalleryView>): Promise<void> {
    view = { ...view, ...change };
    const chosen: Overrides = {
      ...LIGHTS[view.light],
      ...STYLES[view.style],
      ...FINISHES[view.finish],
      ...MUTES[view.mute],
      ...LENSES[view.lens],
      ...view.values,
    };
    stage.isolate(PARTS[view.part] ?? null);
    if (!stage.viewPreset(view.camera)) stage.giveBackCamera();
    const frame = await frames.at(view.time, chosen);
    stage.draw({ ...frame, floats: withRigs(frame.floats, manifest, rigs) });
    // On the canvas once the next picture is due.
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  }

  const form = element("choices", HTMLFormElement);
  form.hidden = asked.has("bare");
  const cameras = [...stage.cameraPresets.map(({ name }) => name), SHOW_CAMERA];
  addTime(form, manifest.duration_s, view.time, (time) => void show({ time }));
  addChoice(form, "Part", Object.keys(PARTS), view.part, (part) => void show({ part }));
  addChoice(form, "Light", Object.keys(LIGHTS), view.light, (light) => void show({ light }));
  addChoice(form, "Camera", cameras, view.camera, (camera) => void show({ camera }));
  addChoice(form, "Style", Object.keys(STYLES), view.style, (style) => void show({ style }));
  addChoice(form, "Finish", Object.keys(FINISHES), view.finish, (finish) => void show({ finish }));
  addChoice(form, "Mute", Object.keys(MUTES), view.mute, (mute) => void show({ mute }));
  addChoice(form, "Lens", Object.keys(LENSES), view.lens, (lens) => void show({ lens }));
  await show({});
  return { show, duration: manifest.duration_s };
}

open().then(
  (gallery) => (window.gallery = gallery),
  (error: unknown) =>
    (element("word", HTMLParagraphElement).textContent = error instanceof Error ? error.message : String(error)),
);
