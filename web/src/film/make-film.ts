/** Draws a film frame by frame, off the clock, and encodes it: as slowly as it must, so that none is left out. */

import {
  AudioSample,
  AudioSampleSource,
  CanvasSource,
  Mp4OutputFormat,
  Output,
  StreamTarget,
  type StreamTargetChunk,
  WebMOutputFormat,
} from "mediabunny";

import type { ReinaApi } from "../connection";
import type { Hello } from "../generated/protocol";
import type { CameraView, ScoreView, Tier } from "../scene";
import type { Coding, Quality } from "./coding";
import type { Destination } from "./destination";
import { encoderDelay } from "./encoder-delay";
import { audioQuality, videoQuality } from "./encoders";
import { FilmStage } from "./film-stage";
import { readFrames } from "./frames";
import { holdView } from "./held-view";
import type { PictureSize } from "./picture-size";
import { type FilmSound, SAMPLE_RATE, loadSound } from "./sound";
import { countOf, type FrameSpan } from "./span";

/** What is filmed and how. */
export interface FilmOrder {
  readonly session: string;
  readonly title: string;
  readonly score: ScoreView;
  readonly frames: FrameSpan;
  readonly size: PictureSize;
  readonly tier: Tier;
  readonly quality: Quality;
  readonly coding: Coding;
  /** A view to hold through the film; null films with the show's cameras. */
  readonly view: CameraView | null;
}

/** How far a film is. */
export interface FilmProgress {
  /** `sound` is waited for first, then the stage is set, then its pictures are drawn; at last the file is closed. */
  readonly phase: "sound" | "stage" | "pictures" | "closing";
  /** Of the sound, the share that the server has made; of the pictures, how many are drawn. */
  readonly done: number;
}

export interface FilmWork {
  readonly api: ReinaApi;
  readonly destination: Destination;
  readonly signal: AbortSignal;
  onProgress(progress: FilmProgress): void;
}

/** The sound goes into the file ahead of the picture by pieces of this many samples. */
const SOUND_PIECE = SAMPLE_RATE / 2;
/** Of Opus, whose packets are the shorter, samples a packet. */
const SHORTEST_PACKET = 480;
/** Writes are gathered to this many bytes. */
const WRITE_BYTES = 4 * 2 ** 20;

/**
 * Make a film.
 *
 * When it fails or is called off, nothing is left of it, neither in memory nor at its destination.
 *
 * @returns the film where it is to be downloaded; null where it is on the disk.
 */
export async function makeFilm(order: FilmOrder, work: FilmWork): Promise<Blob | null> {
  try {
    await draw(order, work);
    return await work.destination.finish();
  } catch (error) {
    await work.destination.discard().catch(() => undefined);
    throw error;
  }
}

async function draw(order: FilmOrder, work: FilmWork): Promise<void> {
  const { api, signal } = work;
  const onProgress = (progress: FilmProgress): void => work.onProgress(progress);
  const { fps, first } = order.frames;
  const count = countOf(order.frames);
  const answer = await api.request("GET", `${api.sessionPath(order.session, "manifest")}?fps=${fps}`, { signal });
  const hello = (await answer.json()) as Hello;
  let sound: FilmSound | null = null;
  if (order.coding.audio !== null) {
    onProgress({ phase: "sound", done: 0 });
    const span = { start: first / fps, seconds: count / fps };
    sound = await loadSound(api, hello.song.href, span, signal, (done) => onProgress({ phase: "sound", done }));
  }
  onProgress({ phase: "stage", done: 0 });
  const stage = await FilmStage.open(hello, order.score, order);
  const file = new FilmFile(order, stage.canvas, sound, work.destination);
  try {
    await file.begin();
    const hold = order.view === null ? null : holdView(hello.parameters, order.view);
    let done = 0;
    for await (const frame of readFrames(api, order.session, hello, order.frames, signal)) {
      hold?.(frame.floats);
      stage.draw(frame);
      // The picture is taken from the canvas at once, and then waits for the encoder.
      await file.addPicture(done / fps, 1 / fps);
      done += 1;
      onProgress({ phase: "pictures", done });
      await nextTask();
    }
    onProgress({ phase: "closing", done });
    await file.end();
  } catch (error) {
    await file.cancel();
    throw error;
  } finally {
    stage.dispose();
  }
}

