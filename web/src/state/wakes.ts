const LOOK_EVERY_MS = 500;
/** Timers of a hidden page come once a second; later than that means that something slept. */
const SLEPT_MS = 2000;

/**
 * Tell when the page comes back from where it may have missed something: a laptop slept, the tab was hidden or frozen,
 * the network or the sound device is another one. Returns what ends it.
 *
 * Both clocks are looked at, as the page's own may stand still in sleep.
 */
export function watchWakes(woke: () => void): () => void {
  const ended = new AbortController();
  const { signal } = ended;
  let looked = { page: performance.now(), wall: Date.now() };
  const looking = setInterval(() => {
    const now = { page: performance.now(), wall: Date.now() };
    const gap = Math.max(now.page - looked.page, now.wall - looked.wall);
    looked = now;
    if (gap > SLEPT_MS) woke();
  }, LOOK_EVERY_MS);
  document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && woke(), { signal });
  document.addEventListener("resume", woke, { signal });
  window.addEventListener("pageshow", (event) => event.persisted && woke(), { signal });
  window.addEventListener("online", woke, { signal });
  // Only where the page is served over HTTPS or by this machine.
  const devices = (navigator as Partial<Navigator>).mediaDevices;
  devices?.addEventListener("devicechange", woke, { signal });
  return () => {
    clearInterval(looking);
    ended.abort();
  };
}
