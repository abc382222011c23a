import { ProblemError } from "../connection";
import type { Cast, CastFields, Casting, CastingFields, UnplayedPart } from "../generated/protocol";
import { playerInk } from "./player-inks";

/** A field of a casting, or what is done with the cast as a whole. */
export type CastPlace = keyof CastingFields | "add" | "leave";

/** What the server refused, and where in the cast it was asked for. */
export interface Refusal {
  readonly player: number;
  readonly place: CastPlace;
  readonly words: string;
}

/** Who plays: the cast as the server has it, and the player whom this page's strips follow. */
export class CastState {
  castings = $state.raw<readonly Casting[]>([]);
  /** What nobody plays, and why. */
  unplayed = $state.raw<readonly UnplayedPart[]>([]);
  refusal = $state.raw<Refusal | null>(null);
  /** Colours of the players' blocks on the stage, as they are read on a pane; none before they are drawn. */
  inks = $state.raw<readonly string[]>([]);
  /** A change is on its way. */
  busy = $state(false);
  /** How often the server has said what came of a change that was asked for here. */
  answers = 0;
  #followed = $state(0);
  #asking: Promise<unknown> = Promise.resolve();
  #waiting = 0;
  /** Place in the cast of the player whom the strips follow. */
  readonly followed = $derived.by(() => Math.max(0, Math.min(this.#followed, this.castings.length - 1)));
  readonly #put: (fields: CastFields) => Promise<Cast>;
  readonly #tell: (error: unknown, again: () => unknown) => void;

  /**
   * @param put asks the server for another cast.
   * @param tell shows what went wrong where no place of the cast is to blame, and may ask for it again.
   */
  constructor(
    cast: Cast,
    put: (fields: CastFields) => Promise<Cast>,
    tell: (error: unknown, again: () => unknown) => void,
  ) {
    this.take(cast);
    this.#put = put;
    this.#tell = tell;
  }

  /** Take the cast as the server has it now. */
  take(cast: Cast): void {
    // Where the score only moved in time, it is the same cast.
    if (JSON.stringify(cast.castings) !== JSON.stringify(this.castings)) this.castings = cast.castings;
    this.unplayed = cast.unplayed;
  }

  /** A player's colour in panels and strips. */
  ink(player: number): string {
    return playerInk(this.inks, player);
  }

  /** The followed player's casting. */
  get casting(): Casting | null {
    return this.castings[this.followed] ?? null;
  }

  /** Let the strips follow another player. */
  follow(player: number): void {
    if (player >= 0 && player < this.castings.length) this.#followed = player;
  }

  /** Change fields of a player's casting; another part is played alone unless others are joined in the same change. */
  async change(player: number, changes: CastingFields): Promise<void> {
    const [place] = Object.keys(changes) as CastPlace[];
    const alone = changes.part !== undefined && changes.joined_parts === undefined ? { joined_parts: [] } : {};
    const changed = (casting: Casting, number: number): CastingFields =>
      number === player ? { ...fieldsOf(casting), ...alone, ...changes } : fieldsOf(casting);
    if (place !== undefined) await this.#ask((castings) => castings.map(changed), { player, place });
  }

  /** Let one more play, the part that suits best of those that nobody plays, and follow them. */
  async add(figure: string, instrument: string): Promise<void> {
    const player = this.castings.length;
    const added = { player: figure, instrument };
    const asked = this.#ask((castings) => [...castings.map(fieldsOf), added], { player, place: "add" });
    if (await asked) this.#followed = this.castings.length - 1;
  }

  /** Leave a player out. */
  async leaveOut(player: number): Promise<void> {
    const followed = this.followed;
    const asked = this.#ask((castings) => castings.filter((_, number) => number !== player).map(fieldsOf), {
      player,
      place: "leave",
    });
    if ((await asked) && followed > player) this.#followed = followed - 1;
  }

  /** Ask for another cast, after what is still on its way: each change is made on what the one before has left. */
  #ask(wanted: (castings: readonly Casting[]) => CastingFields[], asked: Omit<Refusal, "words">): Promise<boolean> {
    this.busy = true;
    this.#waiting += 1;
    const answered = this.#asking.then(() => this.#askNow(wanted, asked));
    this.#asking = answered;
    return answered;
  }

  async #askNow(
    wanted: (castings: readonly Casting[]) => CastingFields[],
    asked: Omit<Refusal, "words">,
  ): Promise<boolean> {
    this.refusal = null;
    try {
      const cast = await this.#put({ castings: wanted(this.castings) });
      this.answers += 1;
      this.take(cast);
      return true;
    } catch (error) {
      if (error instanceof ProblemError && error.status === 422) this.refusal = { ...asked, words: wordsOf(error) };
      else this.#tell(error, () => this.#ask(wanted, asked));
      return false;
    } finally {
      this.#waiting -= 1;
      this.busy = this.#waiting > 0;
    }
  }
}

/** A casting as it is asked for: without how it came out. */
export function fieldsOf(casting: Casting): CastingFields {
  const { part, instrument, player, seat, seat_chosen, transposition, written, octave_fit, joined_parts } = casting;
  const { handedness, usual_fingerings } = casting;
  return {
    part,
    instrument,
    player,
    seat: seat_chosen ? seat : null,
    transposition,
    written,
    octave_fit,
    joined_parts,
    handedness: handedness === "left" ? "left" : "right",
    usual_fingerings,
  };
}

/** A refusal in the server's words, each fault once. */
function wordsOf({ detail, title, errors }: ProblemError): string {
  const faults = errors.map(({ location, detail: told }) => (location === null ? told : `${location}: ${told}`));
  return faults.length > 0 ? faults.join("; ") : detail === "" ? title : detail;
}
