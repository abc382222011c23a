import processorUrl from "./worklet/stretch-processor.ts?worker&url";

/** What is to happen at a time of the context; what is left out stays as it was before. */
export interface StretchChange {
  /** Context time at which it is heard, seconds. Whatever was asked for later than now is forgotten. */
  readonly output: number;
  readonly active?: boolean;
  /** Place in the row of samples, seconds. */
  readonly input?: number;
  /** Seconds of the row in a second. */
  readonly rate?: number;
}

/** A node that plays a row of samples slower or faster, at their own pitch; it makes up for its latency. */
export interface Stretcher {
  readonly node: AudioNode;
  schedule(change: StretchChange): void;
  /** Add samples to the row, one array a channel; they are given away. */
  add(channels: readonly Float32Array<ArrayBuffer>[]): void;
  /** Begin another row, at 0, that will be played at a rate. */
  begin(rate: number): void;
}

/**
 * Blocks and how far apart they are, chosen by measure (docs/sound.md): longer ones blur onsets, wider intervals put tones
 * out of tune, and at a quarter of the tempo move onsets about.
 */
function blocksFor(rate: number): { readonly blockMs: number; readonly intervalMs: number } {
  return { blockMs: 100, intervalMs: rate < 0.3 ? 5 : 10 };
}

/** Whether the browser lets a page compute sound at all: only at https and on the machine itself. */
export function canStretch(context: BaseAudioContext): boolean {
  // Older browsers and insecure pages have none, whatever the types say.
  return (context as Partial<BaseAudioContext>).audioWorklet !== undefined;
}

/**
 * Load what stretches, 115 kB, and make a node of it.
 *
 * @throws when it cannot be fetched, or the browser refuses it
 */
export async function makeStretcher(context: BaseAudioContext, channels: number): Promise<Stretcher> {
  await context.audioWorklet.addModule(processorUrl);
  // It has an input, to which nothing is connected: while nothing is due, it looks there.
  const node = new AudioWorkletNode(context, "reina-stretcher", {
    numberOfInputs: 1,
    numberOfOutputs: 1,
    outputChannelCount: [channels],
  });
  const { port } = node;
  const call = (method: string, values: readonly unknown[], given: Transferable[] = []): void =>
    port.postMessage([0, method, ...values], given);
  await new Promise<void>((resolve, reject) => {
    node.onprocessorerror = () => reject(new RangeError("the stretcher failed"));
    port.onmessage = ({ data }: MessageEvent<[string]>) => {
      if (data[0] === "ready") resolve();
    };
  });
  port.onmessage = null;
  let interval = 0;
  return {
    node,
    schedule: (change) => call("schedule", [change]),
    add: (samples) =>
      call(
        "addBuffers",
        [samples],
        samples.map(({ buffer }) => buffer),
      ),
    begin: (rate) => {
      const blocks = blocksFor(rate);
      // To configure it forgets what is sounding, and takes a while.
      if (blocks.intervalMs !== interval) call("configure", [blocks]);
      interval = blocks.intervalMs;
      call("dropBuffers", []);
    },
  };
}
