import type { Interpolation, ShowParameter, ShowParameterList } from "../../generated/protocol";
import type { Deck } from "../../state/deck.svelte";
import type { Reina } from "../../state/reina.svelte";
import type { SessionView } from "../../state/session-view.svelte";
import { remember, remembered } from "../../state/storage";
import { CurveReader } from "./curves.svelte";
import { readEasingShapes, type EasingShape } from "./easing-shapes";
import type { Edit } from "./edits";
import { findParameters, type Described } from "./find-parameters";
import { KeyTimes } from "./key-times";
import type { OpenMenu } from "./menu";
import { valueOnScreen } from "./parameter-value";
import type { PitchReading } from "./pitch-names";
import { rowsOf, type Row } from "./rows";
import { keysOf, Selection, type ChosenKey } from "./selection.svelte";
import { shotsOf, withCuts, type Shot } from "./shots";
import { trackOf, type ShowTrack } from "./show-document";
import { ShowStore } from "./show-store.svelte";
import { snapped, type Snap } from "./snapping";
import { spanOf, type Retiming, type Span } from "./spans";
import { TimeAxis } from "./time-axis";
import { LoopGrid, type LoopSpan } from "../../timeline/loop-span";
import { TimeWindow } from "../../timeline/time-window.svelte";
import { does } from "../../words/editor-does/en";

export type Mode = "keys" | "curves";

/** The show's editor over one session: what it shows, what is chosen, and what it does through the server. */
export class Editor {
  readonly deck: Deck;
  readonly reina: Reina;
  readonly view: SessionView;
  readonly store: ShowStore;
  readonly selection = new Selection();
  readonly window = new TimeWindow();
  readonly curves: CurveReader;

  mode = $state<Mode>("keys");
  /** Path of the track that is looked at: its settings are shown, and Enter puts a keyframe on it. */
  active = $state<string | null>(null);
  closed = $state.raw<ReadonlySet<string>>(new Set(remembered().closedGroups));
  snapping = $state(remembered().snapping);
  snaps = $state.raw<ReadonlySet<Snap>>(new Set(remembered().snaps));
  /** Whether each unit's curves fill the room by themselves. */
  normalised = $state(remembered().normalised);
  /** The camera's path is drawn in the picture, whatever is chosen. */
  pathShown = $state(false);
  /** What the pointer moves; the show is edited once it lets go. */
  moving = $state.raw<Retiming | null>(null);
  /** The words of the tracks that are sought. */
  sought = $state("");
  /** The menu that is open, and where in the window. */
  menu = $state.raw<OpenMenu | null>(null);
  /** Raised whenever the value of what is chosen is to be typed. */
  valueWanted = $state(0);
  /** Raised whenever a track is to be sought. */
  searchWanted = $state(0);
  /** Opens the menu of what the keyboard is at on the timeline; filled by what draws it. */
  openMenuHere: () => void = () => undefined;
  /** How far the rows are scrolled, pixels. */
  scrollTop = $state(0);
  /** The track whose row is to be brought on screen, and whether the keyboard's focus goes there. */
  rowWanted = $state.raw<{ readonly path: string; readonly focus: boolean } | null>(null);
  /** Every interpolation by its name, with its options; as the server describes them. */
  ways = $state.raw<ReadonlyMap<string, Interpolation>>(new Map());
  /** How each interpolation runs, as the server samples it. */
  shapes = $state.raw<ReadonlyMap<string, EasingShape>>(new Map());
  /** What was done last, for readers of the screen. */
  said = $state("");

  constructor(deck: Deck, view: SessionView) {
    this.deck = deck;
    this.reina = deck.reina;
    this.view = view;
    this.store = new ShowStore({
      api: this.reina.api,
      session: view.id,
      token: view.token,
      axis: () => this.axis,
      tell: (error) => this.reina.tell(error),
      word: (title, detail) => this.reina.word(title, detail),
      later: (action, milliseconds) => setTimeout(action, milliseconds),
    });
    this.curves = new CurveReader(this.reina.api, view.id, view.token);
  }

