import { ProblemError, type ReinaApi } from "../connection";
import type { SignIn } from "../generated/protocol";
import { remember, remembered, type KeptPiece } from "../state/storage";
import { forgetPicture, pictureOf } from "../state/pictures";

/** How long a deleted piece can be brought back, milliseconds. */
const UNDO_MS = 8000;
/** Pieces whose names are asked for at once. */
const AT_ONCE = 6;

/** A piece as the list shows it. */
export interface Piece extends KeptPiece {
  readonly id: string;
  /** A small picture as a data URL; null where none was taken yet. */
  readonly picture: string | null;
  /** When the server removes it unless somebody opens it before, ISO 8601; null unless that is near. */
  readonly ends: string | null;
}

/** The sessions that this browser made, or who is signed in, and the server still has; the one opened last first. */
export class KeptPieces {
  all = $state.raw<readonly Piece[]>([]);
  /** What was deleted and can still be brought back. */
  deleted = $state.raw<Piece | null>(null);

  /** Who is signed in; null where nobody is. */
  who = $state.raw<SignIn | null>(null);

  /** The pieces of who is signed in, by id; these need no token. */
  #mine: Readonly<Record<string, KeptPiece>> = {};
  #ends: Readonly<Record<string, string | null>> = {};
  readonly #api: ReinaApi;
  readonly #tell: (error: unknown) => void;
  #timer: ReturnType<typeof setTimeout> | undefined;

  /**
   * @param api where the pieces are
   * @param tell shows what went wrong
   */
  constructor(api: ReinaApi, tell: (error: unknown) => void) {
    this.#api = api;
    this.#tell = tell;
    this.all = this.#shown();
  }

  /** Ask the server which pieces there still are, and what they are called now. */
  async refresh(): Promise<void> {
    await Promise.all([this.#refreshKept(), this.#refreshMine()]);
    this.all = this.#shown();
  }

  /** Sign out; what was made by who was signed in is not listed any more. */
  async signOut(): Promise<void> {
    await this.#api.signOut();
    this.who = null;
    this.#mine = {};
    this.all = this.#shown();
  }

  async #refreshMine(): Promise<void> {
    try {
      const who = await this.#api.signInState();
      this.who = who.signed_in ? who : null;
      if (who.name === null) return;
      const { sessions } = await this.#api.mySessions();
      this.#mine = Object.fromEntries(
        sessions.map(({ id, title, created_at }) => [id, { title, opened: Date.parse(created_at) }]),
      );
    } catch (error) {
      if (!(error instanceof ProblemError)) throw error;
      this.#tell(error);
    }
  }

  async #refreshKept(): Promise<void> {
    const ids = Object.keys(remembered().tokens).reverse();
    let known: Readonly<Record<string, KeptPiece>> = remembered().pieces;
    for (let begin = 0; begin < ids.length; begin += AT_ONCE) {
      const some = ids.slice(begin, begin + AT_ONCE);
      const answers = await Promise.allSettled(some.map((id) => this.#api.session(id)));
      answers.forEach((answer, index) => {
        const id = some[index] ?? "";
        if (answer.status === "fulfilled") {
          this.#ends = { ...this.#ends, [id]: answer.value.ends_at ?? null };
          known = { ...known, [id]: { title: answer.value.title, opened: known[id]?.opened ?? 0 } };
        } else if (answer.reason instanceof ProblemError && answer.reason.isUnknown) {
          known = without(known, id);
          forget(id);
        }
      });
    }
    remember({ pieces: known });
  }

  /** Take a piece out of the list; the server ends it when the time for Undo is over, or the page is left. */
  delete(piece: Piece): void {
    this.finish();
    this.deleted = piece;
    this.all = this.#shown();
    this.#timer = setTimeout(() => this.finish(), UNDO_MS);
  }

  /** Bring back what was deleted last. */
  undo(): void {
    clearTimeout(this.#timer);
    this.deleted = null;
    this.all = this.#shown();
  }

  /** End what was deleted; it cannot be brought back then. */
  finish(): void {
    const piece = this.deleted;
    if (piece === null) return;
    clearTimeout(this.#timer);
    this.deleted = null;
    const token = remembered().tokens[piece.id] ?? (piece.id in this.#mine ? "" : undefined);
    this.#mine = without(this.#mine, piece.id);
    forget(piece.id);
    if (token === undefined) return;
    // It has to arrive even where the page is being left.
    this.#api.deleteSession(piece.id, token, { keepalive: true }).catch((error: unknown) => {
      if (!(error instanceof ProblemError && error.isUnknown)) this.#tell(error);
    });
  }

  #shown(): readonly Piece[] {
    return listed(this.#mine)
      .filter(({ id }) => id !== this.deleted?.id)
      .map((piece) => ({ ...piece, ends: this.#ends[piece.id] ?? null }));
  }
}

function listed(mine: Readonly<Record<string, KeptPiece>> = {}): readonly Omit<Piece, "ends">[] {
  const { tokens, pieces } = remembered();
  const kept = Object.entries(pieces).filter(([id]) => tokens[id] !== undefined || id in mine);
  return Object.entries({ ...mine, ...Object.fromEntries(kept) })
    .map(([id, piece]) => ({ ...piece, id, picture: pictureOf(id) }))
    .sort((a, b) => b.opened - a.opened);
}

/** Forget a session that is no more. */
function forget(id: string): void {
  const { tokens, pieces, home } = remembered();
  remember({
    tokens: without(tokens, id),
    pieces: without(pieces, id),
    home: home === id ? null : home,
  });
  forgetPicture(id);
}

function without<T>(record: Readonly<Record<string, T>>, key: string): Record<string, T> {
  return Object.fromEntries(Object.entries(record).filter(([name]) => name !== key));
}
