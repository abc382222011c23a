import type { ReinaApi } from "../connection";

/** The shape of a song's sound: its lowest and highest sample by stretches of equal length. */
export class Peaks {
  readonly #lowest: readonly number[];
  readonly #highest: readonly number[];
  readonly #rate: number;

  constructor({ duration_s, lowest, highest }: { duration_s: number; lowest: number[]; highest: number[] }) {
    const loudest = Math.max(...highest, ...lowest.map(Math.abs), 1e-3);
    this.#lowest = lowest.map((value) => value / loudest);
    this.#highest = highest.map((value) => value / loudest);
    this.#rate = lowest.length / Math.max(duration_s, 1e-6);
  }

  /** The lowest and the highest between two song times, seconds, in shares of the song's loudest moment. */
  between(from: number, to: number): readonly [low: number, high: number] {
    const first = Math.max(Math.floor(from * this.#rate), 0);
    const beyond = Math.min(Math.max(Math.ceil(to * this.#rate), first + 1), this.#lowest.length);
    let [low, high] = [0, 0];
    for (let index = first; index < beyond; index += 1) {
      low = Math.min(low, this.#lowest[index] ?? 0);
      high = Math.max(high, this.#highest[index] ?? 0);
    }
    return [low, high];
  }
}

/** What the server says of a song's shape. */
interface ToldPeaks {
  readonly duration_s: number;
  readonly lowest: number[];
  readonly highest: number[];
  readonly complete: boolean;
}

const PAUSE_MS = 2000;

/**
 * Read the shape of a session's song, and read it anew while more of it comes.
 *
 * @param points how many stretches there are to be
 */
export async function readPeaks(
  api: ReinaApi,
  session: string,
  signal: AbortSignal,
  take: (peaks: Peaks) => void,
  points = 1000,
): Promise<void> {
  try {
    for (;;) {
      const response = await api.request("GET", api.sessionPath(session, `song/peaks?points=${points}`), { signal });
      if (signal.aborted || response.status === 204) return;
      if (response.status === 200) {
        const told = (await response.json()) as ToldPeaks;
        take(new Peaks(told));
        if (told.complete) return;
      }
      await new Promise((resolve) => setTimeout(resolve, PAUSE_MS));
    }
  } catch {
    // The timeline is of use without the sound's shape.
  }
}
