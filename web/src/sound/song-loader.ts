import type { SongState } from "../generated/protocol";
import { ProblemError, type ReinaApi } from "../connection";

const POLL_S = 0.5;

/**
 * The bytes of a session's song; while the server is still making it, asks again until it is there.
 *
 * @param onProgress told the share that is done, 0…1
 * @throws ProblemError when the server has none, or failed to make one
 */
export async function loadSong(
  api: ReinaApi,
  href: string,
  signal: AbortSignal,
  onProgress: (share: number) => void,
): Promise<ArrayBuffer> {
  for (;;) {
    const response = await api.request("GET", href, { signal });
    if (response.status !== 202) return response.arrayBuffer();
    const song = (await response.json()) as Partial<SongState>;
    if (song.status === "failed") {
      throw new ProblemError({ status: 502, title: "The sound could not be made", detail: "", errors: [] });
    }
    onProgress(song.progress ?? 0);
    await pause(POLL_S, signal);
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
