/** How loud the part and the rest are; both 1 is the whole as it is written. */
export interface StemGains {
  readonly part: number;
  readonly rest: number;
}

const GLIDE_S = 0.03;

/**
 * The gains of a balance between the rest alone (-1), the whole (0) and the part alone (1).
 *
 * Neither is ever louder than in the whole, so that nothing is clipped; loudness is heard by ratios, so that the square
 * makes the slider's middle sound like the middle.
 */
export function stemGains(balance: number): StemGains {
  const held = Math.min(Math.max(balance, -1), 1);
  return { part: held < 0 ? (1 + held) ** 2 : 1, rest: held > 0 ? (1 - held) ** 2 : 1 };
}

/** Two stereo stems side by side, part and rest, as one buffer of four channels. */
export function besideEachOther([part, rest]: readonly [AudioBuffer, AudioBuffer]): AudioBuffer {
  const { sampleRate } = part;
  const both = new AudioBuffer({ length: Math.max(part.length, rest.length), numberOfChannels: 4, sampleRate });
  [part, rest].forEach((stem, index) => {
    for (const side of [0, 1]) {
      both.copyToChannel(stem.getChannelData(Math.min(side, stem.numberOfChannels - 1)), 2 * index + side);
    }
  });
  return both;
}

/** Adds up what comes in four channels, part and rest, each at its gain. */
export class PartBalance {
  readonly input: AudioNode;
  readonly #context: BaseAudioContext;
  readonly #part: GainNode;
  readonly #rest: GainNode;

  constructor(context: BaseAudioContext, into: AudioNode, balance: number) {
    const { part, rest } = stemGains(balance);
    this.#context = context;
    this.#part = new GainNode(context, { gain: part });
    this.#rest = new GainNode(context, { gain: rest });
    const splitter = new ChannelSplitterNode(context, { numberOfOutputs: 4 });
    [this.#part, this.#rest].forEach((gain, index) => {
      const stereo = new ChannelMergerNode(context, { numberOfInputs: 2 });
      for (const side of [0, 1]) splitter.connect(stereo, 2 * index + side, side);
      stereo.connect(gain).connect(into);
    });
    this.input = splitter;
  }

  /** Glide to another balance. */
  set(balance: number): void {
    const { part, rest } = stemGains(balance);
    const now = this.#context.currentTime;
    this.#part.gain.setTargetAtTime(part, now, GLIDE_S);
    this.#rest.gain.setTargetAtTime(rest, now, GLIDE_S);
  }
}
