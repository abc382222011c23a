/** What is chosen for a film, and the film that is being made: one at a time, whether its panel is open or not. */

import type { CameraView, ScoreView, Tier } from "../scene";
import { blocksScore } from "../state/blocks-score";
import type { SessionView } from "../state/session-view.svelte";
import { askedTier } from "../state/tier";
import { AUDIO_BIT_RATES, type Coding, type Quality, bitRate, chooseCoding } from "./coding";
import { type Destination, chooseDestination, download } from "./destination";
import { askEncoders } from "./encoders";
import { fileName } from "./file-name";
import { type FilmProgress, makeFilm } from "./make-film";
import { type Aspect, type Fps, type PictureSize, pictureSize } from "./picture-size";
import { type FrameSpan, type SongSpan, countOf, faultOf, framesOf, secondsOf } from "./span";
import { drawStill } from "./still";
import { TimeLeft } from "./time-left";

export interface FilmChoices {
  /** The whole piece, the loop, or from a time to another. */
  readonly span: "whole" | "loop" | "part";
  /** As they are written. */
  readonly from: string;
  readonly to: string;
  readonly aspect: Aspect;
  readonly height: number;
  readonly fps: Fps;
  readonly quality: Quality;
  readonly detail: Tier;
  readonly camera: "show" | "mine";
  readonly sound: boolean;
  /** Of a still. */
  readonly transparent: boolean;
}

/** A film that is being made. */
export interface Making extends FilmProgress {
  readonly name: string;
  readonly of: number;
  readonly secondsLeft: number | null;
}

/** A film that was made. */
export interface Made {
  readonly name: string;
  readonly bytes: number;
  /** Null where it is on the disk. */
  readonly blob: Blob | null;
  /** The show or the cast was changed meanwhile. */
  readonly mixed: boolean;
}

const TYPES = { mp4: "video/mp4", webm: "video/webm" } as const;

export class FilmDesk {
  choices = $state.raw<FilmChoices>({
    span: "whole",
    from: "0:00",
    to: "0:10",
    aspect: "16:9",
    height: 1080,
    fps: 60,
    quality: "good",
    detail: askedTier(),
    camera: "show",
    sound: true,
    transparent: false,
  });
  making = $state.raw<Making | null>(null);
  made = $state.raw<Made | null>(null);
  trouble = $state.raw<string | null>(null);
  /** A still is being drawn. */
  drawing = $state(false);
  #cancel = new AbortController();

  readonly size: PictureSize = $derived(pictureSize(this.choices.aspect, this.choices.height));

  choose(change: Partial<FilmChoices>): void {
    this.choices = { ...this.choices, ...change };
  }

  /** The span that is chosen; the whole piece while there is no loop. */
  spanIn(view: SessionView): SongSpan {
    const { span, from, to } = this.choices;
    const { loop } = view.transport;
    if (span === "part") return { start: secondsOf(from), end: Math.min(secondsOf(to), view.duration) };
    if (span === "loop" && loop !== null) return { start: loop.start_s, end: Math.min(loop.end_s, view.duration) };
    return { start: 0, end: view.duration };
  }

  /** The frames that are chosen, or what is wrong with them. */
  framesIn(view: SessionView): FrameSpan | string {
    const span = this.spanIn(view);
    return faultOf(span, view.duration) ?? framesOf(span, this.choices.fps);
  }

  /**
   * How the film will be coded.
   *
   * @throws NoEncodersError without WebCodecs.
   */
  async coding(): Promise<Coding | null> {
    const { fps, quality, sound } = this.choices;
    return chooseCoding(await askEncoders(this.size, fps, quality), sound);
  }

  /** About how many bytes a film of so many frames takes. */
  bytesOf(frames: FrameSpan, { video, audio }: Coding): number {
    const { fps, quality } = this.choices;
    const bits = bitRate(quality, this.size, fps, video) + (audio === null ? 0 : AUDIO_BIT_RATES[audio]);
    return (bits * countOf(frames)) / fps / 8;
  }

  /**
   * Ask where the film goes and make it; to be called from a click or a key.
   *
   * @param mine the view that is seen.
   * @returns whether it was made; what went wrong stands in `trouble`.
   */
  async make(view: SessionView, coding: Coding, mine: CameraView | null): Promise<boolean> {
    const frames = this.framesIn(view);
    if (this.making !== null || typeof frames === "string") return false;
    const { choices, size } = this;
    const { title } = view.session;
    const name = fileName(title, coding.container);
    this.trouble = this.made = null;
    this.#cancel = new AbortController();
    const { signal } = this.#cancel;
    const of = countOf(frames);
    const left = new TimeLeft(of);
    const [show, cast] = [view.showTold, view.score];
    try {
      const chosen = await chooseDestination(name, TYPES[coding.container]);
      if (chosen === null) return false;
      const counted = new CountedDestination(chosen);
      this.making = { phase: "stage", done: 0, of, name, secondsLeft: null };
      addEventListener("beforeunload", askBeforeLeaving);
      const blob = await makeFilm(
        {
          session: view.id,
          title,
          score: scoreOf(view),
          frames,
          size,
          tier: choices.detail,
          quality: choices.quality,
          coding,
          view: choices.camera === "mine" ? mine : null,
        },
        {
          api: view.api,
          signal,
          destination: counted,
          onProgress: (progress) => {
            const drawn = progress.phase === "pictures";
            const secondsLeft = drawn ? left.mark(progress.done, performance.now() / 1000) : null;
            this.making = { ...progress, of, name, secondsLeft };
          },
        },
      );
      if (blob !== null) download(blob, name);
      this.made = { name, bytes: counted.bytes, blob, mixed: view.showTold !== show || view.score !== cast };
      return true;
    } catch (error) {
      if (!signal.aborted) this.trouble = inWords(error);
      return false;
    } finally {
      removeEventListener("beforeunload", askBeforeLeaving);
      this.making = null;
    }
  }

  /** Call the film off; nothing is left of it. */
  cancel(): void {
    this.#cancel.abort();
  }

  /** Draw what is seen, and hand it to the downloads. */
  async still(view: SessionView, mine: CameraView): Promise<void> {
    const { hello, drawn } = view;
    if (this.drawing || hello === null || drawn === null) return;
    this.drawing = true;
    this.trouble = null;
    const { transparent, detail } = this.choices;
    // The page draws on meanwhile, into the same floats.
    const frame = { ...drawn, floats: drawn.floats.slice() };
    try {
      const order = { hello, score: scoreOf(view), frame, view: mine, size: this.size, tier: detail, transparent };
      download(await drawStill(order), fileName(view.session.title, "png"));
    } catch (error) {
      this.trouble = inWords(error);
    } finally {
      this.drawing = false;
    }
  }
}

/** The page's own. */
export const filmDesk = new FilmDesk();

/** Counts what is written on the way. */
class CountedDestination implements Destination {
  bytes = 0;
  readonly #inner: Destination;

  constructor(inner: Destination) {
    this.#inner = inner;
  }

  write(...[chunk]: Parameters<Destination["write"]>): Promise<void> {
    this.bytes = Math.max(this.bytes, chunk.position + chunk.data.byteLength);
    return this.#inner.write(chunk);
  }

  finish(): Promise<Blob | null> {
    return this.#inner.finish();
  }

  discard(): Promise<void> {
    return this.#inner.discard();
  }
}

function scoreOf(view: SessionView): ScoreView {
  return blocksScore(view.score, view.cast.castings.length);
}

function inWords(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

function askBeforeLeaving(event: BeforeUnloadEvent): void {
  event.preventDefault();
}
