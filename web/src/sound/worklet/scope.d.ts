// What an AudioWorkletGlobalScope has beside what every script has.

declare class AudioWorkletProcessor {
  readonly port: MessagePort;
  process(inputs: Float32Array[][], outputs: Float32Array[][], parameters: Record<string, Float32Array>): boolean;
}

// eslint-disable-next-line no-var -- only `var` declares a property of the global object
declare var registerProcessor: (name: string, processor: new (options: unknown) => AudioWorkletProcessor) => void;
declare const sampleRate: number;
declare const currentTime: number;
