/** How a film is coded: the first of each kind that the browser can make and the container can hold. */

import { film } from "../words/film/en";
import type { PictureSize } from "./picture-size";

export const CONTAINERS = ["mp4", "webm"] as const;
export type Container = (typeof CONTAINERS)[number];
export type VideoCodec = "avc" | "vp9" | "av1";
export type AudioCodec = "aac" | "opus";

export interface Coding {
  readonly container: Container;
  readonly video: VideoCodec;
  /** Null for a film without sound. */
  readonly audio: AudioCodec | null;
}

/** What a browser can encode. */
export interface Encoders {
  readonly video: ReadonlySet<VideoCodec>;
  readonly audio: ReadonlySet<AudioCodec>;
}

/** What each container may hold, what more players play first. */
const HOLDS: Readonly<
  Record<Container, { readonly video: readonly VideoCodec[]; readonly audio: readonly AudioCodec[] }>
> = {
  mp4: { video: ["avc", "vp9", "av1"], audio: ["aac", "opus"] },
  webm: { video: ["vp9", "av1"], audio: ["opus"] },
};

export const VIDEO_CODECS = HOLDS.mp4.video;
export const AUDIO_CODECS = HOLDS.mp4.audio;

/** What each codec is called. */
export const CODEC_NAMES: Readonly<Record<VideoCodec | AudioCodec, string>> = {
  avc: "H.264",
  vp9: "VP9",
  av1: "AV1",
  aac: "AAC",
  opus: "Opus",
};

export const CONTAINER_NAMES: Readonly<Record<Container, string>> = { mp4: "MP4", webm: "WebM" };

/**
 * The coding for what a browser can encode.
 *
 * @param container the one that is asked for; null leaves the choice: MP4 with H.264, else WebM.
 * @returns null where the browser can encode nothing of what it takes.
 */
export function chooseCoding(encoders: Encoders, sound: boolean, container: Container | null = null): Coding | null {
  const first = (asked: Container): Coding | null => {
    const video = HOLDS[asked].video.find((codec) => encoders.video.has(codec));
    const audio = HOLDS[asked].audio.find((codec) => encoders.audio.has(codec));
    if (video === undefined || (sound && audio === undefined)) return null;
    return { container: asked, video, audio: sound ? (audio ?? null) : null };
  };
  if (container !== null) return first(container);
  const mp4 = first("mp4");
  return mp4?.video === "avc" ? mp4 : (first("webm") ?? mp4);
}

/** How a coding is told: `MP4, H.264 and AAC`. */
export function codingName({ container, video, audio }: Coding): string {
  const picture = `${CONTAINER_NAMES[container]}, ${CODEC_NAMES[video]}`;
  return audio === null ? film.silent({ picture }) : film.withSound({ picture, sound: CODEC_NAMES[audio] });
}

export const QUALITIES = ["small", "good", "best"] as const;
export type Quality = (typeof QUALITIES)[number];

/** Bits a second of H.264 at 1920 × 1080 and 30 pictures a second. */
const BIT_RATES: Readonly<Record<Quality, number>> = { small: 3e6, good: 8e6, best: 20e6 };
const REFERENCE_PIXELS = 1920 * 1080;
const REFERENCE_FPS = 30;
/** How many of H.264's bits a codec needs for a like picture. */
const THRIFT: Readonly<Record<VideoCodec, number>> = { avc: 1, vp9: 0.7, av1: 0.55 };
/** Of the sound, bits a second. */
export const AUDIO_BIT_RATES: Readonly<Record<AudioCodec, number>> = { aac: 192_000, opus: 160_000 };

/**
 * Bits a second of the picture. Larger pictures are smoother and quicker ones more alike, so that neither takes bits
 * in proportion: exponents 0.9 and 0.6.
 */
export function bitRate(quality: Quality, { width, height }: PictureSize, fps: number, codec: VideoCodec): number {
  const size = ((width * height) / REFERENCE_PIXELS) ** 0.9;
  return Math.round(BIT_RATES[quality] * size * (fps / REFERENCE_FPS) ** 0.6 * THRIFT[codec]);
}
