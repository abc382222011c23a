import type { TransportCommand, TransportState } from "../generated/protocol";

/** What the transport will be once the server has answered, as far as this page has asked for it. */
export interface Asked {
  readonly playing?: boolean;
  readonly songTime?: number;
  readonly rate?: number;
}

/**
 * Commands on their way to the server: one after another, so that none overtakes the one before, and what is pressed
 * several times at once adds up. Of seeks that wait, only the last is sent.
 */
export class TransportQueue {
  readonly #send: (command: TransportCommand) => Promise<TransportState | null>;
  #waiting: TransportCommand[] = [];
  #working: Promise<void> | null = null;
  #asked: Asked = {};

  /** @param send makes one request; null where it was refused */
  constructor(send: (command: TransportCommand) => Promise<TransportState | null>) {
    this.#send = send;
  }

  get asked(): Asked {
    return this.#asked;
  }

  /** Whether the server has not answered to all of it yet. */
  get waits(): boolean {
    return this.#working !== null;
  }

  /** Ask for a command; done once all that was asked for is answered. */
  add(command: TransportCommand): Promise<void> {
    this.#asked = { ...this.#asked, ...effectOf(command) };
    if (command.action === "seek" && this.#waiting.at(-1)?.action === "seek") this.#waiting.pop();
    this.#waiting.push(command);
    this.#working ??= this.#work();
    return this.#working;
  }

  async #work(): Promise<void> {
    for (let command = this.#waiting.shift(); command !== undefined; command = this.#waiting.shift()) {
      // What was refused leaves the rest to be asked for from where the server is.
      if ((await this.#send(command)) === null) this.#waiting = [];
    }
    this.#asked = {};
    this.#working = null;
  }
}

function effectOf(command: TransportCommand): Asked {
  switch (command.action) {
    case "play":
      return { playing: true };
    case "pause":
      return { playing: false };
    case "seek":
      return { songTime: command.song_time_s };
    case "rate":
      return { rate: command.rate };
    default:
      return {};
  }
}
