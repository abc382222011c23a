import { SUBPROTOCOL, type ServerMessage, type ViewerMessage } from "../generated/protocol";
import { ClockSync } from "./clock-sync";

/** What a stream tells its owner. */
export interface StreamListener {
  /** Any control message but `pong`, `hello` included. */
  message(message: ServerMessage): void;
  /** A binary message: a packed block. */
  block(message: ArrayBuffer): void;
  /** The connection came up or went down; `retryIn` seconds until the next try, null where there is none. */
  connection(state: StreamState, retryIn: number | null): void;
}

export type StreamState = "connecting" | "open" | "lost" | "closed";

/** The outside world, injected for tests. */
export interface StreamWorld {
  /** The page's clock, seconds. */
  now(): number;
  connect(url: string, protocol: string): WebSocket;
  random(): number;
}

const FIRST_RETRY_S = 0.25;
const LAST_RETRY_S = 5;
/** Pairs of probes right after connecting, then one pair every few seconds. */
const EAGER_PAIRS = 8;
const EAGER_INTERVAL_S = 0.08;
const PROBE_INTERVAL_S = 2;
/** Without any message for so long, the connection is taken for dead. */
const SILENCE_S = 8;
/** A page that has slept asks, and takes the connection for dead where no answer comes for so long and three round trips. */
const WAKING_S = 1;
/** A page that is itself so late is busy, and answers may wait to be read. */
const LATE_S = 0.3;
const LONGEST_WAY_S = 0.5;
/** Whoever is between has forgotten a connection by then, or the server has. */
const LONG_ASLEEP_S = 10;
/** A timer that comes so much later than it was set for has slept. */
const SLEPT_S = 1.5;

/** WebSocket.OPEN. */
const OPEN = 1;

const browserWorld: StreamWorld = {
  now: () => performance.now() / 1000,
  connect: (url, protocol) => new WebSocket(url, protocol),
  random: () => Math.random(),
};

/** The WebSocket's address of a session's link to its stream. */
export function streamAddress(href: string): string {
  const address = new URL(href, location.href);
  address.protocol = address.protocol.replace("http", "ws");
  address.searchParams.set("packed", "1");
  // The score has them all: nothing here waits to be told.
  address.searchParams.set("notes", "0");
  return address.href;
}

/**
 * The session's WebSocket: connects, comes back after a loss with growing pauses, and keeps the offset to the server's
 * clock by pings in pairs (the first of a pair wakes whatever sleeps on the way, the second measures).
 */
export class Stream {
  readonly clock = new ClockSync();
  readonly #url: string;
  readonly #listener: StreamListener;
  readonly #world: StreamWorld;
  readonly #pings = new Map<number, { sentAt: number; second: boolean }>();
  #socket: WebSocket | null = null;
  #closed = false;
  #tries = 0;
  #pairs = 0;
  #nextPing = 0;
  #heardAt = 0;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #probing: ReturnType<typeof setTimeout> | undefined;
  #probeDue = Infinity;
  /** The first ping since the page woke, until it or a later one is answered; what was on its way tells nothing. */
  #wakingPing: number | null = null;
  #waking: ReturnType<typeof setTimeout> | undefined;

  constructor(url: string, listener: StreamListener, world: StreamWorld = browserWorld) {
    this.#url = url;
    this.#listener = listener;
    this.#world = world;
    this.#connect();
  }

