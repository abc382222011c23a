import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { remembered } from "../state/storage";
import { beats } from "./beats";
import { outputDevice } from "./output-device";
import { OutputLatency } from "./output-latency.svelte";

function device(kind: string, deviceId: string, label: string): MediaDeviceInfo {
  return { kind, deviceId, label, groupId: "" } as MediaDeviceInfo;
}

/** The devices of a browser, of which the first output is the one that plays. */
class Devices extends EventTarget {
  label = "";
  enumerateDevices(): Promise<MediaDeviceInfo[]> {
    return Promise.resolve([device("audioinput", "", "Microphone"), device("audiooutput", "default", this.label)]);
  }
}

async function settled(): Promise<void> {
  await vi.advanceTimersByTimeAsync(200);
}

let kept: Map<string, string>;
let applied: number[];

function latencyOf(devices: Devices): OutputLatency {
  return new OutputLatency((seconds) => applied.push(seconds), devices as unknown as MediaDevices);
}

beforeEach(() => {
  vi.useFakeTimers();
  kept = new Map();
  applied = [];
  vi.stubGlobal("localStorage", {
    getItem: (key: string) => kept.get(key) ?? null,
    setItem: (key: string, value: string) => kept.set(key, value),
  });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("OutputLatency", () => {
  it("keeps to its steps and its range, and waits for the hand", async () => {
    const latency = latencyOf(new Devices());
    for (const [asked, held] of [
      [52, 50],
      [-1, 0],
      [9999, 300],
      [-301, -300],
      [Number.NaN, 0],
      [122.5, 125],
    ] as const) {
      latency.set(asked);
      expect(latency.milliseconds).toBe(held);
    }
    expect(applied).toEqual([]);
    await settled();
    expect(applied).toEqual([0.125]);
  });

  it("is remembered where the browser names no device", () => {
    latencyOf(new Devices()).set(120);
    expect(latencyOf(new Devices()).milliseconds).toBe(120);
    expect(remembered().latencies).toEqual({ "": 120 });
  });

  it("is remembered for each device that the browser names, and follows a change", async () => {
    const devices = new Devices();
    devices.label = "Headphones";
    const latency = latencyOf(devices);
    await settled();
    expect(latency.device).toBe("Headphones");
    latency.set(180);
    devices.label = "Loudspeaker";
    devices.dispatchEvent(new Event("devicechange"));
    await settled();
    expect(latency.milliseconds).toBe(0);
    devices.label = "Headphones";
    devices.dispatchEvent(new Event("devicechange"));
    await settled();
    expect(latency.milliseconds).toBe(180);
    expect(applied.at(-1)).toBe(0.18);
  });

  it("knows no device where the browser has none, or does not say", async () => {
    expect(await outputDevice(undefined)).toBe("");
    expect(await outputDevice({ enumerateDevices: () => Promise.reject(new Error("forbidden")) })).toBe("");
    expect(await outputDevice({ enumerateDevices: () => Promise.resolve([device("videoinput", "a", "Camera")]) })).toBe(
      "",
    );
  });
});

describe("beats", () => {
  it("has each click heard when its flash begins", () => {
    let now = 10;
    let turn = (): void => undefined;
    vi.stubGlobal("requestAnimationFrame", (next: () => void) => ((turn = next), 1));
    vi.stubGlobal("cancelAnimationFrame", () => undefined);
    const clicks: number[] = [];
    const lit: [number, boolean][] = [];
    const end = beats(
      (at) => {
        expect(at, "planned before it is heard").toBeGreaterThan(now + 0.4);
        clicks.push(at);
      },
      (on) => lit.at(-1)?.[1] !== on && lit.push([now, on]),
      () => now,
    );
    for (; now < 14; now += 0.01) {
      turn();
      vi.advanceTimersByTime(10);
    }
    end();
    const flashes = lit.filter(([, on]) => on).map(([at]) => at);
    expect(flashes.length).toBeGreaterThan(2);
    flashes.forEach((at, place) => expect(Math.abs(at - (clicks[place] ?? 0))).toBeLessThan(0.011));
    expect(lit.at(-1)?.[1], "dark in the end").toBe(false);
  });
});
