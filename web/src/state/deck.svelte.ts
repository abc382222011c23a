import { nextRate } from "./rates";
import { phrasesOf } from "./overview";
import type { Reina } from "./reina.svelte";
import { neighbouringBarLine } from "./score-time";
import { keepsKey, shortcutOf, type Action } from "./shortcuts";
import type { SessionView } from "./session-view.svelte";
import { remember, remembered, type NoteNames, type Quality } from "./storage";
import { CAMERA_PRESETS, type CameraView } from "../scene";

const STEP_S = 2;
const VOLUME_STEP = 0.05;
const SHORTEST_LOOP_S = 0.25;
/** How far one key press takes the camera: an angle, radians, and a share of its distance. */
const ORBIT_STEP = Math.PI / 36;
const DOLLY_STEP = 0.92;

/** What the deck asks of the stage and the page around it. */
export interface DeckHands {
  giveBackCamera(): void;
  /** Around what the camera looks at, to its right and up, radians. */
  orbitCamera(azimuth: number, elevation: number): void;
  /** To so many times the camera's distance. */
  dollyCamera(factor: number): void;
  /** To a view by its name. */
  viewPreset(name: string): void;
  toggleFullscreen(): void;
  openFilePicker(): void;
  /** The view that is seen, as a show's camera keys hold it. */
  currentView(): CameraView;
  /** Take a key press while the show is open; returns whether it was the editor's. */
  pressInShow(event: KeyboardEvent): boolean;
}

/** What lies over the stage: which panels are open, and what each action does. */
export class Deck {
  readonly reina: Reina;
  pieceOpen = $state(remembered().pieceOpen);
  showOpen = $state(remembered().showOpen);
  noteNames = $state(remembered().noteNames);
  piecesOpen = $state(false);
  viewsOpen = $state(false);
  quality = $state(remembered().quality);
  valvesInset = $state(remembered().valvesInset);
  helpOpen = $state(false);
  cameraTaken = $state(false);
  /** The window has room for one panel at a time. */
  narrow = $state(false);
  /** Filled by the components that can do these things. */
  readonly hands: Partial<DeckHands> = {};
  #loopStart: number | null = null;

