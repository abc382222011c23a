import { Panels, type PiecePlace } from "./panels.svelte";
import { nextRate } from "./rates";
import { phrasesOf } from "./overview";
import type { Reina } from "./reina.svelte";
import { neighbouringBarLine } from "./score-time";
import { focusOrigin } from "./page-focus";
import { keyTargetOf, ownsKey } from "./key-owner";
import { shortcutOf, type Action } from "./shortcuts";
import type { SessionView } from "./session-view.svelte";
import { remember, remembered, type NoteNames, type Quality } from "./storage";
import { SHORTEST_LOOP_S } from "../timeline/loop-span";
import { arrivalOf, worthKnowing, type OctaveOffer } from "./findings";
import { alignmentWords } from "./alignment-words";
import { offeredViews } from "./offered-views";
import type { InstrumentSummary } from "../generated/protocol";
import type { CameraView, PicturePoint, Place, ShowCamera } from "../scene";
import { told } from "../words/told/en";
import { page } from "../words/page/en";

const STEP_S = 2;
const VOLUME_STEP = 0.05;
/** How many players' parts are offered in another octave at once. */
const OCTAVES_OFFERED = 2;
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
  /** To where everybody is seen, or one player, a place in the cast. */
  viewCast(): void;
  viewPlayer(player: number): void;
  /** To a view by its name, of a player: a place in the cast. */
  viewPreset(name: string, player: number): void;
  toggleFullscreen(): void;
  openFilePicker(): void;
  /** The view that is seen, as a show's camera keys hold it. */
  currentView(): CameraView;
  /** Zoom the transport's timeline to what is played, or back to all. */
  zoomTimeline(): void;
  /** To where some places of the world are seen. */
  viewPlaces(places: readonly Place[]): void;
  /** Where a place of the world is in the picture, CSS pixels; null behind the camera. */
  pointOf(place: Place): PicturePoint | null;
  /** A place of the world moved along the picture by so many CSS pixels. */
  movedInPicture(place: Place, right: number, down: number): [number, number, number];
  /** The show's own camera, and the corners of what it sees, so many metres before it. */
  showCamera(distance: number): ShowCamera;
  /** Told after each picture, by the stage. */
  pictureDrawn(): void;
  /** Take a key press while the show is open; returns whether it was the editor's. */
  pressInShow(event: KeyboardEvent): boolean;
  /** Take a key press while a quiz goes on; returns whether it was an answer. */
  pressInQuiz(event: KeyboardEvent): boolean;
  /** The stretch of the song that the transport's timeline shows, seconds. */
  seenTimeline(): { readonly start: number; readonly end: number };
}

/** What lies over the stage: which panels are open, and what each action does. */
export class Deck {
  readonly reina: Reina;
  readonly panels = new Panels();
  noteNames = $state(remembered().noteNames);
  quality = $state(remembered().quality);
  /** Whether valves or feet are seen in a small picture of their own. */
  closeUp = $state(remembered().valvesInset);
  helpOpen = $state(false);
  cameraTaken = $state(false);
  /** Files are held over the page. */
  dropping = $state(false);
  /** The camera was taken to the player whom the strips follow, and goes along to whoever is followed next. */
  cameraFollows = $state(false);
  /** From this song time on fingerings are hidden, while a quiz asks for them; null without one. */
  hiddenFrom = $state<number | null>(null);
  /** What the paper shows first when it is opened. */
  paperShows = $state<"part" | "chart">("part");
  /** Filled by the components that can do these things. */
  readonly hands: Partial<DeckHands> = {};
  #loopStart: number | null = null;

