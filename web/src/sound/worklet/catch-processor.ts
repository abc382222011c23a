/** What the package's own processor keeps, as far as it matters here. */
export interface SignalsmithProcessor extends AudioWorkletProcessor {
  /** The row of samples: pieces, each with one array a channel; it begins and ends at these samples. */
  audioBuffers: Float32Array[][];
  audioBuffersStart: number;
  /** What is to happen at which context time, the present first. */
  readonly timeMap: readonly { active: boolean; input: number; output: number; rate: number }[];
  readonly outputLatencySeconds?: number;
}

export type SignalsmithClass = new (options: unknown) => SignalsmithProcessor;

/** The class that the package registers as soon as it is loaded; it does not export it. */
export const caught: { processor: SignalsmithClass | null } = { processor: null };

export const register = globalThis.registerProcessor.bind(globalThis);
globalThis.registerProcessor = (_, processor) => {
  caught.processor = processor as SignalsmithClass;
};
