import { canStretch, makeStretcher, type Stretcher } from "./stretcher";

/** Has a stretcher ready where a song sounds slower or faster; what it takes is loaded when it is wanted first. */
export class PitchKeeper {
  readonly #context: BaseAudioContext;
  readonly #ready: () => void;
  readonly #make: typeof makeStretcher;
  #stretcher: Stretcher | null = null;
  #channels = 0;
  #loading = false;
  #lost: boolean;

  /**
   * @param ready called once a stretcher that was wanted is there, or will not be
   * @param make makes one for so many channels
   */
  constructor(context: BaseAudioContext, ready: () => void, make = makeStretcher) {
    this.#context = context;
    this.#ready = ready;
    this.#make = make;
    this.#lost = !canStretch(context);
  }

  /** Whether songs keep their pitch at every rate; where they do not, it goes with the rate. */
  get keepsPitch(): boolean {
    return !this.#lost;
  }

  /** A stretcher for so many channels; null while it is loaded, and undefined where there is none to be had. */
  stretcher(channels: number): Stretcher | null | undefined {
    if (this.#lost) return undefined;
    if (this.#stretcher !== null && this.#channels === channels) return this.#stretcher;
    if (!this.#loading) void this.#load(channels);
    return null;
  }

  async #load(channels: number): Promise<void> {
    this.#loading = true;
    try {
      this.#stretcher?.node.disconnect();
      this.#stretcher = await this.#make(this.#context, channels);
      this.#channels = channels;
    } catch {
      this.#lost = true;
    }
    this.#loading = false;
    this.#ready();
  }
}
