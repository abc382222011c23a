import { ProblemError } from "../connection";
import type { AlignedBar, Alignment, AlignmentDocument } from "../generated/protocol";
import type { SessionView } from "../state/session-view.svelte";
import { correctionsOf, NOTHING, previewed, sameCorrections, toMillisecond, type Corrections } from "./corrections";
import { History } from "./history";
import { readTaps, type TapReading } from "./taps";

/** What stood at a time: what was put right, and the whole map where a file brought another. */
interface Step {
  readonly corrections: Corrections;
  readonly document: AlignmentDocument | null;
  /** Counts the maps that files brought. */
  readonly map: number;
}

/** How something is put: going through what was, or as a map of a file's. */
interface Putting {
  readonly going?: History<Step>;
  readonly isMap?: boolean;
}

/** Changes by keys are gathered for so long before they are put. */
const REST_MS = 350;

/** A session's score in its recording: what is known, what is being put right, and what was. */
export class InTime {
  /** What the server knows; null until it has said it. */
  known = $state.raw<Alignment | null>(null);
  /** What is to be put, as it is seen already. */
  proposed = $state.raw<Corrections | null>(null);
  /** Why the server did not take what was put, by place. */
  refused = $state.raw<{ readonly title: string; readonly lines: readonly string[] } | null>(null);
  /** Song times of taps; null while nobody taps. */
  taps = $state.raw<readonly number[] | null>(null);
  /** The bar that begins at the first tap, a place in `bars`; null for the nearest beat. */
  firstBar = $state<number | null>(null);
  /** Whether the bars beside one that is put stay where they are. */
  around = $state(true);
  /** Something is on its way to the server. */
  busy = $state(false);

