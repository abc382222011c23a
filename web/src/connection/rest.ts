import type {
  Cast,
  CastFields,
  CastingFields,
  ControlToken,
  CreatedSession,
  Example,
  ExampleList,
  FileRole,
  Health,
  InstrumentList,
  LightMood,
  LightMoodList,
  Password,
  Score,
  Session,
  SessionChange,
  SessionList,
  ShowParameter,
  ShowParameterList,
  SignIn,
  Stance,
  TransportCommand,
  Transcription,
  TransportState,
} from "../generated/protocol";
import type { ShowTrack } from "../generated/show";
import type { ClockProbe } from "./clock-sync";
import { GivenUpError, ProblemError, problemOf, unreachable } from "./problem";
import { send, type Sending } from "./sending";

/** What a new session is made of. */
export interface SessionFiles {
  readonly score: File;
  readonly song?: File;
  readonly show?: File;
  /** Who plays what, and what to call it, where that is not left to the server. */
  readonly cast?: Cast;
  readonly title?: string;
  /** The score's seconds are the song's already. */
  readonly inTime?: boolean;
}

/** So much of a file's beginning says what it is. */
const BEGINNING_BYTES = 65_536;

/** A probe of the clock that is answered later than this is worth nothing. */
const PROBE_MS = 3000;

/** What a request may have beside its method and address. */
export interface RequestOptions extends Sending {
  readonly json?: unknown;
  readonly body?: XMLHttpRequestBodyInit;
  readonly token?: string;
  readonly ifMatch?: string;
  readonly keepalive?: boolean;
  readonly cache?: RequestCache;
  /** Whether a busy server is asked again; by default for what changes nothing. */
  readonly again?: boolean;
}

/** The server's calls, typed. Each throws ProblemError when the server refuses or does not answer. */
export class ReinaApi {
  /** Waits until a busy server may be asked again; rejects where the person gives it up. */
  whenBusy: ((problem: ProblemError, signal?: AbortSignal) => Promise<void>) | null = null;
  /** Asks the person to sign in, where an upload needs it; resolves to whether that went well, null where it cannot. */
  askSignIn: () => Promise<boolean | null> = () => Promise.resolve(null);

  readonly #base: string;
  readonly #fetch: typeof fetch;
  readonly #send: typeof send;

  /**
   * @param base where the API stands, without a slash at its end
   * @param fetchFunction for tests
   * @param sendFunction for tests, too: sends what is told of while it goes
   */
  constructor(
    base = "/api/v1",
    fetchFunction: typeof fetch = (...request) => fetch(...request),
    sendFunction: typeof send = send,
  ) {
    this.#base = base;
    this.#fetch = fetchFunction;
    this.#send = sendFunction;
  }

  /**
   * What the server's clock says, and when it was asked, on the page's clock, performance.now's.
   *
   * The browser notes when the request left and its answer came, however busy the page was with drawing then.
   */
  async clockProbe(number: number): Promise<ClockProbe> {
    const path = `${this.#base}/health?probe=${number}`;
    const sentAt = performance.now();
    const signal = AbortSignal.timeout(PROBE_MS);
    const response = await this.request("GET", path, { cache: "no-store", signal, again: false });
    const receivedAt = performance.now();
    const { server_time_s: serverTime } = (await response.json()) as Health;
    const noted = timingOf(response.url);
    return {
      sentAt: (noted?.requestStart ?? sentAt) / 1000,
      receivedAt: (noted?.responseStart ?? receivedAt) / 1000,
      serverTime,
    };
  }

  /** @param options how its files are sent; without `sent` they are bundled ones */
  createSession(files: SessionFiles, options: RequestOptions = {}): Promise<CreatedSession> {
    const form = new FormData();
    form.append("score", files.score);
    if (files.song !== undefined) form.append("song", files.song);
    if (files.show !== undefined) form.append("show", files.show);
    if (files.title !== undefined) form.append("title", files.title);
    if (files.inTime === true) form.append("in_time", "true");
    if (files.cast !== undefined) form.append("cast", JSON.stringify(castFields(files.cast)));
    return this.#upload(() => this.#json("POST", `${this.#base}/sessions`, { ...options, body: form }));
  }

  /** Whether uploads need a sign-in, by what, and who is signed in. */
  signInState(): Promise<SignIn> {
    return this.#json("GET", `${this.#base}/sign-in`);
  }

  /** Sign in by a password; the browser keeps that in a cookie, which no page can read. */
  signInBy(given: Pick<Password, "password"> & Partial<Password>): Promise<SignIn> {
    return this.#json("POST", `${this.#base}/sign-in`, { json: given });
  }

