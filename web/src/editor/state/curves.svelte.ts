import type { ReinaApi } from "../../connection";
import type { ShowCurve, ShowCurves } from "../../generated/protocol";
import type { ShowTrack } from "./show-document";

/** A parameter's curve as the server has sampled it, over evenly spaced song times. */
export interface SampledCurve {
  readonly from: number;
  readonly to: number;
  /** A list a component. */
  readonly values: readonly (readonly number[])[];
  /** Indices between which and the one before the value jumps. */
  readonly jumps: readonly number[];
}

/** What of curves is to be seen. */
export interface CurvesAsked {
  readonly paths: readonly string[];
  readonly from: number;
  readonly to: number;
  readonly points: number;
}

const MAX_SAMPLES = 40_000;
const MAX_PATHS = 64;
/** A track of more keyframes may be larger than the server takes for a preview, a megabyte. */
const MAX_PREVIEWED = 4000;

/** Reads curves from the server: those of the show, and of a track as it would be. */
export class CurveReader {
  readonly #api: Pick<ReinaApi, "request" | "sessionPath">;
  readonly #session: string;
  readonly #token: string | null;

  constructor(api: Pick<ReinaApi, "request" | "sessionPath">, session: string, token: string | null) {
    this.#api = api;
    this.#session = session;
    this.#token = token;
  }

  /** Curves of the show as it is, by parameter. */
  async read({ paths, from, to, points }: CurvesAsked, signal: AbortSignal): Promise<Map<string, SampledCurve>> {
    return byPath(await this.#ofShow({ paths, from, to, points }, signal));
  }

  /** What the keyframes alone of a track give, without its answer to the music, in the show as it is. */
  async ofKeys(path: string, from: number, to: number, points: number): Promise<SampledCurve | null> {
    return byPath(await this.#ofShow({ paths: [path], from, to, points }), ({ keys }) => keys).get(path) ?? null;
  }

  /** The curve of a track as it would be, nothing is kept; null of one that is too long to be sent. */
  async preview(
    track: ShowTrack,
    from: number,
    to: number,
    points: number,
    signal?: AbortSignal,
  ): Promise<SampledCurve | null> {
    if (this.#token === null || track.keyframes.length > MAX_PREVIEWED) return null;
    const address = this.#api.sessionPath(this.#session, `show/curves?${spanQuery(from, to, points).toString()}`);
    const asked = { json: { track }, token: this.#token, ...(signal === undefined ? {} : { signal }) };
    return (
      byPath((await (await this.#api.request("POST", address, asked)).json()) as ShowCurves).get(track.parameter) ??
      null
    );
  }

  async #ofShow({ paths, from, to, points }: CurvesAsked, signal?: AbortSignal): Promise<ShowCurves> {
    const asked = paths.slice(0, MAX_PATHS);
    const query = spanQuery(from, to, Math.min(points, Math.floor(MAX_SAMPLES / Math.max(asked.length, 1))));
    for (const path of asked) query.append("parameter", path);
    const address = this.#api.sessionPath(this.#session, `show/curves?${query.toString()}`);
    const options = signal === undefined ? {} : { signal };
    return (await (await this.#api.request("GET", address, options)).json()) as ShowCurves;
  }
}

function spanQuery(from: number, to: number, points: number): URLSearchParams {
  const start = Math.max(from, 0);
  return new URLSearchParams({
    start_s: String(start),
    end_s: String(Math.max(to, start)),
    points: String(Math.max(Math.round(points), 2)),
  });
}

function byPath(
  { times_s: times, curves }: ShowCurves,
  lineOf = ({ with_events: whole, keys }: ShowCurve) => whole ?? keys,
): Map<string, SampledCurve> {
  const [from = 0, to = 0] = [times[0], times.at(-1)];
  return new Map(
    curves.map((curve) => [curve.parameter, { from, to, values: lineOf(curve).values, jumps: lineOf(curve).jumps }]),
  );
}
