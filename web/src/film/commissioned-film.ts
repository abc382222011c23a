/** A film for whoever drives the page by a script, as `reina film` does. */

import { ASPECTS, type Aspect, FPS, LARGEST_HEIGHT, pictureSize, SMALLEST_HEIGHT } from "./picture-size";
import { type Container, QUALITIES, type Quality, chooseCoding, codingName } from "./coding";
import type { Chunk } from "./destination";
import { askEncoders } from "./encoders";
import { type FilmProgress, makeFilm } from "./make-film";
import { countOf, faultOf, framesOf } from "./span";
import { TimeLeft } from "./time-left";
import { blocksScore } from "../state/blocks-score";
import type { SessionView } from "../state/session-view.svelte";
import type { CameraView, Tier } from "../scene";

/** What is asked for; plain values, so that a script can say them. */
export interface Commission {
  /** Song times, seconds; null is the music's end. */
  readonly start: number;
  readonly end: number | null;
  readonly aspect: Aspect;
  readonly height: number;
  readonly fps: number;
  readonly quality: Quality;
  readonly detail: Tier;
  /** The show's cameras, or the view that the page shows. */
  readonly camera: "show" | "mine";
  readonly sound: boolean;
  /** Null leaves the choice. */
  readonly container: Container | null;
}

/** Where the film goes, piece by piece, and how far it is. */
export interface Client {
  write(chunk: Chunk): Promise<void>;
  tell(progress: FilmProgress & { readonly of: number; readonly secondsLeft: number | null }): void;
}

/** What was made. */
export interface Commissioned {
  readonly frames: number;
  readonly width: number;
  readonly height: number;
  /** `MP4, H.264 and AAC`. */
  readonly coding: string;
}

/**
 * Film the session that is open.
 *
 * @param mine the view that the page shows.
 * @throws Error in words for a person, when it cannot be made.
 */
export async function film(
  session: SessionView,
  commission: Commission,
  client: Client,
  signal: AbortSignal,
  mine: CameraView,
): Promise<Commissioned> {
  const { aspect, height, fps, quality, container, sound } = commission;
  const span = { start: commission.start, end: Math.min(commission.end ?? Infinity, session.duration) };
  const fault = faultOf(span, session.duration);
  if (fault !== null) throw new Error(`${fault}; the music lasts ${session.duration.toFixed(2)} s`);
  if (!ASPECTS.includes(aspect)) throw new Error(`The aspect is ${ASPECTS.join(", ")}`);
  if (!(FPS as readonly number[]).includes(fps)) throw new Error(`A film has ${FPS.join(" or ")} frames a second`);
  if (!QUALITIES.includes(quality)) throw new Error(`The quality is ${QUALITIES.join(", ")}`);
  if (!(height >= SMALLEST_HEIGHT && height <= LARGEST_HEIGHT)) {
    throw new Error(`The height is ${SMALLEST_HEIGHT} to ${LARGEST_HEIGHT}`);
  }
  const size = pictureSize(aspect, height);
  const encoders = await askEncoders(size, fps, quality);
  const coding = chooseCoding(encoders, sound, container);
  if (coding === null)
    throw new Error(`This browser encodes no ${container ?? "film"} of ${size.width} × ${size.height}`);
  const frames = framesOf(span, fps);
  const of = countOf(frames);
  const left = new TimeLeft(of);
  await makeFilm(
    {
      session: session.id,
      title: session.session.title,
      score: blocksScore(session.score, session.cast.castings.length),
      frames,
      size,
      tier: commission.detail,
      quality,
      coding,
      view: commission.camera === "mine" ? mine : null,
    },
    {
      api: session.api,
      signal,
      destination: {
        write: (chunk) => client.write(chunk),
        finish: () => Promise.resolve(null),
        discard: () => Promise.resolve(),
      },
      onProgress: (progress) => {
        const secondsLeft = progress.phase === "pictures" ? left.mark(progress.done, performance.now() / 1000) : null;
        client.tell({ ...progress, of, secondsLeft });
      },
    },
  );
  return { frames: of, ...size, coding: codingName(coding) };
}
