import type { SongSegments, SongState } from "../generated/protocol";
import { ProblemError, type ReinaApi } from "../connection";
import { told } from "../words/told/en";

const PAUSE_S = 0.2;
const GONE = 410;

/** The sound that was asked for is another one now; its state says where that is. */
export class AnotherSoundError extends Error {
  override readonly name = "AnotherSoundError";
}

/** How far the server is with a song, asked for until its segments can be had or the whole is there. */
export async function plannedSong(
  api: ReinaApi,
  session: string,
  known: SongState,
  signal: AbortSignal,
  query = "",
): Promise<SongState> {
  let song = known;
  while (song.status === "rendering" && song.segments === null) {
    await pause(PAUSE_S, signal);
    song = await songState(api, session, signal, query);
  }
  return song;
}

/**
 * How far the server is with a song.
 *
 * @param query asks for something else than what everybody hears (`queriesOf`)
 * @throws ProblemError when it has none, or failed to make one
 */
export async function songState(api: ReinaApi, session: string, signal: AbortSignal, query = ""): Promise<SongState> {
  const response = await api.request("GET", `${api.sessionPath(session, "song/state")}${query}`, { signal });
  return (await response.json()) as SongState;
}

/**
 * The bytes of a segment; one that is not rendered yet is waited for.
 *
 * @throws AnotherSoundError when the server has given this sound up for another
 */
export async function loadSegment(
  api: ReinaApi,
  { href }: SongSegments,
  segment: number,
  signal: AbortSignal,
): Promise<ArrayBuffer> {
  try {
    return await whenMade(api, `${href}/${segment}`, signal, (song) => {
      if (song.segments?.href !== href) throw new AnotherSoundError();
    });
  } catch (error) {
    throw error instanceof ProblemError && error.status === GONE ? new AnotherSoundError() : error;
  }
}

/**
 * The bytes of a whole song; one that is still being made is waited for.
 *
 * @param onProgress told the share of it that the server has made, 0…1
 */
export async function loadWhole(
  api: ReinaApi,
  href: string,
  signal: AbortSignal,
  onProgress?: (share: number) => void,
): Promise<ArrayBuffer> {
  return whenMade(api, href, signal, (song) => onProgress?.(song.progress ?? 0));
}

async function whenMade(
  api: ReinaApi,
  href: string,
  signal: AbortSignal,
  onState?: (song: Partial<SongState>) => void,
): Promise<ArrayBuffer> {
  for (;;) {
    const response = await api.request("GET", href, { signal });
    if (response.status !== 202) return response.arrayBuffer();
    const song = (await response.json()) as Partial<SongState>;
    if (song.status === "failed") {
      throw new ProblemError({ status: 502, title: told.soundNotMade, detail: "", errors: [] });
    }
    onState?.(song);
    await pause(PAUSE_S, signal);
  }
}

function pause(seconds: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, seconds * 1000);
    signal.addEventListener("abort", () => {
      clearTimeout(timer);
      reject(signal.reason as Error);
    });
  });
}