  readonly #actions: Readonly<Record<Action, (view: SessionView) => unknown>> = {
    toggle: () => this.reina.toggle(),
    back: (view) => view.seek(view.here - STEP_S),
    forward: (view) => view.seek(view.here + STEP_S),
    barBack: (view) => view.seek(neighbouringBarLine(view.score, view.here, -1, view.duration)),
    barForward: (view) => view.seek(neighbouringBarLine(view.score, view.here, 1, view.duration)),
    begin: (view) => view.seek(0),
    end: (view) => view.seek(view.duration),
    slower: (view) => view.setRate(nextRate(view.rate, -1)),
    faster: (view) => view.setRate(nextRate(view.rate, 1)),
    loopStart: (view) => this.#setLoopStart(view),
    loopEnd: (view) => this.#setLoopEnd(view),
    loopOff: (view) => view.setLoop(view.transport.loop === null ? phraseAt(view) : null),
    zoom: () => this.hands.zoomTimeline?.(),
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
    everybody: () => this.viewCast(),
    onePlayer: (view) => this.viewPlayer(view.cast.followed),
    nextPlayer: (view) => this.follow((view.cast.followed + 1) % view.cast.castings.length),
    views: () => this.panels.toggle("views"),
    view1: () => this.viewPreset(0),
    view2: () => this.viewPreset(1),
    view3: () => this.viewPreset(2),
    view4: () => this.viewPreset(3),
    view5: () => this.viewPreset(4),
    view6: () => this.viewPreset(5),
    inset: () => this.showCloseUp(!this.closeUp),
    fullscreen: () => this.hands.toggleFullscreen?.(),
    piece: () => this.panels.toggle("piece"),
    pieces: () => this.panels.toggle("pieces"),
    show: () => this.panels.toggle("show"),
    film: () => this.panels.toggle("film"),
    paper: () => this.panels.toggle("paper"),
    inTime: (view) => this.#openInTime(view),
    practice: () => this.panels.toggle("practice"),
    metronome: () => (this.reina.practice.metronome = !this.reina.practice.metronome),
    noteBack: (view) => this.step(view, -1),
    noteForward: (view) => this.step(view, 1),
    names: () => this.nameNotes(this.noteNames === "written" ? "sounding" : "written"),
    open: () => this.hands.openFilePicker?.(),
    help: () => (this.helpOpen = !this.helpOpen),
  };

  constructor(reina: Reina) {
    this.reina = reina;
    reina.arrived = (view) => this.#tellArrival(view);
  }

  /** Do what a control or a key asks for. */
  run(action: Action): void {
    const { view } = this.reina;
    if (view !== null) this.#actions[action](view);
    else if (action === "open") this.hands.openFilePicker?.();
    else if (action === "pieces") this.panels.toggle("pieces");
    else if (action === "help") this.helpOpen = !this.helpOpen;
  }

  /** Take a key press; returns whether it was one of the page's own. */
  press(event: KeyboardEvent): boolean {
    const target = keyTargetOf(event.target);
    if (event.defaultPrevented || (target !== null && ownsKey(target, event.key, focusOrigin.byPointer))) return false;
    if (this.hands.pressInShow?.(event) === true || this.hands.pressInQuiz?.(event) === true) return true;
    if (event.key === "Escape") return this.#escape();
    const shortcut = shortcutOf(event, event.target instanceof HTMLCanvasElement);
    if (shortcut === null) return false;
    const { view } = this.reina;
    if (shortcut.controls === true && view?.canControl === false) {
      this.reina.word(told.youWatch, told.youWatchMeans);
      return true;
    }
    this.run(shortcut.action);
    return true;
  }

  /** Stop at the followed player's next note (1) or the one before (-1), and let it be heard where that is wanted. */
  step(view: SessionView, direction: 1 | -1): void {
    const note = view.step(direction);
    // A drum's key is no pitch.
    if (note?.valves && this.reina.practice.tones) view.soundNote(note.sounding_pitch);
  }

  /** Whether a note's fingering is not to be seen now. */
  hides(note: { readonly onset_s: number }): boolean {
    return this.hiddenFrom !== null && note.onset_s >= this.hiddenFrom;
  }

  /** Open the fingering chart. */
  openChart(): void {
    this.paperShows = "chart";
    this.panels.toggle("paper", true);
  }

  /** Let the strips follow a player, a place in the cast, and the camera where it looks at one. */
  follow(player: number): void {
    const cast = this.reina.view?.cast;
    cast?.follow(player);
    if (cast !== undefined && this.cameraFollows) this.hands.viewPlayer?.(cast.followed);
  }

  viewCast(): void {
    this.cameraFollows = false;
    this.hands.viewCast?.();
  }

  viewPlayer(player: number): void {
    this.cameraFollows = true;
    this.hands.viewPlayer?.(player);
  }

  /** The camera was taken from the show, or given back to it. */
  takeCamera(taken: boolean): void {
    this.cameraTaken = taken;
    if (!taken) this.cameraFollows = false;
  }

  /** What the followed player plays; null while that is not known. */
  get followedInstrument(): InstrumentSummary | null {
    const name = this.reina.view?.cast.casting?.instrument;
    return this.reina.instruments?.instruments.find((each) => each.name === name) ?? null;
  }

  /** @param index of a view, in the order in which they are offered. */
  viewPreset(index: number): void {
    const name = offeredViews(this.followedInstrument)[index];
    if (name !== undefined && name !== null) this.viewNamed(name);
  }

  /** @param name of a view of the followed player, or of what the player sits at. */
  viewNamed(name: string): void {
    this.hands.viewPreset?.(name, this.reina.view?.cast.followed ?? 0);
  }

  showCloseUp(shown: boolean): void {
    this.closeUp = shown;
    remember({ valvesInset: shown });
  }

  chooseQuality(quality: Quality): void {
    this.quality = quality;
    remember({ quality });
  }

  /** Open the piece's panel at a place in it. */
  openPiece(place: PiecePlace): void {
    this.panels.sought = place;
    this.panels.toggle("piece", true);
  }

  nameNotes(noteNames: NoteNames): void {
    this.noteNames = noteNames;
    remember({ noteNames });
  }

  /** A song that is made from the score is in time with it. */
  #openInTime(view: SessionView): void {
    if (view.isRecording) this.panels.toggle("inTime");
    else this.reina.word(told.inTimeAlready, told.inTimeAlreadyMeans);
  }

  /** Say what a search for the score in the recording came to. */
  tellInTime(view: SessionView): void {
    view.searchEnded = false;
    const words = alignmentWords(view);
    if (words === null || this.panels.isOpen("inTime")) return;
    const { status } = view.alignment;
    const label = !view.canControl || status === "found" ? told.details : told.putInTime;
    this.reina.word(words.title, words.detail, {
      actions: [{ label, run: () => this.panels.toggle("inTime", true) }],
      over: () => this.reina.view !== view || view.alignment.status !== status || this.panels.isOpen("inTime"),
    });
  }

  /** Say who plays what of a score that was just opened, and what can be done about it. */
  #tellArrival(view: SessionView): void {
    const { title, detail, drumsAlone, lines, offers } = arrivalOf(view.session);
    const several = view.cast.castings.length > 1;
    const { castings } = view.cast;
    const covered = this.panels.coversStage;
    const octaves = offers.slice(0, OCTAVES_OFFERED).map((offer) => ({
      label: moveLabel(offer, several),
      run: () => this.#fitOctave(view, offer),
    }));
    const change = drumsAlone
      ? { label: told.openAnother, run: () => this.run("open") }
      : several
        ? { label: told.changeWho, run: () => this.openPiece("cast") }
        : { label: told.changePart, run: () => this.openPiece("part") };
    const known = worthKnowing(view.session.findings).length > 0;
    const details = known ? [{ label: told.details, run: () => this.openPiece("findings") }] : [];
    this.reina.word(title, detail, {
      lines,
      actions: [...octaves, change, ...details],
      // On a phone it would lie over what was opened since.
      over: () =>
        this.reina.view !== view ||
        view.cast.castings !== castings ||
        this.helpOpen ||
        (this.panels.coversStage && !covered),
    });
  }

  async #fitOctave(view: SessionView, { player, octaves }: OctaveOffer): Promise<void> {
    await view.cast.change(player, { octave_fit: true });
    if (view.cast.castings[player]?.octave_fit !== true) {
      if (view.cast.refusal !== null) this.reina.problem(told.cannotMove, view.cast.refusal.words);
      return;
    }
    const count = Math.abs(octaves);
    this.reina.word(octaves > 0 ? told.movedUp({ count }) : told.movedDown({ count }), "", {
      actions: [{ label: page.undo, run: () => view.cast.change(player, { octave_fit: false }) }],
      over: () => this.reina.view !== view || view.cast.castings[player]?.octave_fit !== true,
    });
  }

  #escape(): boolean {
    if (this.helpOpen) this.helpOpen = false;
    else return this.panels.closeLast() || this.reina.uploads.cancelLast() || this.#endLoop();
    return true;
  }

  #endLoop(): boolean {
    const { view } = this.reina;
    if (view?.canControl !== true || view.transport.loop === null) return false;
    void view.setLoop(null);
    return true;
  }

  #setLoopStart(view: SessionView): unknown {
    this.#loopStart = view.here;
    const end = view.transport.loop?.end_s;
    if (end !== undefined && end > view.here + SHORTEST_LOOP_S) {
      return view.setLoop({ start: view.here, end });
    }
    this.reina.word(told.loopBegins, told.loopBeginsMeans, {
      over: () => view.transport.loop !== null || this.reina.view !== view,
    });
    return undefined;
  }

  #setLoopEnd(view: SessionView): unknown {
    const start = this.#loopStart ?? view.transport.loop?.start_s ?? 0;
    if (view.here > start + SHORTEST_LOOP_S) return view.setLoop({ start, end: view.here });
    this.reina.word(told.loopTooShort, told.loopTooShortMeans, {
      over: () => view.songTime > start + SHORTEST_LOOP_S || this.reina.view !== view,
    });
    return undefined;
  }

  #changeVolume(step: number): void {
    this.reina.setVolume(this.reina.volume + step, false);
  }
}

/** What an offer of another octave says; of several players, whose part it is. */
function moveLabel({ player: place, octaves }: OctaveOffer, several: boolean): string {
  const [count, player] = [Math.abs(octaves), place + 1];
  if (several) return octaves > 0 ? told.movePlayerUp({ player, count }) : told.movePlayerDown({ player, count });
  return octaves > 0 ? told.moveUp({ count }) : told.moveDown({ count });
}

/** The phrase that is played, or the next one; the whole piece without any. */
export function phraseAt(view: SessionView): { start: number; end: number } {
  const phrase = phrasesOf(view.line).find(({ end }) => end > view.here + 0.02);
  const { start, end } = phrase ?? { start: 0, end: view.duration };
  return { start, end: Math.min(Math.max(end, start + SHORTEST_LOOP_S), view.duration) };
}
