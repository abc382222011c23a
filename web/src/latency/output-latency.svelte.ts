import { remember, remembered } from "../state/storage";
import { outputDevice } from "./output-device";

/** How far sound can be moved, and in which steps, milliseconds. */
export const MOST_MS = 300;
export const STEP_MS = 5;
const MAX_DEVICES = 20;
/** A hand that drags is waited for: each change starts the sound anew. */
const SETTLED_MS = 150;

/**
 * By how much sound comes to the person's ear later than the browser knows: positive for headphones by radio, negative
 * where a television shows the picture late. Sound is asked for so much earlier. It is kept for the device that
 * plays, where the browser names it, else for all.
 */
export class OutputLatency {
  milliseconds = $state(0);
  /** What the browser calls the device; empty where it does not say. */
  device = $state("");
  readonly #apply: (seconds: number) => void;
  readonly #devices: MediaDevices | undefined;
  #settling: ReturnType<typeof setTimeout> | undefined;

  /** @param apply asks for sound so many seconds earlier */
  constructor(
    apply: (seconds: number) => void,
    devices = (globalThis as { navigator?: Partial<Navigator> }).navigator?.mediaDevices,
  ) {
    this.#apply = apply;
    this.#devices = devices;
    this.milliseconds = keptFor("");
    void this.#readDevice();
    devices?.addEventListener("devicechange", () => void this.#readDevice());
  }

  get seconds(): number {
    return this.milliseconds / 1000;
  }

  set(milliseconds: number): void {
    this.milliseconds = withinRange(milliseconds);
    const others = Object.entries(remembered().latencies).filter(([device]) => device !== this.device);
    const kept: [string, number][] = [...others, [this.device, this.milliseconds]];
    remember({ latencies: Object.fromEntries(kept.slice(-MAX_DEVICES)) });
    clearTimeout(this.#settling);
    this.#settling = setTimeout(() => this.#apply(this.seconds), SETTLED_MS);
  }

  async #readDevice(): Promise<void> {
    const device = await outputDevice(this.#devices);
    if (device === this.device) return;
    this.device = device;
    this.milliseconds = keptFor(device);
    this.#apply(this.seconds);
  }
}

/** What was set for a device, or for no certain one. */
function keptFor(device: string): number {
  const { latencies } = remembered();
  return withinRange(latencies[device] ?? latencies[""] ?? 0);
}

function withinRange(milliseconds: number): number {
  const steps = Number.isFinite(milliseconds) ? Math.round(milliseconds / STEP_MS) : 0;
  return Math.min(Math.max(steps * STEP_MS, -MOST_MS), MOST_MS) + 0;
}
