import { HEADER_SIZE } from "../generated/protocol";
import type { ShowMeasures } from "../editor/state/show-measures";
import type { Client, Commission, Commissioned } from "../film/commissioned-film";
import type { Stage } from "../scene";
import type { SessionView } from "./session-view.svelte";

/** Where the figures come from. */
export interface Measures {
  readonly stage: Stage;
  readonly view: () => SessionView | null;
  readonly drawn: () => boolean;
}

/** What the page says about itself, for tests and for whoever opens the console: `window.reina`. */
export interface PageMeasures {
  /** A picture of the open session has been drawn. */
  readonly drawn: boolean;
  readonly session: string | null;
  /** Index and epoch of the frame that was drawn last; a blend counts as the earlier of its two. */
  readonly drawnIndex: number;
  readonly drawnEpoch: number;
  readonly songTime: number;
  readonly epoch: number;
  readonly playing: boolean;
  /** The clock has been asked for something that is not answered yet. */
  readonly asking: boolean;
  readonly sound: string;
  /** How loud what leaves the page is, 0…1, and how many seconds of sound are decoded. */
  readonly soundLevel: number;
  readonly soundHeld: number;
  /** The share of the sound that the server has made; null once all of it is there. */
  readonly soundShare: number | null;
  /** Seconds from the page's clock to the server's, as it is gone by, and the least round trip that it rests on. */
  readonly clockOffset: number;
  readonly clockRoundTrip: number;
  /** Picture less sound, seconds: how many readings, their mean, and what 95 % of them stay within. */
  readonly sync: {
    readonly readings: number;
    readonly mean: number;
    readonly p95: number;
    /** The last of them, with how long each picture took from when it was drawn until it was seen. */
    readonly recent: readonly (readonly [difference: number, interval: number])[];
  };
  /** Seconds by which what is heard is ahead of the server's song time; null while nothing is. */
  readonly soundAhead: number | null;
  /** The song time that is heard, seconds; null while none is. */
  readonly heard: number | null;
  /** For how long the picture goes on with what is here, seconds, up to 2.5. */
  readonly ahead: number;
  /** Pictures drawn since the page was opened, and the draw calls of the last. */
  readonly pictures: number;
  readonly drawCalls: number;
  /** The rigs whose models stand on the stage. */
  readonly rigs: readonly string[];
  /** How many notes lie in each player's lane, and whose the strips follow, a place in the cast. */
  readonly laneNotes: readonly number[];
  readonly followed: number;
  /** Where the camera stood in the picture that was drawn last, in the world, metres. */
  readonly drawnFrom: readonly [number, number, number];
  /** What the show's editor says about itself, while it is open. */
  show?: ShowMeasures;
  /** Local joint rotations as three.js has them, x y z w. */
  boneQuaternions(): Record<string, [number, number, number, number]>;
  /** A parameter's floats in the frame that was drawn last; null where the session streams none of that path. */
  parameter(path: string): readonly number[] | null;
  /** Film the open session for a script; throws an Error in words for a person. */
  film(commission: Commission, client: Client, signal: AbortSignal): Promise<Commissioned>;
}

declare global {
  interface Window {
    reina?: PageMeasures;
  }
}

/** Put the figures on the window; returns what takes them away again. */
export function publishMeasures({ stage, view, drawn }: Measures): () => void {
  window.reina = {
    get drawn() {
      return drawn();
    },
    get session() {
      return view()?.id ?? null;
    },
    get drawnIndex() {
      return stage.drawnIndex;
    },
    get drawnEpoch() {
      return view()?.drawn?.epoch ?? -1;
    },
    get songTime() {
      return view()?.songTime ?? 0;
    },
    get epoch() {
      return view()?.transport.epoch ?? 0;
    },
    get playing() {
      return view()?.playing ?? false;
    },
    get asking() {
      return view()?.asking ?? false;
    },
    get sound() {
      return view()?.sound ?? "silent";
    },
    get soundLevel() {
      return view()?.soundLevel ?? 0;
    },
    get soundHeld() {
      return view()?.soundHeld ?? 0;
    },
    get soundShare() {
      return view()?.soundShare ?? null;
    },
    get clockOffset() {
      const now = performance.now() / 1000;
      return (view()?.clock.serverTime(now) ?? now) - now;
    },
    get clockRoundTrip() {
      return view()?.clock.roundTrip ?? Infinity;
    },
    get sync() {
      const sync = view()?.sync;
      return {
        readings: sync?.count ?? 0,
        mean: sync?.mean ?? 0,
        p95: sync?.within(0.95) ?? 0,
        recent: sync?.recent ?? [],
      };
    },
    get soundAhead() {
      return view()?.soundAhead ?? null;
    },
    get heard() {
      return view()?.heard ?? null;
    },
    get ahead() {
      return view()?.ahead ?? 0;
    },
    get pictures() {
      return stage.pictures;
    },
    get drawCalls() {
      return stage.cost.calls;
    },
    get rigs() {
      return stage.rigs;
    },
    get laneNotes() {
      return stage.laneNotes;
    },
    get followed() {
      return view()?.cast.followed ?? 0;
    },
    get drawnFrom() {
      return stage.drawnFrom;
    },
    boneQuaternions: () => stage.boneQuaternions(),
    parameter: (path) => parameterOf(view(), path),
    film: async (...given) => {
      const session = view();
      if (session === null) throw new Error("No session is open here");
      return (await import("../film/commissioned-film")).film(session, ...given, stage.currentView());
    },
  };
  return () => delete window.reina;
}

function parameterOf(view: SessionView | null, path: string): readonly number[] | null {
  const layout = view?.hello?.parameters.find((parameter) => parameter.path === path);
  const floats = view?.drawn?.floats;
  if (layout === undefined || floats === undefined) return null;
  const first = (layout.offset - HEADER_SIZE) / Float32Array.BYTES_PER_ELEMENT;
  return [...floats.subarray(first, first + layout.length)];
}
