/** How long before they are due frames may be asked for, seconds. */
const STEPS = [0.1, 0.3, 0.6, 1, 1.5] as const;
/** To be there so long before it is due is early enough. */
const SPARE_S = 0.05;
/** A round trip below this is a room's own network. */
const NEAR_S = 0.015;
/** Until it is noticed that a packet is lost, beside two round trips: to say so and to send it again. */
const NOTICED_S = 0.2;
/** So long the slowest message counts, and up to twice that. */
const REMEMBERED_S = 20;
/** A message that comes later than this was held up by a sleep, not by the network. */
const ABSURD_S = 3;

/**
 * How long before they are due the page asks for frames: enough for the network's slowest messages, those behind a
 * lost packet included, and no longer, as frames that were sent are for nothing once somebody edits or seeks.
 */
export class LeadControl {
  #asked: number = STEPS[0];
  /** Frames due before this were sent late, whatever the network does: server time, seconds. */
  #judgedFrom = Infinity;
  #slowest = 0;
  #slowestBefore = 0;
  #turnedAt = -Infinity;

  /** What is asked for, seconds. */
  get lead(): number {
    return this.#asked;
  }

  /** A connection was made, or the frames begin anew at a server time: the first come as late as they must. */
  begin(serverTime: number): void {
    this.#judgedFrom = serverTime + this.#asked + SPARE_S;
  }

  /** The server knows nothing of what was asked for: another connection. */
  forgetAsked(): void {
    this.#asked = STEPS[0];
  }

  /**
   * A message of frames has come.
   *
   * @param due server time at which its first frame is due
   * @param serverTime server time now
   */
  arrived(due: number, serverTime: number): void {
    const took = this.#asked - (due - serverTime);
    if (due < this.#judgedFrom || took > ABSURD_S) return;
    // A server that was started again counts from its own beginning.
    if (Math.abs(serverTime - this.#turnedAt) > REMEMBERED_S) {
      this.#slowestBefore = this.#slowest;
      this.#slowest = 0;
      this.#turnedAt = serverTime;
    }
    this.#slowest = Math.max(this.#slowest, took);
  }

  /**
   * What is to be asked for now; null when it is what was asked for.
   *
   * @param roundTrip the network's least round trip, seconds
   */
  wanted(serverTime: number, roundTrip: number): number | null {
    const far = roundTrip > NEAR_S && Number.isFinite(roundTrip);
    const need = Math.max(this.#slowest + SPARE_S, this.#slowestBefore + SPARE_S, far ? NOTICED_S + 2 * roundTrip : 0);
    const lead = STEPS.find((step) => step >= need) ?? STEPS[STEPS.length - 1] ?? this.#asked;
    if (lead === this.#asked) return null;
    this.#asked = lead;
    this.begin(serverTime + roundTrip);
    return lead;
  }
}