  async signOut(): Promise<void> {
    await this.request("DELETE", `${this.#base}/sign-in`);
  }

  /** The sessions of who is signed in, the newest first. */
  mySessions(): Promise<SessionList> {
    return this.#json("GET", `${this.#base}/sessions?mine=true&limit=1000`);
  }

  /** Make a session's token anew; the one before controls nothing any more. */
  async renewToken(id: string, token: string): Promise<string> {
    const path = this.sessionPath(id, "control_token");
    return (await this.#json<ControlToken>("POST", path, { token })).control_token;
  }

  /** Have the server look for the notes of a recording of one line. */
  transcribe(song: File, sending: Sending = {}): Promise<Transcription> {
    const form = new FormData();
    form.append("song", song);
    return this.#upload(() => this.#json("POST", `${this.#base}/transcriptions`, { ...sending, body: form }));
  }

  transcription(id: string): Promise<Transcription> {
    return this.#json("GET", this.#transcriptionPath(id));
  }

  /** The score that was found. */
  async transcribedScore({ id, title }: Transcription): Promise<File> {
    const response = await this.request("GET", `${this.#transcriptionPath(id)}/score.mid`);
    return new File([await response.blob()], `${title}.mid`);
  }

  /** Give a search up, or forget what it found. */
  async endTranscription(id: string): Promise<void> {
    await this.request("DELETE", this.#transcriptionPath(id));
  }

  session(id: string, options: Pick<RequestOptions, "again"> = {}): Promise<Session> {
    return this.#json("GET", this.#sessionPath(id), options);
  }

  changeSession(id: string, change: SessionChange, token: string): Promise<Session> {
    return this.#json("PATCH", this.#sessionPath(id), { json: change, token, again: true });
  }

  async deleteSession(id: string, token: string, options: { keepalive?: boolean } = {}): Promise<void> {
    await this.request("DELETE", this.#sessionPath(id), { ...options, token });
  }

  score(id: string): Promise<Score> {
    return this.#json("GET", `${this.#sessionPath(id)}/score`);
  }

  /** The file that a session was made of. */
  async scoreFile(id: string): Promise<File> {
    const response = await this.request("GET", this.sessionPath(id, "score/file"));
    return new File([await response.blob()], "score");
  }

  cast(id: string): Promise<Cast> {
    return this.#json("GET", this.sessionPath(id, "cast"));
  }

  changeCast(id: string, fields: CastFields, token: string): Promise<Cast> {
    return this.#json("PUT", this.sessionPath(id, "cast"), { json: fields, token, again: true });
  }

  /** Make a stance of a frame of a motion file. */
  makeStance(
    id: string,
    { name, file, time_s }: { readonly name: string; readonly file: File; readonly time_s: number },
    token: string,
    sending: Sending = {},
  ): Promise<Stance> {
    const query = new URLSearchParams({ name, time_s: String(time_s), filename: file.name.slice(0, 200) });
    return this.#json("POST", `${this.sessionPath(id, "stances")}?${query}`, { ...sending, body: file, token });
  }

  /** What a show chooses throughout by a parameter: its one keyframe; undefined without a track, null if it changes. */
  async chosen(id: string, path: string): Promise<unknown> {
    const address = `${this.sessionPath(id, "show")}?${new URLSearchParams({ parameter: path })}`;
    const show = (await (await this.request("GET", address)).json()) as { tracks: ShowTrack[] };
    const track = show.tracks.find(({ parameter }) => parameter === path);
    if (track === undefined) return undefined;
    return track.keyframes?.length === 1 && track.events === undefined ? track.keyframes[0]?.value : null;
  }

  /** Let a show choose the same by a parameter throughout; one step that can be undone. */
  async choose(id: string, path: string, value: unknown, token: string): Promise<void> {
    const json = { parameter: path, keyframes: [{ time: 0, value }] };
    await this.request("PUT", this.sessionPath(id, `show/tracks/${path}`), { json, token, again: true });
  }

  /** What a cast can be made of. */
  instruments(): Promise<InstrumentList> {
    return this.#json("GET", `${this.#base}/instruments`);
  }

  /** What a file is, by its content. */
  fileRole(file: File): Promise<FileRole> {
    const path = `${this.#base}/files/role?filename=${encodeURIComponent(file.name)}`;
    const body = file.slice(0, BEGINNING_BYTES, "application/octet-stream");
    return this.#json("POST", path, { body, again: true });
  }

  transport(id: string): Promise<TransportState> {
    return this.#json("GET", `${this.#sessionPath(id)}/transport`);
  }

  control(id: string, command: TransportCommand, token: string): Promise<TransportState> {
    return this.#json("POST", `${this.#sessionPath(id)}/transport`, { json: command, token });
  }

  async parameters(): Promise<ShowParameter[]> {
    return (await this.#json<ShowParameterList>("GET", `${this.#base}/parameters`)).parameters;
  }

  async moods(): Promise<LightMood[]> {
    return (await this.#json<LightMoodList>("GET", `${this.#base}/moods`)).moods;
  }

  async examples(): Promise<Example[]> {
    return (await this.#json<ExampleList>("GET", `${this.#base}/examples`)).examples;
  }

  /** A bundled file, to be posted as one's own. */
  async file(href: string): Promise<File> {
    const response = await this.request("GET", href);
    const name = decodeURIComponent(new URL(href, "http://page").pathname.split("/").at(-1) ?? "file");
    return new File([await response.blob()], name);
  }

  /** Any call below a session, for what has its own module (song, show). */
  sessionPath(id: string, below: string): string {
    return `${this.#sessionPath(id)}/${below}`;
  }

  /** Make a request; a response that is not 2xx is thrown as ProblemError. */
  async request(method: string, path: string, options: RequestOptions = {}): Promise<Response> {
    for (;;) {
      try {
        return await this.#requestOnce(method, path, options);
      } catch (error) {
        const again = (options.again ?? method === "GET") && error instanceof ProblemError && error.isBusy;
        if (!again || this.whenBusy === null) throw error;
        await this.whenBusy(error, options.signal);
      }
    }
  }

  async #requestOnce(method: string, path: string, options: RequestOptions): Promise<Response> {
    const { sent, signal } = options;
    const headers: Record<string, string> = { Accept: "application/json, */*" };
    // Who is signed in as a session's owner needs no token: theirs is empty.
    if (options.token !== undefined && options.token !== "") headers["Authorization"] = `Bearer ${options.token}`;
    if (options.ifMatch !== undefined) headers["If-Match"] = options.ifMatch;
    if (options.json !== undefined) headers["Content-Type"] = "application/json";
    const body = options.json === undefined ? options.body : JSON.stringify(options.json);
    const init: RequestInit = { method, headers };
    if (body !== undefined) init.body = body;
    if (options.keepalive !== undefined) init.keepalive = options.keepalive;
    if (options.cache !== undefined) init.cache = options.cache;
    if (signal !== undefined) init.signal = signal;
    let response: Response;
    try {
      response = await (sent === undefined || body === undefined
        ? this.#fetch(path, init)
        : this.#send(method, path, { headers, body, sent, ...(signal === undefined ? {} : { signal }) }));
    } catch (error) {
      if (signal?.aborted === true) throw error;
      throw unreachable();
    }
    if (!response.ok) throw await problemOf(response);
    return response;
  }

  /** Upload something, once the person has signed in where that is needed. */
  async #upload<T>(send: () => Promise<T>): Promise<T> {
    try {
      return await send();
    } catch (error) {
      if (!(error instanceof ProblemError && error.needsSignIn)) throw error;
      const isIn = await this.askSignIn();
      if (isIn === null) throw error;
      if (!isIn) throw new GivenUpError(error.type);
      return await send();
    }
  }

  #transcriptionPath(id: string): string {
    return `${this.#base}/transcriptions/${encodeURIComponent(id)}`;
  }

  #sessionPath(id: string): string {
    return `${this.#base}/sessions/${encodeURIComponent(id)}`;
  }

  async #json<T>(method: string, path: string, options?: RequestOptions): Promise<T> {
    return (await (await this.request(method, path, options)).json()) as T;
  }
}

/** Of a cast what is chosen: the rest is what the server found. */
function castFields({ sequence, castings }: Cast): CastFields {
  return {
    sequence,
    castings: castings.map(
      ({ part, instrument, player, seat, transposition, written, octave_fit, joined_parts }): CastingFields => ({
        part,
        instrument,
        player,
        seat,
        transposition,
        written,
        octave_fit,
        joined_parts,
      }),
    ),
  };
}

/** The browser's own times of a request; undefined where it notes none. */
function timingOf(address: string): PerformanceResourceTiming | undefined {
  const [entry] = performance.getEntriesByName(address, "resource") as PerformanceResourceTiming[];
  // There is room for few, and nobody else reads them.
  performance.clearResourceTimings();
  return entry !== undefined && entry.requestStart > 0 && entry.responseStart > 0 ? entry : undefined;
}
