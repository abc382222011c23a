const LOOK_EVERY_MS = 500;
/** Timers of a hidden page come once a second; later than that means that something slept. */
const SLEPT_MS = 2000;

/**
 * Tell when the page comes back from where it may have missed something: a laptop slept, the tab was hidden or frozen,
 * the network or the sound device is another one. It is told for how long nothing ran, seconds, 0 where it may have
 * run. Returns what ends it.
 *
 * Both clocks are looked at, as the page's own may stand still in sleep.
 */
export function watchWakes(woke: (asleep: number) => void): () => void {
  const ended = new AbortController();
  const { signal } = ended;
  let looked = { page: performance.now(), wall: Date.now() };
  const looking = setInterval(() => {
    const now = { page: performance.now(), wall: Date.now() };
    const gap = Math.max(now.page - looked.page, now.wall - looked.wall);
    looked = now;
    // A hidden page is woken once a minute, and need not be told that it slept.
    if (gap > SLEPT_MS) woke(document.visibilityState === "visible" ? gap / 1000 : 0);
  }, LOOK_EVERY_MS);
  document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && woke(0), { signal });
  document.addEventListener("resume", () => woke(0), { signal });
  window.addEventListener("pageshow", (event) => event.persisted && woke(0), { signal });
  window.addEventListener("online", () => woke(0), { signal });
  // Only where the page is served over HTTPS or by this machine.
  const devices = (navigator as Partial<Navigator>).mediaDevices;
  devices?.addEventListener("devicechange", () => woke(0), { signal });
  return () => {
    clearInterval(looking);
    ended.abort();
  };
}
