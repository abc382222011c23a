import { GivenUpError, ProblemError, type ReinaApi } from "../connection";
import type { Transcription } from "../generated/protocol";
import { number } from "../words";
import { transcribing } from "../words/transcribe/en";
import type { Notices } from "./notices.svelte";
import type { Uploads } from "./uploads.svelte";

const POLL_MS = 400;
/** Progress that is told is so much further than what was told before: it is read out, too. */
const TOLD_STEP = 0.1;
/** What the server says where it lacks what listens. */
const NOT_INSTALLED = "urn:reina:problem:no-transcription";

/** What a recording's search came to: the score as a MIDI file, and what is to be said of it. */
export interface Transcribed {
  readonly score: File;
  readonly notes: number;
  readonly hasBeat: boolean;
}

/**
 * Have the notes of a recording found, with a notice that says how far it is and can end it.
 *
 * @param uploads sends it
 * @param wait between two looks, for tests
 * @returns null where there are none, of which the person is told, or where they gave it up
 */
export async function transcribed(
  api: ReinaApi,
  notices: Notices,
  uploads: Uploads,
  song: File,
  wait: () => Promise<void> = pause,
): Promise<Transcribed | null> {
  const search = new Search(api, notices, song.name);
  try {
    return await search.follow(uploads, song, wait);
  } catch (error) {
    if (error instanceof ProblemError && error.type === NOT_INSTALLED) {
      notices.say("problem", transcribing.notInstalled, transcribing.install);
    } else if (!search.ended && !(error instanceof GivenUpError)) notices.tell(error);
    return null;
  }
}

/** One search, from the upload to the score. */
class Search {
  ended = false;
  readonly #api: ReinaApi;
  readonly #notices: Notices;
  readonly #name: string;
  #id: string | null = null;
  #notice: number | null = null;
  #told = -1;

  constructor(api: ReinaApi, notices: Notices, name: string) {
    this.#api = api;
    this.#notices = notices;
    this.#name = name;
  }

  async follow(uploads: Uploads, song: File, wait: () => Promise<void>): Promise<Transcribed | null> {
    let state = await uploads.run(song.name, (sending) => this.#api.transcribe(song, sending), {
      takeBack: ({ id }) => this.#api.endTranscription(id).catch(() => undefined),
    });
    this.#id = state.id;
    this.#tell(0);
    while (state.status === "searching") {
      await wait();
      if (this.#isOver()) return null;
      state = await this.#api.transcription(state.id);
      if (state.status === "searching") this.#tell(state.progress);
    }
    const found = state.status === "found" ? await this.#api.transcribedScore(state) : null;
    if (this.#notice !== null) this.#notices.dismiss(this.#notice);
    this.#forget();
    if (found !== null) return { score: found, notes: state.notes, hasBeat: state.has_beat };
    this.#tellFault(state);
    return null;
  }

  #tell(share: number): void {
    if (this.#told >= 0 && share < this.#told + TOLD_STEP) return;
    // What else was said meanwhile stays.
    if (this.#notice !== null && this.#notices.current?.id !== this.#notice) return;
    this.#told = share;
    this.#notices.say(
      "question",
      transcribing.listening({ name: this.#name }),
      transcribing.share({ share: number(share, { style: "percent", maximumFractionDigits: 0 }) }),
      { actions: [{ label: transcribing.cancel, run: () => this.#end() }] },
    );
    this.#notice = this.#notices.current?.id ?? null;
  }

  #tellFault({ fault, detail }: Transcription): void {
    if (fault === "mix") this.#notices.say("problem", transcribing.mix({ name: this.#name }), transcribing.mixMeans);
    else this.#notices.say("problem", transcribing.none({ name: this.#name }), detail ?? "");
  }

  /** Asked anew each time: the person may have ended it while something was awaited. */
  #isOver(): boolean {
    return this.ended;
  }

  #end(): void {
    this.ended = true;
    this.#forget();
  }

  #forget(): void {
    // Gone already, or the server with it: nothing is lost.
    if (this.#id !== null) this.#api.endTranscription(this.#id).catch(() => undefined);
    this.#id = null;
  }
}

function pause(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, POLL_MS));
}
