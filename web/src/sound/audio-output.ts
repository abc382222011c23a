import { heardContextTime } from "./heard-time";

/** A context whose time stands for so long although it runs has lost its device. */
const STALLED_S = 0.8;
/** A device that has not begun yet may be one that has to be called by radio. */
const BEGINNING_S = 5;
/** So often it is looked at, at least, for standing still to mean something. */
const LOOKS = 4;
/** A look so long after the one before says nothing of the time between: the page slept. */
const SLEPT_S = 1.5;
/** What was stopped by the system is asked to go on so often, and given up for another after so long. */
const RESUME_EVERY_S = 0.5;
const SUSPENDED_S = 1.2;
/** No two contexts are made within this. */
const RENEW_EVERY_S = 5;
const VOLUME_GLIDE_S = 0.03;

/**
 * The way out of the page: an audio context, its loudness, and what of it is heard when.
 *
 * A context may be lost, where its device goes, the laptop sleeps or the system takes it away: it is closed, stops, or
 * says that it runs while its time stands. `look` notices that and makes another; decoded sound fits any.
 */
export class AudioOutput {
  /** Seconds by which sound comes to the ear later than the browser knows. */
  trim = 0;
  readonly #make: () => AudioContext;
  readonly #pageNow: () => number;
  readonly #changed: (renewed: boolean) => void;
  #context: AudioContext;
  #master: GainNode;
  #meter: AnalyserNode;
  #gain = 1;
  /** It has run: the browser lets sound out, and nobody here stops it. */
  #hasRun = false;
  #time = 0;
  #movedAt = Infinity;
  #looks = 0;
  #lookedAt = -Infinity;
  #stoppedAt = Infinity;
  #resumedAt = -Infinity;
  #renewedAt = -Infinity;
  #closed = false;

  /** @param changed told when the context's state changes, and whether it is another context */
  constructor(make: () => AudioContext, pageNow: () => number, changed: (renewed: boolean) => void) {
    this.#make = make;
    this.#pageNow = pageNow;
    this.#changed = changed;
    [this.#context, this.#master, this.#meter] = this.#made();
  }

  get context(): AudioContext {
    return this.#context;
  }

  /** Where sound goes in. */
  get into(): AudioNode {
    return this.#master;
  }

  get running(): boolean {
    return this.#context.state === "running";
  }

  /** The highest sample that left the page in the last moments, 0…1. */
  get level(): number {
    const samples = new Float32Array(this.#meter.fftSize);
    this.#meter.getFloatTimeDomainData(samples);
    return samples.reduce((highest, sample) => Math.max(highest, Math.abs(sample)), 0);
  }

  /** The gain of all that goes out. */
  setGain(gain: number): void {
    this.#gain = gain;
    this.#master.gain.setTargetAtTime(gain, this.#context.currentTime, VOLUME_GLIDE_S);
  }

  /** The context time that is heard now, or was at another time of the page's clock, seconds. */
  heard(pageTime = this.#pageNow()): number {
    const now = this.#pageNow();
    const stamp = this.#context.getOutputTimestamp();
    const heard = heardContextTime({
      pageTime: now,
      currentTime: this.#context.currentTime,
      outputLatency: this.#context.outputLatency,
      baseLatency: this.#context.baseLatency,
      outputContextTime: stamp.contextTime,
      outputPageTime: stamp.performanceTime === undefined ? undefined : stamp.performanceTime / 1000,
    });
    return heard - this.trim + (pageTime - now);
  }

  /** Ask for sound; the browser grants it where the person has touched the page, and not to a system that says no. */
  async resume(): Promise<void> {
    if (this.running || this.#context.state === "closed") return;
    this.#resumedAt = this.#pageNow();
    try {
      await this.#context.resume();
    } catch {
      // Taken away by the system, as by a call: it is asked again.
    }
  }

  /** See whether it still goes, and mend it; to be called every tenth of a second or so while sound is wanted. */
  look(): void {
    const now = this.#pageNow();
    if (now - this.#lookedAt > SLEPT_S) this.#forgetLooks(now);
    this.#lookedAt = now;
    if (this.running) this.#lookWhetherItMoves(now);
    else if (this.#hasRun) this.#goOn(now);
  }

  /** Give the sound device back. */
  async close(): Promise<void> {
    this.#closed = true;
    this.#context.onstatechange = null;
    if (this.#context.state !== "closed") await this.#context.close();
  }

  #lookWhetherItMoves(now: number): void {
    this.#stoppedAt = Infinity;
    const time = this.#context.currentTime;
    if (time !== this.#time || this.#movedAt === Infinity) {
      this.#hasRun ||= time > 0;
      this.#time = time;
      this.#movedAt = now;
      this.#looks = 0;
      return;
    }
    this.#looks += 1;
    const patience = this.#hasRun ? STALLED_S : BEGINNING_S;
    if (this.#looks >= LOOKS && now - this.#movedAt > patience) this.#renew(now);
  }

  /** It ran, and was stopped from outside. */
  #goOn(now: number): void {
    if (this.#stoppedAt === Infinity) this.#stoppedAt = now;
    const { state } = this.#context;
    // A call or another app has the loudspeaker for as long as it likes.
    const given = state === "closed" || (state === "suspended" && now - this.#stoppedAt > SUSPENDED_S);
    if (given) this.#renew(now);
    else if (now - this.#resumedAt > RESUME_EVERY_S) void this.resume();
  }

  #forgetLooks(now: number): void {
    this.#movedAt = now;
    this.#looks = 0;
    this.#stoppedAt = Infinity;
  }

  #renew(now: number): void {
    if (this.#closed || now - this.#renewedAt < RENEW_EVERY_S) return;
    this.#renewedAt = now;
    const lost = this.#context;
    lost.onstatechange = null;
    if (lost.state !== "closed") lost.close().catch(() => undefined);
    [this.#context, this.#master, this.#meter] = this.#made();
    this.#hasRun = false;
    this.#time = 0;
    this.#forgetLooks(now);
    this.setGain(this.#gain);
    void this.resume();
    this.#changed(true);
  }

  #made(): [AudioContext, GainNode, AnalyserNode] {
    const context = this.#make();
    const master = context.createGain();
    master.connect(context.destination);
    const meter = context.createAnalyser();
    master.connect(meter);
    context.onstatechange = () => this.#changed(false);
    return [context, master, meter];
  }
}