  readonly #actions: Readonly<Record<Action, (view: SessionView) => unknown>> = {
    toggle: () => this.reina.toggle(),
    back: (view) => view.seek(view.songTime - STEP_S),
    forward: (view) => view.seek(view.songTime + STEP_S),
    barBack: (view) => view.seek(neighbouringBarLine(view.score, view.songTime, -1, view.duration)),
    barForward: (view) => view.seek(neighbouringBarLine(view.score, view.songTime, 1, view.duration)),
    begin: (view) => view.seek(0),
    end: (view) => view.seek(view.duration),
    slower: (view) => view.setRate(nextRate(view.transport.rate, -1)),
    faster: (view) => view.setRate(nextRate(view.transport.rate, 1)),
    loopStart: (view) => this.#setLoopStart(view),
    loopEnd: (view) => this.#setLoopEnd(view),
    loopOff: (view) => view.setLoop(view.transport.loop === null ? phraseAt(view) : null),
    louder: () => this.#changeVolume(VOLUME_STEP),
    quieter: () => this.#changeVolume(-VOLUME_STEP),
    mute: () => this.reina.setVolume(this.reina.volume, !this.reina.muted),
    camera: () => this.hands.giveBackCamera?.(),
    orbitLeft: () => this.hands.orbitCamera?.(-ORBIT_STEP, 0),
    orbitRight: () => this.hands.orbitCamera?.(ORBIT_STEP, 0),
    orbitUp: () => this.hands.orbitCamera?.(0, ORBIT_STEP),
    orbitDown: () => this.hands.orbitCamera?.(0, -ORBIT_STEP),
    closer: () => this.hands.dollyCamera?.(DOLLY_STEP),
    further: () => this.hands.dollyCamera?.(1 / DOLLY_STEP),
    views: () => this.toggleViews(),
    view1: () => this.viewPreset(0),
    view2: () => this.viewPreset(1),
    view3: () => this.viewPreset(2),
    view4: () => this.viewPreset(3),
    view5: () => this.viewPreset(4),
    view6: () => this.viewPreset(5),
    inset: () => this.showValvesInset(!this.valvesInset),
    fullscreen: () => this.hands.toggleFullscreen?.(),
    piece: () => this.togglePiece(),
    pieces: () => this.togglePieces(),
    show: () => this.toggleShow(),
    names: () => this.nameNotes(this.noteNames === "written" ? "sounding" : "written"),
    open: () => this.hands.openFilePicker?.(),
    help: () => (this.helpOpen = !this.helpOpen),
  };

  constructor(reina: Reina) {
    this.reina = reina;
  }

  /** Do what a control or a key asks for. */
  run(action: Action): void {
    const { view } = this.reina;
    if (view !== null) this.#actions[action](view);
    else if (action === "open") this.hands.openFilePicker?.();
    else if (action === "pieces") this.togglePieces();
    else if (action === "help") this.helpOpen = !this.helpOpen;
  }

  /** Take a key press; returns whether it was one of the page's own. */
  press(event: KeyboardEvent): boolean {
    if (isTyping(event.target) || event.defaultPrevented) return false;
    if ((event.key === "Enter" || event.key === " ") && isPressable(event.target)) return false;
    if (this.hands.pressInShow?.(event) === true) return true;
    if (event.key === "Escape") return this.#escape();
    if (event.target instanceof HTMLInputElement && keepsKey(event.target.type, event.key)) return false;
    const shortcut = shortcutOf(event, event.target instanceof HTMLCanvasElement);
    if (shortcut === null) return false;
    const { view } = this.reina;
    if (shortcut.controls === true && view?.canControl === false) {
      this.reina.word("You are watching", "Only whoever opened this session can play, stop or move it.");
      return true;
    }
    this.run(shortcut.action);
    return true;
  }

  togglePiece(open = !this.pieceOpen): void {
    if (open && this.narrow) this.toggleShow(false);
    if (open) this.piecesOpen = false;
    this.pieceOpen = open;
    remember({ pieceOpen: open });
  }

  toggleViews(open = !this.viewsOpen): void {
    if (open && this.narrow) {
      this.togglePiece(false);
      this.togglePieces(false);
      this.toggleShow(false);
    }
    this.viewsOpen = open;
  }

  /** @param index of a view, in the order in which they are offered. */
  viewPreset(index: number): void {
    const preset = CAMERA_PRESETS[index];
    if (preset !== undefined) this.hands.viewPreset?.(preset.name);
  }

  showValvesInset(shown: boolean): void {
    this.valvesInset = shown;
    remember({ valvesInset: shown });
  }

  chooseQuality(quality: Quality): void {
    this.quality = quality;
    remember({ quality });
  }

  togglePieces(open = !this.piecesOpen): void {
    if (open) {
      if (this.narrow) this.toggleShow(false);
      this.togglePiece(false);
    }
    this.piecesOpen = open;
  }

  toggleShow(open = !this.showOpen): void {
    if (open && this.narrow) {
      this.togglePiece(false);
      this.togglePieces(false);
    }
    this.showOpen = open;
    remember({ showOpen: open });
  }

  nameNotes(noteNames: NoteNames): void {
    this.noteNames = noteNames;
    remember({ noteNames });
  }

  #escape(): boolean {
    if (this.helpOpen) this.helpOpen = false;
    else if (this.showOpen) this.toggleShow(false);
    else if (this.viewsOpen) this.toggleViews(false);
    else if (this.piecesOpen) this.togglePieces(false);
    else if (this.pieceOpen) this.togglePiece(false);
    else return false;
    return true;
  }

  #setLoopStart(view: SessionView): unknown {
    this.#loopStart = view.songTime;
    const end = view.transport.loop?.end_s;
    if (end !== undefined && end > view.songTime + SHORTEST_LOOP_S) {
      return view.setLoop({ start: view.songTime, end });
    }
    this.reina.word("The loop begins here", "Press ] where it should end.");
    return undefined;
  }

  #setLoopEnd(view: SessionView): unknown {
    const start = this.#loopStart ?? view.transport.loop?.start_s ?? 0;
    if (view.songTime > start + SHORTEST_LOOP_S) return view.setLoop({ start, end: view.songTime });
    this.reina.word("The loop must end after it begins", "Move on a little, then press ] again.");
    return undefined;
  }

  #changeVolume(step: number): void {
    this.reina.setVolume(this.reina.volume + step, false);
  }
}

/** The phrase that is played, or the next one; the whole piece without any. */
function phraseAt(view: SessionView): { start: number; end: number } {
  const phrase = phrasesOf(view.playedNotes).find(({ end }) => end > view.songTime + 0.02);
  const { start, end } = phrase ?? { start: 0, end: view.duration };
  return { start, end: Math.min(Math.max(end, start + SHORTEST_LOOP_S), view.duration) };
}

function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return target.type !== "checkbox" && target.type !== "radio";
  return target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement || target.isContentEditable;
}

function isPressable(target: EventTarget | null): boolean {
  return target instanceof HTMLElement && target.closest("button, a, summary, label, input") !== null;
}
