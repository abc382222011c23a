/** The song's sound of a film's span. */

import type { ReinaApi } from "../connection";
import { loadWhole } from "../sound";
import { film } from "../words/film/en";

/** What encoders of AAC and Opus both take. */
export const SAMPLE_RATE = 48_000;
/** As many channels as every player plays. */
const MAX_CHANNELS = 2;

/** Sound, cut to a span. */
export interface FilmSound {
  /** One or two. */
  readonly channels: number;
  /** At SAMPLE_RATE. */
  readonly length: number;
  /** Samples from … to, the channels one after the other; silence after the song's end. */
  planes(from: number, to: number): Float32Array<ArrayBuffer>;
}

/**
 * A session's song, decoded by the browser as for playing, so that it lies in time as it is heard.
 *
 * @param onProgress told the share of it that the server has made, 0…1
 * @throws ProblemError when there is none
 */
export async function loadSound(
  api: ReinaApi,
  href: string,
  span: { readonly start: number; readonly seconds: number },
  signal: AbortSignal,
  onProgress: (share: number) => void,
): Promise<FilmSound> {
  const bytes = await loadWhole(api, href, signal, onProgress);
  signal.throwIfAborted();
  const song = await decode(bytes);
  signal.throwIfAborted();
  const first = Math.round(span.start * SAMPLE_RATE);
  const length = Math.round(span.seconds * SAMPLE_RATE);
  // Only what the film needs is kept, once: the whole song may be hundreds of megabytes.
  const whole = first === 0 && length >= song.length;
  const channels = Array.from({ length: song.numberOfChannels }, (_, channel) => {
    const samples = song.getChannelData(channel);
    return whole ? samples : samples.slice(first, first + length);
  });
  return cutSound(channels, length);
}

/** Sound of so many samples, from channels that may end sooner. */
export function cutSound(channels: readonly Float32Array[], length: number): FilmSound {
  return {
    channels: channels.length,
    length,
    planes(from, to) {
      const size = to - from;
      const planes = new Float32Array(size * channels.length);
      channels.forEach((samples, channel) => {
        planes.set(samples.subarray(Math.min(from, samples.length), Math.min(to, samples.length)), channel * size);
      });
      return planes;
    },
  };
}

async function decode(bytes: ArrayBuffer): Promise<AudioBuffer> {
  const context = new OfflineAudioContext(MAX_CHANNELS, 1, SAMPLE_RATE);
  const song = await context.decodeAudioData(bytes).catch(() => {
    throw new Error(film.cannotDecode);
  });
  return song.numberOfChannels <= MAX_CHANNELS ? song : mixDown(song);
}

/** Surround sound as it is heard from two loudspeakers. */
function mixDown(song: AudioBuffer): Promise<AudioBuffer> {
  const context = new OfflineAudioContext(MAX_CHANNELS, song.length, song.sampleRate);
  const source = new AudioBufferSourceNode(context, { buffer: song });
  source.connect(context.destination);
  source.start();
  return context.startRendering();
}
