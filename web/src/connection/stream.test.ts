import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { Stream, streamAddress, type StreamListener } from "./stream";

/** A socket under the test's hand. */
class HeldSocket {
  readonly sent: string[] = [];
  readyState = 0;
  binaryType = "blob";
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: string | ArrayBuffer }) => void) | null = null;
  onclose: (() => void) | null = null;
  readonly url: string;
  readonly protocol: string;

  constructor(url: string, protocol: string) {
    this.url = url;
    this.protocol = protocol;
  }

  send(text: string): void {
    this.sent.push(text);
  }
  close(): void {
    this.readyState = 3;
  }
  open(): void {
    this.readyState = 1;
    this.onopen?.();
  }
  lose(): void {
    this.readyState = 3;
    this.onclose?.();
  }
  receive(data: object | ArrayBuffer): void {
    this.onmessage?.({ data: data instanceof ArrayBuffer ? data : JSON.stringify(data) });
  }
}

let sockets: HeldSocket[];
let now: number;

function open(listener: Partial<StreamListener> = {}): Stream {
  const silent: StreamListener = { message: () => undefined, block: () => undefined, connection: () => undefined };
  return new Stream(
    "ws://page/api/v1/sessions/s/stream",
    { ...silent, ...listener },
    {
      now: () => now,
      random: () => 0.5,
      connect: (url, protocol) => {
        const socket = new HeldSocket(url, protocol);
        sockets.push(socket);
        return socket as unknown as WebSocket;
      },
    },
  );
}

function socketAt(place: number): HeldSocket {
  const socket = sockets.at(place);
  if (socket === undefined) throw new Error(`no socket ${place} was opened`);
  return socket;
}

function answerPing(socket: HeldSocket, place: number, roundTrip: number, ahead: number): void {
  const { id } = JSON.parse(socket.sent.at(place) ?? "{}") as { id: number };
  now += roundTrip;
  socket.receive({ type: "pong", id, server_time_s: now - roundTrip / 2 + ahead });
}

beforeEach(() => {
  vi.useFakeTimers();
  sockets = [];
  now = 50;
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("streamAddress", () => {
  it("is the link on the page's host, over WebSocket, secure where the page is", () => {
    vi.stubGlobal("location", { href: "https://band.room/s/1" });
    expect(streamAddress("/api/v1/sessions/1/stream")).toBe(
      "wss://band.room/api/v1/sessions/1/stream?packed=1&notes=0",
    );
    vi.stubGlobal("location", { href: "http://localhost:8000/" });
    expect(streamAddress("/api/v1/sessions/1/stream")).toMatch(/^ws:\/\/localhost:8000\//);
  });
});

describe("Stream", () => {
  it("speaks the subprotocol and hands messages and blocks on", () => {
    const messages: string[] = [];
    const blocks: number[] = [];
    open({ message: (message) => messages.push(message.type), block: (bytes) => blocks.push(bytes.byteLength) });
    const socket = socketAt(0);
    expect(socket.protocol).toBe("reina.v1");
    expect(socket.binaryType).toBe("arraybuffer");
    socket.open();
    socket.receive({ type: "hello" });
    socket.receive({ type: "song_ready" });
    socket.receive(new ArrayBuffer(96));
    expect(messages).toEqual(["hello", "song_ready"]);
    expect(blocks).toEqual([96]);
  });

  it("measures the server's clock with pings in pairs", () => {
    const stream = open();
    const socket = socketAt(0);
    socket.open();
    expect(socket.sent).toHaveLength(1);
    answerPing(socket, 0, 0.3, 1000);
    expect(socket.sent).toHaveLength(2);
    answerPing(socket, 1, 0.002, 1000);
    expect(socket.sent).toHaveLength(2);
    expect(stream.clock.roundTrip).toBeCloseTo(0.002, 9);
    expect(stream.serverNow()).toBeCloseTo(now + 1000, 6);
    vi.advanceTimersByTime(100);
    expect(socket.sent).toHaveLength(3);
  });

  it("does not go by the clock before on another connection, until a pong says whether it is the same", () => {
    const stream = open();
    socketAt(0).open();
    answerPing(socketAt(0), 0, 0.002, 1000);
    socketAt(0).lose();
    expect(stream.clock.ready).toBe(true);
    vi.advanceTimersByTime(20_000);
    socketAt(1).open();
    expect(stream.clock.ready).toBe(false);
    // The server was started again, and counts anew.
    answerPing(socketAt(1), 0, 0.002, -40);
    expect(stream.clock.ready).toBe(true);
    expect(stream.serverNow()).toBeCloseTo(now - 40, 6);
  });

  it("comes back after a loss, waiting longer each time, and starts afresh after a hello", () => {
    const waits: (number | null)[] = [];
    open({ connection: (state, retryIn) => (state === "lost" ? waits.push(retryIn) : undefined) });
    for (let i = 0; i < 3; i++) {
      socketAt(-1).lose();
      vi.advanceTimersByTime(20_000);
    }
    expect(waits).toEqual([0.25, 0.5, 1]);
    expect(sockets).toHaveLength(4);
    socketAt(-1).open();
    socketAt(-1).receive({ type: "hello" });
    socketAt(-1).lose();
    expect(waits.at(-1)).toBe(0.25);
  });

  it("takes a silent connection for dead", () => {
    open();
    socketAt(0).open();
    now += 20;
    vi.advanceTimersByTime(3000);
    expect(socketAt(0).readyState).toBe(3);
    expect(sockets).toHaveLength(2);
  });

  it("asks at once after a sleep, and connects again where nobody answers", () => {
    const stream = open();
    const dead = socketAt(0);
    dead.open();
    dead.receive({ type: "hello" });
    const before = dead.sent.length;
    now += 600;
    stream.wake();
    expect(dead.sent).toHaveLength(before + 1);
    dead.receive(new ArrayBuffer(96));
    vi.advanceTimersByTime(2600);
    expect(dead.readyState).toBe(3);
    expect(sockets).toHaveLength(2);
  });

  it("does not ask first after a long sleep", () => {
    const stream = open();
    socketAt(0).open();
    stream.wake(600);
    expect(socketAt(0).readyState).toBe(3);
    expect(sockets).toHaveLength(2);
  });

  it("keeps a connection that answers after a sleep, and does not take what slept for silence", () => {
    open();
    const socket = socketAt(0);
    socket.open();
    now += 600;
    vi.advanceTimersByTime(90);
    answerPing(socket, -1, 0.1, 1000);
    vi.advanceTimersByTime(2000);
    expect(socket.readyState).toBe(1);
    expect(sockets).toHaveLength(1);
  });

  it("does not come back once it is closed", () => {
    const stream = open();
    socketAt(0).open();
    stream.close();
    socketAt(0).lose();
    vi.advanceTimersByTime(60_000);
    expect(sockets).toHaveLength(1);
  });
});
