import { ProblemError, type ReinaApi } from "../connection";
import type { ShowParameter } from "../generated/protocol";
import type { Reina } from "./reina.svelte";
import type { SessionView } from "./session-view.svelte";
import { toSongTime, toTrackTime, type ShowDocument, type ShowKeyframe, type ShowTrack, type TimeUnit } from "./show-document";
import { valueOnScreen } from "./parameter-value";

/** What may be changed of a keyframe. */
export type KeyframeChange = Partial<Pick<ShowKeyframe, "time" | "value" | "interpolation">>;

/** Two keyframes of a track may not stand closer than this, seconds; nearer, the old one is changed instead. */
const SAME_PLACE_S = 1 / 120;

/** The open session's show, and its editing through the server. */
export class ShowEditor {
  readonly #reina: Reina;
  readonly #view: SessionView;
  /** The validator of the show that `document` is. */
  #etag: string | null = null;
  document = $state.raw<ShowDocument | null>(null);
  /** Path of the chosen track's parameter. */
  chosen = $state<string | null>(null);

  constructor(reina: Reina, view: SessionView) {
    this.#reina = reina;
    this.#view = view;
  }

  readonly tracks: readonly ShowTrack[] = $derived.by(() => this.document?.tracks ?? []);
  readonly track: ShowTrack | null = $derived.by(
    () => this.tracks.find(({ parameter }) => parameter === this.chosen) ?? null,
  );

  get editable(): boolean {
    return this.#view.canControl;
  }

  parameter(path: string): ShowParameter | null {
    return this.#reina.parameters.find((parameter) => parameter.path === path) ?? null;
  }

  /** Song time, seconds, of a keyframe. */
  songTimeOf(track: ShowTrack, keyframe: ShowKeyframe): number {
    return toSongTime(this.#view.score, this.unitOf(track), keyframe.time);
  }

  unitOf(track: ShowTrack | null): TimeUnit {
    return track?.time ?? this.document?.time ?? "seconds";
  }

  /** Read the show anew. */
  async read(): Promise<void> {
    try {
      const response = await this.#api.request("GET", this.#api.sessionPath(this.#view.id, "show"));
      const document = (await response.json()) as ShowDocument;
      this.#etag = response.headers.get("ETag");
      this.document = document;
    } catch (error) {
      this.#reina.tell(error);
    }
  }

  /** Put a keyframe of a parameter at the playhead, with the value that is on screen. */
  async addHere(path: string): Promise<void> {
    const parameter = this.parameter(path);
    const { hello } = this.#view;
    const floats = this.#view.drawn?.floats ?? null;
    if (parameter === null) return;
    this.chosen = path;
    const track = this.tracks.find((each) => each.parameter === path) ?? null;
    const value = hello === null || floats === null ? parameter.default : valueOnScreen(hello, floats, parameter);
    const at = this.#view.songTime;
    const there = track?.keyframes.find((each) => Math.abs(this.songTimeOf(track, each) - at) < SAME_PLACE_S);
    if (there !== undefined) return this.change(path, there.key, { value });
    const time = Number(toTrackTime(this.#view.score, this.unitOf(track), at).toFixed(4));
    await this.#send("POST", keyframesPath(path), { time, value });
  }

  async change(path: string, key: string, change: KeyframeChange): Promise<void> {
    await this.#send("PATCH", `${keyframesPath(path)}/${encodeURIComponent(key)}`, change);
  }

  async remove(path: string, key: string): Promise<void> {
    await this.#send("DELETE", `${keyframesPath(path)}/${encodeURIComponent(key)}`);
  }

  async #send(method: string, below: string, json?: object): Promise<void> {
    const { token } = this.#view;
    if (token === null) return;
    try {
      const condition = this.#etag === null ? {} : { ifMatch: this.#etag };
      const body = json === undefined ? {} : { json };
      await this.#api.request(method, this.#api.sessionPath(this.#view.id, `show/${below}`), {
        token,
        ...condition,
        ...body,
      });
      await this.read();
    } catch (error) {
      this.#reina.tell(error);
      if (error instanceof ProblemError && (error.isUnknown || error.isStale)) await this.read();
    }
  }

  get #api(): ReinaApi {
    return this.#reina.api;
  }
}

/** Parameter paths keep their slashes in the address. */
function keyframesPath(path: string): string {
  return `tracks/${path.split("/").map(encodeURIComponent).join("/")}/keyframes`;
}