  /** The server's time now, seconds. */
  serverNow(): number {
    return this.clock.serverTime(this.#world.now());
  }

  /** End the connection for good. */
  close(): void {
    this.#closed = true;
    clearTimeout(this.#timer);
    clearTimeout(this.#probing);
    clearTimeout(this.#waking);
    this.#socket?.close(1000);
    this.#socket = null;
    this.#listener.connection("closed", null);
  }

  /** Try again at once instead of waiting, as when the network comes back. */
  retryNow(): void {
    if (this.#closed || this.#socket !== null) return;
    clearTimeout(this.#timer);
    this.#connect();
  }

  /**
   * The page has slept, was hidden, or has another network: look at once whether the server still answers, and what
   * its clock says, rather than when the next probe is due.
   *
   * @param asleep for how long nothing ran here, seconds; after long the connection is not worth asking
   */
  wake(asleep = 0): void {
    if (this.#closed) return;
    if (this.#socket === null) {
      this.retryNow();
      return;
    }
    if (this.#socket.readyState !== OPEN) return;
    if (asleep > LONG_ASLEEP_S) {
      this.#giveUp();
      return;
    }
    clearTimeout(this.#waking);
    this.#heardAt = this.#world.now();
    this.#wakingPing = this.#nextPing;
    this.#pairs = 0;
    this.#probeDue = Infinity;
    clearTimeout(this.#probing);
    this.#probe();
    this.#awaitAnswer();
  }

  #awaitAnswer(): void {
    const patience = WAKING_S + 3 * Math.min(this.clock.roundTrip, LONGEST_WAY_S);
    const due = this.#world.now() + patience;
    this.#waking = setTimeout(() => {
      if (this.#wakingPing === null) return;
      if (this.#world.now() - due > LATE_S) this.#awaitAnswer();
      else this.#giveUp();
    }, patience * 1000);
  }

  /** Say something to the server; while there is no connection nobody hears it. */
  send(message: ViewerMessage): void {
    if (this.#socket?.readyState === OPEN) this.#socket.send(JSON.stringify(message));
  }

  #connect(): void {
    this.#listener.connection("connecting", null);
    const socket = this.#world.connect(this.#url, SUBPROTOCOL);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    socket.onopen = () => {
      if (this.#socket !== socket) return;
      this.#heardAt = this.#world.now();
      this.#pings.clear();
      this.#wakingPing = null;
      this.#pairs = 0;
      this.clock.doubt();
      this.#listener.connection("open", null);
      this.#probe();
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (this.#socket === socket) this.#receive(event.data);
    };
    socket.onclose = () => {
      if (this.#socket === socket) this.#lose();
    };
  }

  #receive(data: string | ArrayBuffer): void {
    this.#heardAt = this.#world.now();
    if (typeof data !== "string") {
      this.#listener.block(data);
      return;
    }
    const message = JSON.parse(data) as ServerMessage;
    if (message.type === "pong") this.#takePong(message.id, message.server_time_s);
    else {
      if (message.type === "hello") this.#tries = 0;
      this.#listener.message(message);
    }
  }

  #lose(): void {
    this.#socket = null;
    clearTimeout(this.#probing);
    clearTimeout(this.#waking);
    if (this.#closed) return;
    const pause = Math.min(FIRST_RETRY_S * 2 ** this.#tries, LAST_RETRY_S) * (0.75 + 0.5 * this.#world.random());
    this.#tries += 1;
    this.#listener.connection("lost", pause);
    this.#timer = setTimeout(() => this.#connect(), pause * 1000);
  }

  #probe(): void {
    const socket = this.#socket;
    if (socket === null) return;
    const now = this.#world.now();
    // What slept, or was busy, has heard nothing: that is not the server's silence.
    if (now - this.#probeDue > SLEPT_S) {
      this.wake();
      return;
    }
    if (now - this.#heardAt > SILENCE_S) {
      this.#giveUp();
      return;
    }
    this.#ping(false);
    this.#pairs += 1;
    const pause = this.#pairs < EAGER_PAIRS ? EAGER_INTERVAL_S : PROBE_INTERVAL_S;
    this.#probeDue = now + pause;
    this.#probing = setTimeout(() => this.#probe(), pause * 1000);
  }

  /** Nobody is there any more: connect again at once. */
  #giveUp(): void {
    const socket = this.#socket;
    this.#lose();
    socket?.close();
    this.retryNow();
  }

  #ping(second: boolean): void {
    const id = this.#nextPing++;
    this.#pings.set(id, { sentAt: this.#world.now(), second });
    this.send({ type: "ping", id });
  }

  #takePong(id: number, serverTime: number): void {
    const ping = this.#pings.get(id);
    if (ping === undefined) return;
    this.#pings.delete(id);
    if (this.#wakingPing !== null && id >= this.#wakingPing) this.#wakingPing = null;
    this.clock.add({ sentAt: ping.sentAt, receivedAt: this.#heardAt, serverTime });
    if (!ping.second) this.#ping(true);
  }
}