  readonly bars: readonly AlignedBar[] = $derived(this.known?.bars ?? []);
  readonly corrections: Corrections = $derived(correctionsOf(this.known?.alignment ?? null));
  /** Length of the recording, seconds. */
  readonly duration: number = $derived.by(() => this.known?.song_duration_s ?? this.#view.duration);
  /** What the taps say; null while there are too few. */
  readonly reading: TapReading | null = $derived.by(() => {
    if (this.taps === null) return null;
    const { taps, bars, corrections, firstBar, around, duration } = this;
    return readTaps({ taps, bars, corrections, firstBar, around, duration });
  });
  /** What is seen: what is proposed, else what the taps say, else what stands. */
  readonly seen: Corrections = $derived(this.proposed ?? this.reading?.corrections ?? this.corrections);
  /** Where each bar line is seen, seconds of the recording. */
  readonly lines: readonly number[] = $derived(previewed(this.bars, this.corrections, this.seen));

  readonly #view: SessionView;
  #history = $state.raw<History<Step>>(new History<Step>({ corrections: NOTHING, document: null, map: 0 }, sameStep));
  #begun = false;
  #map = 0;
  #maps = 0;
  #resting: ReturnType<typeof setTimeout> | undefined;
  #putting: Promise<void> = Promise.resolve();
  #readings = 0;

  constructor(view: SessionView) {
    this.#view = view;
  }

  get canUndo(): boolean {
    return this.#history.undone !== null;
  }

  get canRedo(): boolean {
    return this.#history.redone !== null;
  }

  /** Ask the server what is known. */
  async read(): Promise<void> {
    const reading = ++this.#readings;
    const { api, id } = this.#view;
    try {
      const answer = await api.request("GET", api.sessionPath(id, "alignment"));
      const known = (await answer.json()) as Alignment;
      if (reading === this.#readings && !this.busy) this.#take(known);
    } catch (error) {
      this.#refuse(error);
    }
  }

  /** Show what would be put; null for what stands. */
  show(corrections: Corrections | null): void {
    clearTimeout(this.#resting);
    this.proposed = corrections;
  }

  /** Show what is to be put, and put it once nothing more has come for a while. */
  propose(corrections: Corrections): void {
    this.proposed = corrections;
    clearTimeout(this.#resting);
    this.#resting = setTimeout(() => void this.commit(), REST_MS);
  }

  /** Put what is proposed now. */
  async commit(): Promise<void> {
    clearTimeout(this.#resting);
    const { proposed } = this;
    if (proposed !== null) await this.put(proposed);
  }

  /** Put corrections: one step. */
  put(corrections: Corrections): Promise<void> {
    this.proposed = corrections;
    return this.#put(corrections);
  }

  /** Take back all that was put right. */
  takeBackAll(): Promise<void> {
    return this.put(NOTHING);
  }

  undo(): Promise<void> {
    return this.#goTo(this.#history.undone);
  }

  redo(): Promise<void> {
    return this.#goTo(this.#history.redone);
  }

  /** Put a whole map from a file. */
  async open(file: File): Promise<void> {
    let document: unknown;
    try {
      document = JSON.parse(await file.text());
    } catch (error) {
      this.#refuse(error);
      return;
    }
    await this.#put(document, { isMap: true });
  }

  /** Let the server look for the score in the recording anew. */
  async search(): Promise<void> {
    const { api, id, token } = this.#view;
    if (token === null) return;
    this.refused = null;
    try {
      const answer = await api.request("POST", api.sessionPath(id, "alignment/search"), { token });
      this.#view.followAlignment((await answer.json()) as Alignment);
    } catch (error) {
      this.#refuse(error);
    }
  }

  /** Begin to tap. */
  startTaps(): void {
    this.refused = null;
    this.proposed = null;
    this.taps = [];
  }

  /** A beat is heard at a song time, seconds. */
  tap(songTime: number): void {
    const { taps } = this;
    if (taps === null) return;
    const last = taps.at(-1);
    // Whoever goes back begins anew.
    this.taps = last !== undefined && songTime <= last ? [songTime] : [...taps, toMillisecond(songTime)];
  }

  /** Put what the taps say. */
  async keepTaps(): Promise<void> {
    const { reading } = this;
    if (reading !== null) await this.put(reading.corrections);
    this.taps = null;
  }

  discardTaps(): void {
    this.taps = null;
  }

  /** Nothing waits any longer. */
  close(): void {
    void this.commit();
  }

  async #goTo(history: History<Step> | null): Promise<void> {
    if (history === null) return;
    const now = this.#history.present;
    const { corrections, document, map } = history.present;
    this.proposed = null;
    clearTimeout(this.#resting);
    await this.#put(map === now.map || document === null ? corrections : document, { going: history });
  }

  #put(body: unknown, how: Putting = {}): Promise<void> {
    this.#putting = this.#putting.then(() => this.#send(body, how));
    return this.#putting;
  }

  async #send(body: unknown, { going, isMap = false }: Putting): Promise<void> {
    const { api, id, token } = this.#view;
    if (token === null) return;
    this.busy = true;
    this.refused = null;
    try {
      const answer = await api.request("PUT", api.sessionPath(id, "alignment"), { json: body, token });
      this.#readings += 1;
      if (isMap) this.#map = this.#maps += 1;
      if (going !== undefined) {
        this.#history = going;
        this.#map = going.present.map;
      }
      this.#take((await answer.json()) as Alignment);
    } catch (error) {
      this.#refuse(error);
    } finally {
      this.busy = false;
      if (this.proposed === body) this.proposed = null;
    }
  }

  #take(known: Alignment): void {
    this.known = known;
    const step = { corrections: correctionsOf(known.alignment), document: known.alignment, map: this.#map };
    if (this.#begun) this.#history = this.#history.take(step);
    else this.#history = new History<Step>(step, sameStep);
    this.#begun = true;
  }

  #refuse(error: unknown): void {
    this.refused =
      error instanceof ProblemError
        ? {
            title: error.title,
            lines: [
              ...(error.detail === "" ? [] : [error.detail]),
              ...error.errors.map(({ location, detail }) => (location === null ? detail : `${location}: ${detail}`)),
            ],
          }
        : { title: error instanceof Error ? error.message : String(error), lines: [] };
  }
}

function sameStep(one: Step, other: Step): boolean {
  return one.map === other.map && sameCorrections(one.corrections, other.corrections);
}