  /** What loops are drawn to, and the loop that there is. */
  readonly loopGrid = $derived.by(() => new LoopGrid(this.view.score.bar_lines_s, this.view.duration));
  readonly loop: LoopSpan | null = $derived.by(() => {
    const { loop } = this.view.transport;
    return loop === null ? null : { start: loop.start_s, end: loop.end_s };
  });
  readonly axis = $derived.by(() => new TimeAxis(this.view.score));
  readonly times = $derived.by(() => new KeyTimes(this.axis, this.store.document?.time ?? "seconds"));
  /** Paths of the tracks that are sought; null while nothing is. */
  readonly found: ReadonlySet<string> | null = $derived.by(() => {
    if (this.sought.trim() === "") return null;
    const tracks = (this.store.document?.tracks ?? []).map(
      ({ parameter: path }): Described => this.parameter(path) ?? { path, documentation: "", type: "number" },
    );
    return new Set(findParameters(tracks, this.sought).map(({ path }) => path));
  });
  readonly rows: readonly Row[] = $derived.by(() => rowsOf(this.store.document, this.closed, this.found));
  readonly chosen: readonly ChosenKey[] = $derived.by(() => this.selection.keysOf(this.store.document));
  readonly span: Span | null = $derived.by(() => spanOf(this.axis, this.times, this.chosen));
  /** The keys that move when the chosen ones do, by track: cuts stay whole. */
  readonly carried: ReadonlyMap<string, ReadonlySet<string>> = $derived.by(() =>
    withCuts(this.store.document?.tracks ?? [], (track) => this.times.of(track), this.selection.byTrack),
  );
  /** The keys to be drawn as chosen, by track: while they are moved, all that move. */
  readonly held: ReadonlyMap<string, ReadonlySet<string>> = $derived.by(() =>
    this.moving === null ? this.selection.byTrack : this.carried,
  );
  /** How far the chosen keyframes' first is behind the first that moves with them, seconds. */
  readonly lead: number = $derived.by(() => {
    if (this.span === null) return 0;
    const moved = spanOf(this.axis, this.times, keysOf(this.store.document, this.carried));
    return this.span.start - (moved?.start ?? this.span.start);
  });
  /** The camera's shots. */
  readonly shots: readonly Shot[] = $derived.by(() =>
    shotsOf(this.store.document?.tracks ?? [], (track) => this.times.of(track), this.view.duration),
  );
  readonly markerTimes: readonly number[] = $derived.by(() => {
    const document = this.store.document;
    return (document?.markers ?? []).map(({ time }) => this.axis.toSongTime(document?.time ?? "seconds", time));
  });
  /** Index of the chosen marker. */
  get marker(): number | null {
    return this.selection.marker;
  }

  set marker(index: number | null) {
    this.selection.marker = index;
  }

  /** The track of what is chosen: of its keyframes where they are all of one, else the one that is looked at. */
  readonly shownTrack: ShowTrack | null = $derived.by(() => {
    const paths = [...this.selection.byTrack.keys()];
    return paths.length > 1 ? null : this.track(paths[0] ?? this.active);
  });

  readonly #parameters = $derived.by(() => new Map(this.reina.parameters.map((each) => [each.path, each])));

  get editable(): boolean {
    return this.store.editable;
  }

  /** Where the playhead stands, song time, seconds: exactly while it rests, else as the picture has it. */
  get playhead(): number {
    const { transport, songTime } = this.view;
    return transport.playing ? songTime : transport.song_time_s;
  }

  get fps(): number {
    return this.view.hello?.fps ?? 60;
  }

  parameter(path: string): ShowParameter | null {
    return this.#parameters.get(path) ?? null;
  }

