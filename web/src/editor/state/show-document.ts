import type * as wire from "../../generated/show";

/** A keyframe as the server writes it: it always has its key. */
export type ShowKeyframe = wire.ShowKeyframe & {
  readonly key: string;
  /** Of a Bézier curve; the page has handles to drag. */
  readonly handles?: readonly number[];
};

export interface ShowTrack extends Omit<wire.ShowTrack, "keyframes"> {
  readonly keyframes: readonly ShowKeyframe[];
}

/** A show as the server writes it; what the page does not edit is carried along as it stands. */
export interface ShowDocument extends Omit<wire.ShowDocument, "tracks"> {
  readonly title: string;
  readonly time: TimeUnit;
  readonly tracks: readonly ShowTrack[];
}

export const TIME_UNITS = ["bars", "beats", "seconds"] as const satisfies wire.ShowDocument["time"][];
export type TimeUnit = NonNullable<wire.ShowDocument["time"]>;

/** What a track does before its first keyframe and after its last. */
export const EXTRAPOLATIONS = ["hold", "loop", "ping_pong", "extrapolate"] as const satisfies wire.ShowTrack["after"][];

/** The track of a parameter, or null. */
export function trackOf(document: ShowDocument | null, path: string): ShowTrack | null {
  return document?.tracks.find(({ parameter }) => parameter === path) ?? null;
}
