import { ProblemError } from "../../connection";
import type { LabClip, ParsedClip } from "../../generated/lab";
import type { LabApi, PositionMeaning } from "../api";
import { floats } from "../figures";
import { trouble } from "./trouble";

export interface OpenClip {
  /** Where a shipped clip is; null for a file of the visitor's. */
  readonly href: string | null;
  readonly name: string;
  readonly file: Blob;
  readonly parsed: ParsedClip;
  readonly positions: Float32Array;
  /** How its position channels were taken. */
  readonly meaning: PositionMeaning;
}

/** What was wrong with a file, with the line that it was wrong in. */
export interface ClipProblem {
  readonly name: string;
  readonly says: string;
  readonly line: number | null;
  readonly text: string | null;
}

export const RATES = [0.1, 0.25, 0.5, 1, 2] as const;

/** The third table: a motion clip, shipped or the visitor's own. */
export class Clips {
  shipped = $state.raw<readonly LabClip[]>([]);
  open = $state.raw<OpenClip | null>(null);
  problem = $state.raw<ClipProblem | null>(null);
  busy = $state(false);
  /** Among the sampled frames. */
  frame = $state(0);
  playing = $state(false);
  rate = $state(1);
  /** How position channels of this file and of those to come are taken. */
  meaning = $state<PositionMeaning>("replace");
  /** Index of the point that is followed. */
  chosen = $state<number | null>(null);
  readonly #api: LabApi;
  #asked = 0;

  constructor(api: LabApi) {
    this.#api = api;
  }

  /** Seconds from one sampled frame to the next. */
  get step(): number {
    const clip = this.open?.parsed;
    return clip === undefined ? 1 : clip.frame_time_s * clip.frame_step;
  }

  async start(): Promise<void> {
    try {
      this.shipped = await this.#api.clips();
      const first = this.shipped[0];
      if (first !== undefined && this.open === null) await this.openShipped(first);
    } catch (error) {
      this.#refuse("", error);
    }
  }

  async openShipped(clip: LabClip): Promise<void> {
    const asked = ++this.#asked;
    try {
      const file = await this.#api.file(clip.href);
      if (asked === this.#asked) await this.openFile(file, `${clip.name}.bvh`, clip.href);
    } catch (error) {
      this.#refuse(clip.name, error);
    }
  }

  /** Have the server read a file; what was open stays until it has. */
  async openFile(file: Blob, name: string, href: string | null = null): Promise<void> {
    if (!(await this.#read(file, name, href))) return;
    this.chosen = null;
    this.frame = 0;
    this.playing = false;
  }

  /** Take position channels otherwise, in the file that is open too. */
  async mean(meaning: PositionMeaning): Promise<void> {
    this.meaning = meaning;
    if (this.open === null) return;
    const { file, name, href } = this.open;
    await this.#read(file, name, href);
  }

  /** Whether the file is open now. */
  async #read(file: Blob, name: string, href: string | null): Promise<boolean> {
    const asked = ++this.#asked;
    const { meaning } = this;
    this.busy = true;
    try {
      const parsed = await this.#api.readClip(file, meaning);
      if (asked !== this.#asked) return false;
      this.open = { name, href, file, parsed, positions: floats(parsed.positions), meaning };
      this.problem = null;
      return true;
    } catch (error) {
      if (asked === this.#asked) {
        // What stays open was read as it is shown.
        if (this.open?.file === file) this.meaning = this.open.meaning;
        await this.#refuseFile(file, name, error);
      }
      return false;
    } finally {
      if (asked === this.#asked) this.busy = false;
    }
  }

  async rewritten(): Promise<Blob | null> {
    if (this.open === null) return null;
    try {
      return await this.#api.rewrittenClip(this.open.file, this.open.meaning);
    } catch (error) {
      this.#refuse(this.open.name, error);
      return null;
    }
  }

  seek(frame: number): void {
    const last = (this.open?.parsed.sampled_frames ?? 1) - 1;
    this.frame = Math.min(Math.max(Math.round(frame), 0), last);
  }

  #refuse(name: string, error: unknown): void {
    this.problem = { name, says: trouble(error), line: null, text: null };
  }

  async #refuseFile(file: Blob, name: string, error: unknown): Promise<void> {
    const place = error instanceof ProblemError ? error.errors[0]?.location : null;
    const line = /^line (\d+)$/.exec(place ?? "")?.[1];
    if (line === undefined) {
      this.#refuse(name, error);
      return;
    }
    const lines = (await file.text()).split(/\r\n|\r|\n/);
    const text = lines[Number(line) - 1]?.trim().slice(0, 160) ?? "";
    this.problem = { name, says: trouble(error), line: Number(line), text: text === "" ? null : text };
  }
}