  /** Tracks whose keyframes can be edited: the server keeps those of unknown parameters as they are. */
  readonly known: readonly ShowTrack[] = $derived.by(() =>
    (this.store.document?.tracks ?? []).filter(({ parameter }) => this.#parameters.has(parameter)),
  );

  track(path: string | null): ShowTrack | null {
    return path === null ? null : trackOf(this.store.document, path);
  }

  /** Song time of a keyframe, seconds. */
  songTimeOf({ track, keyframe }: ChosenKey): number {
    return this.axis.toSongTime(this.times.unitOf(track), keyframe.time);
  }

  /** How the pitches of a part, or of the first player's, are called as the page calls notes. */
  pitchReading(part: number | undefined): PitchReading {
    const { score, cast } = this.view;
    const own = part ?? cast.castings[0]?.part ?? score.part;
    const note = this.deck.noteNames === "written" ? score.notes.find((each) => each.part === own) : undefined;
    const key = score.keys[0];
    return {
      above: note === undefined ? 0 : note.written_pitch - note.sounding_pitch,
      fifths: key?.fifths ?? 0,
      minor: key?.name.endsWith("minor") ?? false,
    };
  }

  /** A parameter's value in the picture that was drawn last. */
  valueNow(parameter: ShowParameter): unknown {
    const { hello, drawn } = this.view;
    return hello === null || drawn === null ? parameter.default : valueOnScreen(hello, drawn.floats, parameter);
  }

  edit(says: string, edits: readonly Edit[]): void {
    this.store.edit(says, edits);
    if (edits.length > 0) this.said = says;
  }

  /** Take something out of the show, and offer to put it back until the next step. */
  remove(says: string, edits: readonly Edit[]): void {
    if (edits.length === 0) return;
    this.edit(says, edits);
    const made = this.store.made;
    const undo = { label: does.undo, run: () => this.store.undo() };
    this.reina.word(says, "", {
      actions: [undo],
      over: () => this.store.made !== made || this.reina.view !== this.view,
    });
  }

  /** The place near a song time that the switched-on snaps draw it to. `free` leaves it where it is. */
  snap(songTime: number, free = false, reachPixels = 9): number {
    if (free || !this.snapping) return songTime;
    const stays = (this.store.document?.tracks ?? []).filter(({ parameter }) => !this.selection.byTrack.has(parameter));
    return snapped(songTime, reachPixels / this.window.scale, this.snaps, {
      axis: this.axis,
      score: this.view.score,
      keys: this.snaps.has("keys") ? stays.map((track) => this.times.of(track)) : [],
      markers: this.markerTimes,
      fps: this.fps,
    });
  }

  setSnapping(on: boolean): void {
    this.snapping = on;
    remember({ snapping: on });
  }

  setNormalised(on: boolean): void {
    this.normalised = on;
    remember({ normalised: on });
  }

  toggleSnap(snap: Snap): void {
    const snaps = new Set(this.snaps);
    if (!snaps.delete(snap)) snaps.add(snap);
    this.snaps = snaps;
    remember({ snaps: [...snaps] });
  }

  toggleGroup(name: string, open = this.closed.has(name)): void {
    const closed = new Set(this.closed);
    if (open) closed.delete(name);
    else closed.add(name);
    this.closed = closed;
    remember({ closedGroups: [...closed] });
  }

  /** Scroll to a track's row, in the middle where there is room; `focus` takes the keyboard there. */
  revealRow(path: string, focus = false): void {
    if (this.found?.has(path) === false) this.sought = "";
    this.rowWanted = { path, focus };
  }

  /** Look at a track, whatever of it is chosen. */
  look(path: string | null): void {
    this.active = path;
    this.marker = null;
  }

  /** Choose a track as a whole: none of its keyframes, and none of another's. */
  chooseTrack(path: string): void {
    this.look(path);
    this.selection.chooseTrack(path);
  }

  /** Open a menu at a place in the window, pixels; without any entry there is none. */
  openMenu(menu: OpenMenu): void {
    if (menu.entries.length > 0) this.menu = menu;
  }

  /** Ask the server what interpolations there are. */
  async readWays(): Promise<void> {
    try {
      const response = await this.reina.api.request("GET", "/api/v1/parameters");
      const { interpolations } = (await response.json()) as ShowParameterList;
      this.ways = new Map(interpolations.map((each) => [each.name, each]));
    } catch (error) {
      this.reina.tell(error);
    }
  }

  /** Ask the server, once, how they run. */
  async readShapes(): Promise<void> {
    if (this.shapes.size > 0 || !this.editable) return;
    try {
      this.shapes = await readEasingShapes(this.curves, this.reina.parameters);
    } catch (error) {
      this.reina.tell(error);
    }
  }
}
