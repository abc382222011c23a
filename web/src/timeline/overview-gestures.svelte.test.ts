import { expect, it, vi } from "vitest";
import type { SessionView } from "../state/session-view.svelte";
import { OverviewGestures, type OverviewPress } from "./overview-gestures.svelte";
import type { TimeWindow } from "./time-window.svelte";

const press = (x: number): OverviewPress => ({ x, y: 0, id: 1, touch: false, shift: false, alt: false });

/** Gestures over ten bars of two seconds at ten pixels a second; the server answers when it is told to. */
function timeline(): {
  gestures: OverviewGestures;
  setLoop: ReturnType<typeof vi.fn>;
  answers: (() => void)[];
} {
  const answers: (() => void)[] = [];
  const setLoop = vi.fn(() => new Promise<void>((resolve) => answers.push(resolve)));
  const view = {
    canControl: true,
    duration: 20,
    score: { bar_lines_s: Array.from({ length: 11 }, (_, bar) => 2 * bar) },
    transport: { loop: null },
    setLoop,
    seek: vi.fn(() => Promise.resolve()),
  } as unknown as SessionView;
  const window = { timeAt: (x: number) => x / 10, showsAll: true } as unknown as TimeWindow;
  return { gestures: new OverviewGestures(() => view, window), setLoop, answers };
}

function drag(gestures: OverviewGestures, from: number, to: number, part: "new" | "end" = "new"): void {
  gestures.down(press(from), part);
  gestures.move(press(to));
  void gestures.up(press(to));
}

it("takes a click on a loop as one while the server has not answered to its drag", async () => {
  const { gestures, setLoop, answers } = timeline();
  drag(gestures, 22, 78);
  expect(setLoop).toHaveBeenLastCalledWith({ start: 2, end: 8 });
  const tapped = vi.fn();
  gestures.down(press(50), "whole");
  await gestures.up(press(50), tapped);
  expect(tapped).toHaveBeenCalledOnce();
  expect(setLoop).toHaveBeenCalledOnce();
  expect(gestures.loop).toBeNull();
  answers.forEach((answer) => answer());
});

it("moves the end of a loop that the server does not have yet", async () => {
  const { gestures, setLoop, answers } = timeline();
  drag(gestures, 22, 78);
  drag(gestures, 80, 101, "end");
  expect(setLoop).toHaveBeenLastCalledWith({ start: 2, end: 10 });
  answers.forEach((answer) => answer());
  await vi.waitFor(() => expect(gestures.loop).toBeNull());
});
