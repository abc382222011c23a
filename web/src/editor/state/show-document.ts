/** A show as its JSON has it; what the page does not edit is carried along as it stands. */
export interface ShowDocument {
  readonly version: number;
  readonly title: string;
  readonly time: TimeUnit;
  readonly markers?: readonly ShowMarker[];
  readonly tracks: readonly ShowTrack[];
}

export const TIME_UNITS = ["bars", "beats", "seconds"] as const;
export type TimeUnit = (typeof TIME_UNITS)[number];

/** What a track does before its first keyframe and after its last. */
export const EXTRAPOLATIONS = ["hold", "loop", "ping_pong", "extrapolate"] as const;

/** A named place, in the show's unit of time. */
export interface ShowMarker {
  readonly time: number;
  readonly name: string;
}

export interface ShowTrack {
  readonly parameter: string;
  /** The unit of its keyframes' times; the show's where it names none. */
  readonly time?: TimeUnit;
  readonly before?: string;
  readonly after?: string;
  readonly color_space?: string;
  readonly muted?: boolean;
  readonly solo?: boolean;
  readonly events?: ShowEvents;
  readonly keyframes: readonly ShowKeyframe[];
}

/** How a track answers the music. */
export interface ShowEvents {
  readonly on: "notes" | "beats" | "bars";
  readonly where?: EventFilter;
  readonly every?: number;
  readonly attack?: number;
  readonly hold?: number;
  readonly decay?: number;
  readonly amount?: unknown;
  readonly by_velocity?: boolean;
  readonly blend?: string;
  readonly cycle?: readonly unknown[];
}

export interface EventFilter {
  readonly part?: number;
  readonly pitch?: readonly [number, number];
  readonly velocity?: readonly [number, number];
  readonly valves?: readonly number[];
}

export interface ShowKeyframe {
  readonly key: string;
  readonly time: number;
  readonly value: unknown;
  readonly interpolation?: string;
  readonly handles?: readonly number[];
  readonly in_tangent?: number | readonly number[];
  readonly out_tangent?: number | readonly number[];
  /** Options of its interpolation. */
  readonly [option: string]: unknown;
}

/** The track of a parameter, or null. */
export function trackOf(document: ShowDocument | null, path: string): ShowTrack | null {
  return document?.tracks.find(({ parameter }) => parameter === path) ?? null;
}
