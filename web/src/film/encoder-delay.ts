/** How much later an encoder's sound comes out again than it went in. */

import { AUDIO_BIT_RATES, type AudioCodec } from "./coding";

/** WebCodecs' names of the codecs. */
const NAMES: Readonly<Record<AudioCodec, string>> = { aac: "mp4a.40.2", opus: "opus" };
/** Of what is sent through, samples: longer than any encoder looks ahead, twice. */
const LENGTH = 16_384;
const PULSE_AT = 6000;
/** Half the length of the pulse, samples: a few milliseconds, which every codec keeps. */
const PULSE_REACH = 120;
/** No encoder keeps sound back for longer, samples. */
const LONGEST = 6000;

/** A hump without a mean, which stands out from what a codec adds. */
function pulse(at: number): number {
  if (Math.abs(at) >= PULSE_REACH) return 0;
  return 0.5 * Math.cos((Math.PI * at) / (2 * PULSE_REACH)) ** 2 * Math.cos((6 * Math.PI * at) / PULSE_REACH);
}

/** So many samples of silence with a pulse. */
export function pulsed(length = LENGTH, at = PULSE_AT): Float32Array<ArrayBuffer> {
  return Float32Array.from({ length }, (_, sample) => pulse(sample - at));
}

/**
 * How many samples later than in `pulsed()` the pulse stands: where the two are most alike.
 *
 * @returns 0 for sound without a pulse.
 */
export function delayOf(samples: Float32Array, at = PULSE_AT): number {
  let [delay, likest] = [0, 1e-3];
  for (let shift = 0; shift <= LONGEST; shift++) {
    let alike = 0;
    for (let k = -PULSE_REACH; k <= PULSE_REACH; k++) alike += pulse(k) * (samples[at + shift + k] ?? 0);
    if (alike > likest) [delay, likest] = [shift, alike];
  }
  return delay;
}

/**
 * Samples that this browser's encoder of a codec puts before the sound. They are not told of (AAC), or only to
 * decoders (Opus), so a pulse is sent through.
 *
 * @returns 0 where the browser does not decode what it encodes.
 */
export async function encoderDelay(codec: AudioCodec, channels: number, sampleRate: number): Promise<number> {
  try {
    return delayOf(await thereAndBack(codec, channels, sampleRate));
  } catch (error) {
    if (error instanceof DOMException || error instanceof TypeError) return 0;
    throw error;
  }
}

async function thereAndBack(codec: AudioCodec, channels: number, sampleRate: number): Promise<Float32Array> {
  const settings = { codec: NAMES[codec], numberOfChannels: channels, sampleRate };
  const chunks: EncodedAudioChunk[] = [];
  let description: AllowSharedBufferSource | undefined;
  const faults: DOMException[] = [];
  const failed = (error: DOMException): void => void faults.push(error);
  const encoder = new AudioEncoder({
    output: (chunk, metadata) => {
      chunks.push(chunk);
      description ??= metadata?.decoderConfig?.description;
    },
    error: failed,
  });
  const heard: Float32Array[] = [];
  const decoder = new AudioDecoder({
    output: (data) => {
      const samples = new Float32Array(data.numberOfFrames);
      data.copyTo(samples, { planeIndex: 0, format: "f32-planar" });
      data.close();
      heard.push(samples);
    },
    error: failed,
  });
  try {
    encoder.configure({ ...settings, bitrate: AUDIO_BIT_RATES[codec] });
    const mono = pulsed();
    const planes = new Float32Array(mono.length * channels);
    for (let channel = 0; channel < channels; channel++) planes.set(mono, channel * mono.length);
    const numberOfFrames = mono.length;
    const data = new AudioData({
      format: "f32-planar",
      sampleRate,
      numberOfFrames,
      numberOfChannels: channels,
      timestamp: 0,
      data: planes,
    });
    encoder.encode(data);
    data.close();
    await encoder.flush();
    // Opus's description would have the decoder hide what is looked for; AAC's says how to read it.
    decoder.configure({ ...settings, ...(codec === "aac" && description !== undefined ? { description } : {}) });
    for (const chunk of chunks) decoder.decode(chunk);
    await decoder.flush();
  } finally {
    for (const coder of [encoder, decoder]) if (coder.state !== "closed") coder.close();
  }
  if (faults[0] !== undefined) throw faults[0];
  const samples = new Float32Array(heard.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const piece of heard) {
    samples.set(piece, at);
    at += piece.length;
  }
  return samples;
}