/** The file: its picture, its sound and its container. */
class FilmFile {
  readonly #coding: Coding;
  readonly #output: Output;
  readonly #picture: CanvasSource;
  readonly #voice: AudioSampleSource | null;
  readonly #sound: FilmSound | null;
  /** Samples of the sound that are in the file. */
  #sounded = 0;
  /** Samples that the encoder puts before the sound, which is sent so much ahead. */
  #delay = 0;

  constructor(order: FilmOrder, canvas: HTMLCanvasElement, sound: FilmSound | null, destination: Destination) {
    const { coding, size, quality, frames } = order;
    const { fps } = frames;
    this.#coding = coding;
    this.#sound = sound;
    // Its own head and index stand first in an MP4, so that it plays while it is still being loaded.
    const format = coding.container === "mp4" ? new Mp4OutputFormat({ fastStart: "reserve" }) : new WebMOutputFormat();
    // Called off, mediabunny closes what it writes to; what becomes of the file is the destination's to say.
    const writable = new WritableStream<StreamTargetChunk>({ write: (chunk) => destination.write(chunk) });
    const target = new StreamTarget(writable, { chunked: true, chunkSize: WRITE_BYTES });
    this.#output = new Output({ format, target });
    this.#picture = new CanvasSource(canvas, {
      codec: coding.video,
      quality: videoQuality(coding.video, size, fps, quality),
    });
    this.#output.addVideoTrack(this.#picture, { frameRate: fps, maximumPacketCount: countOf(frames) });
    this.#voice = null;
    if (coding.audio !== null && sound !== null) {
      this.#voice = new AudioSampleSource({ codec: coding.audio, quality: audioQuality(coding.audio) });
      const packets = Math.ceil(sound.length / SHORTEST_PACKET) + 16;
      this.#output.addAudioTrack(this.#voice, { maximumPacketCount: packets });
    }
    this.#output.setMetadataTags({ title: order.title });
  }

  async begin(): Promise<void> {
    const { audio, container } = this.#coding;
    if (audio !== null && this.#sound !== null) {
      this.#delay = await encoderDelay(audio, this.#sound.channels, SAMPLE_RATE);
      // What stands before an MP4's beginning is taken away by its edit list; WebM has none, and loses these milliseconds.
      if (container === "webm") this.#sounded = this.#delay;
    }
    await this.#output.start();
  }

  /** Take the picture that is on the canvas, with the sound up to its end; waits while the encoders are behind. */
  async addPicture(at: number, duration: number): Promise<void> {
    const taken = this.#picture.add(at, duration);
    await Promise.all([taken, this.#addSound((at + duration) * SAMPLE_RATE)]);
  }

  async #addSound(until: number): Promise<void> {
    const [sound, voice] = [this.#sound, this.#voice];
    if (sound === null || voice === null) return;
    while (this.#sounded < Math.min(until, sound.length)) {
      const from = this.#sounded;
      const to = Math.min(from + SOUND_PIECE, sound.length);
      this.#sounded = to;
      const sample = new AudioSample({
        data: sound.planes(from, to),
        format: "f32-planar",
        numberOfChannels: sound.channels,
        sampleRate: SAMPLE_RATE,
        timestamp: (from - this.#delay) / SAMPLE_RATE,
      });
      try {
        await voice.add(sample);
      } finally {
        sample.close();
      }
    }
  }

  async end(): Promise<void> {
    await this.#output.finalize();
  }

  /** Close the encoders; what went wrong before is what is told. */
  async cancel(): Promise<void> {
    await this.#output.cancel().catch(() => undefined);
  }
}

const channel = new MessageChannel();

/** Let the page breathe; timers would be slowed down to one a second while it is in the background. */
function nextTask(): Promise<void> {
  return new Promise((resolve) => {
    channel.port1.onmessage = () => resolve();
    channel.port2.postMessage(null);
  });
}
