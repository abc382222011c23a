import { caught, register, type SignalsmithClass } from "./catch-processor";
// After the module above, which catches what it registers.
import "signalsmith-stretch";

/** Of what has been played so much stays, seconds: what is sounding reaches back a block. */
const KEPT_S = 1;

if (caught.processor === null) throw new RangeError("signalsmith-stretch has registered no processor");
const Signalsmith: SignalsmithClass = caught.processor;

/**
 * Signalsmith Stretch, which may be given its samples piece by piece: version 1.3.2 reads across the border of two
 * pieces from the wrong place, so they are joined before it reads.
 */
class StretchProcessor extends Signalsmith {
  override process(
    inputs: Float32Array[][],
    outputs: Float32Array[][],
    parameters: Record<string, Float32Array>,
  ): boolean {
    if (this.audioBuffers.length > 1) this.#join();
    return super.process(inputs, outputs, parameters);
  }

  #join(): void {
    const pieces = this.audioBuffers;
    const dropped = Math.min(this.#past(), pieces[0]?.[0]?.length ?? 0);
    const channels = Math.max(...pieces.map((piece) => piece.length));
    const length = pieces.reduce((sum, [first]) => sum + (first?.length ?? 0), 0) - dropped;
    const joined = Array.from({ length: channels }, (_, channel) => {
      const samples = new Float32Array(length);
      let at = -dropped;
      for (const piece of pieces) {
        const own = piece[channel % piece.length] ?? new Float32Array(0);
        samples.set(at < 0 ? own.subarray(-at) : own, Math.max(at, 0));
        at += own.length;
      }
      return samples;
    });
    this.audioBuffers = [joined];
    this.audioBuffersStart += dropped;
  }

  /** How many samples of the row are done with. */
  #past(): number {
    const [now] = this.timeMap;
    if (now?.active !== true) return 0;
    const place = now.input + (currentTime + (this.outputLatencySeconds ?? 0) - now.output) * now.rate;
    return Math.max(Math.floor((place - KEPT_S) * sampleRate) - this.audioBuffersStart, 0);
  }
}

register("reina-stretcher", StretchProcessor);
