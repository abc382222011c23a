const INTERVAL_S = 1;
/** A click is planned so long before it is heard: more than any device holds it back, the person's own trim included. */
const AHEAD_S = 1;
const FLASH_S = 0.09;
const LOOK_MS = 200;

/**
 * A click and a flash together, once a second, to set the latency by.
 *
 * @param click lets a click be heard at a time of the page's clock, seconds
 * @param flash told when it begins and when it ends
 * @param now the page's clock, seconds
 * @returns what ends it
 */
export function beats(click: (at: number) => void, flash: (on: boolean) => void, now: () => number): () => void {
  let next = now() + AHEAD_S;
  const planned: number[] = [];
  const plan = (): void => {
    // Of a page that slept nothing is made up for.
    if (next < now()) next = now() + AHEAD_S;
    for (; next < now() + AHEAD_S + INTERVAL_S / 2; next += INTERVAL_S) {
      click(next);
      planned.push(next);
    }
  };
  plan();
  const planning = setInterval(plan, LOOK_MS);
  let turning = requestAnimationFrame(function turn() {
    turning = requestAnimationFrame(turn);
    while ((planned[0] ?? Infinity) + FLASH_S < now()) planned.shift();
    flash((planned[0] ?? Infinity) <= now());
  });
  return () => {
    clearInterval(planning);
    cancelAnimationFrame(turning);
    flash(false);
  };
}
