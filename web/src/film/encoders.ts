/** What the browser can encode; asked of WebCodecs by `isConfigSupported`. */

import { Quality, canEncodeAudio, canEncodeVideo } from "mediabunny";

import { AUDIO_BIT_RATES, AUDIO_CODECS, type AudioCodec, type Encoders, VIDEO_CODECS, type VideoCodec } from "./coding";
import { bitRate, type Quality as FilmQuality } from "./coding";
import type { PictureSize } from "./picture-size";
import { SAMPLE_RATE } from "./sound";
import { film } from "../words/film/en";

/** This browser has no WebCodecs, or not here. */
export class NoEncodersError extends Error {
  override readonly name = "NoEncodersError";
}

/**
 * Ask which codecs the browser encodes pictures of a size and sound with.
 *
 * @throws NoEncodersError without WebCodecs.
 */
export async function askEncoders(size: PictureSize, fps: number, quality: FilmQuality): Promise<Encoders> {
  requireWebCodecs();
  const video = await those(VIDEO_CODECS, (codec) =>
    canEncodeVideo(codec, {
      ...size,
      frameRate: fps,
      quality: videoQuality(codec, size, fps, quality),
    }),
  );
  const audio = await those(AUDIO_CODECS, (codec) =>
    canEncodeAudio(codec, { numberOfChannels: 2, sampleRate: SAMPLE_RATE, quality: audioQuality(codec) }),
  );
  return { video, audio };
}

/** The bits that a film's pictures get. */
export function videoQuality(codec: VideoCodec, size: PictureSize, fps: number, quality: FilmQuality): Quality {
  return new Quality({ bitrate: bitRate(quality, size, fps, codec) });
}

/** The bits that a film's sound gets. */
export function audioQuality(codec: AudioCodec): Quality {
  return new Quality({ bitrate: AUDIO_BIT_RATES[codec] });
}

function requireWebCodecs(): void {
  if (typeof VideoEncoder !== "undefined" && typeof AudioEncoder !== "undefined") return;
  throw new NoEncodersError(isSecureContext ? film.noWebCodecs : film.notSecure);
}

async function those<T>(all: readonly T[], can: (one: T) => Promise<boolean>): Promise<ReadonlySet<T>> {
  const answers = await Promise.all(all.map(can));
  return new Set(all.filter((_, place) => answers[place] === true));
}
