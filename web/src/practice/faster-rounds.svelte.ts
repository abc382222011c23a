import type { Loop } from "../generated/protocol";
import { untrack } from "svelte";

/** What is heard and where, as far as rounds of a loop are told by it. */
export interface Playing {
  readonly songTime: number;
  /** Of the transport: within one, song time only goes back where a loop begins anew. */
  readonly epoch: number;
}

/** What plays in a loop, and how fast. */
export interface LoopPlayer {
  readonly playing: boolean;
  readonly songTime: number;
  readonly rate: number;
  readonly transport: { readonly epoch: number; readonly loop: Loop | null };
  setRate(rate: number): unknown;
}

/** Whether a loop began anew between two looks at it. */
export function beganAnew(before: Playing | null, now: Playing): boolean {
  return before !== null && before.epoch === now.epoch && now.songTime < before.songTime - 1e-6;
}

/** The rate of the next round, as shares of the written tempo. */
export function nextRound(rate: number, to: number, step: number): number {
  return Math.min(Math.round((rate + step) * 1000) / 1000, to);
}

/** Plays a loop a little faster each round, from one rate to another. */
export class FasterRounds {
  /** Shares of the written tempo. */
  from = $state(0.6);
  to = $state(1);
  step = $state(0.05);
  /** What it goes on in; null while it does not. */
  #player = $state.raw<LoopPlayer | null>(null);
  #end: (() => void) | null = null;

  isOn(player: LoopPlayer): boolean {
    return this.#player === player;
  }

  /** Begin at the slowest; goes on, the panel open or not, up to the fastest, or until the loop is ended. */
  start(player: LoopPlayer): void {
    this.stop();
    this.#player = player;
    player.setRate(this.from);
    let before: Playing | null = null;
    this.#end = $effect.root(() => {
      $effect(() => {
        const { transport, playing, songTime } = player;
        const now = { songTime, epoch: transport.epoch };
        if (transport.loop === null) this.stop();
        else if (playing && beganAnew(before, now)) untrack(() => this.#round(player));
        before = playing ? now : null;
      });
    });
  }

  stop(): void {
    this.#end?.();
    this.#end = null;
    this.#player = null;
  }

  #round(player: LoopPlayer): void {
    const next = nextRound(player.rate, this.to, this.step);
    if (next > player.rate) player.setRate(next);
    if (next >= this.to) this.stop();
  }
}

/** The page's own: it goes on while its panel is closed. */
export const fasterRounds = new FasterRounds();
