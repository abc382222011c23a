import type { Fault, Problem } from "../generated/protocol";
import { isNamed, serverWords } from "../words";
import { told } from "../words/told/en";

/** Where the page does not know the kind of a problem, some statuses say enough of it. */
const PLAIN_TITLES: Readonly<Record<number, () => string>> = {
  408: () => told.tookTooLong,
  413: () => told.tooLarge,
  429: () => told.busy,
  502: () => told.unreachable,
  503: () => told.busy,
  504: () => told.unreachable,
  507: () => told.noRoom,
};
/** What may be better in a moment, without anything done about it: so may no answer at all. */
const PASSING: readonly number[] = [0, 408, 429, 502, 503, 504, 507];

/** What is known of a problem: one that the page found has neither a kind nor a request. */
type SaidProblem = Omit<Problem, "type" | "instance"> & Partial<Pick<Problem, "type" | "instance">>;

/** A request that the server refused, with its problem details (RFC 9457), or that never reached it. */
export class ProblemError extends Error {
  override readonly name = "ProblemError";
  /** The HTTP status; 0 when the server could not be reached. */
  readonly status: number;
  /** What kind of problem it is, for programs; empty where the server did not say. */
  readonly type: string;
  /** What is wrong, in a few words. */
  readonly title: string;
  /** Where, and what would be right. */
  readonly detail: string;
  /** Each fault, where there are several. */
  readonly errors: readonly Fault[];
  /** For how long the server asks to be left alone, seconds; null where it does not say. */
  readonly retryAfter: number | null;

  constructor(problem: SaidProblem, retryAfter: number | null = null) {
    const { type = "", status } = problem;
    const plain = isNamed("problem", type) ? undefined : PLAIN_TITLES[status]?.();
    const title = plain ?? serverWords("problem", type, problem.title);
    super(problem.detail === "" ? title : `${title}: ${problem.detail}`);
    this.status = status;
    this.type = type;
    this.title = title;
    this.detail = problem.detail;
    this.errors = problem.errors;
    this.retryAfter = retryAfter;
  }

  /** The session, or what was asked of it, is not there. */
  get isUnknown(): boolean {
    return this.status === 404;
  }

  /** It was changed by somebody else since it was read. */
  get isStale(): boolean {
    return this.status === 412;
  }

  /** The server could not be reached. */
  get isUnanswered(): boolean {
    return this.status === 0;
  }

  /** The server has too much to do, and has done nothing of what was asked. */
  get isBusy(): boolean {
    return this.status === 429 || this.status === 503;
  }

  /** The same may go well in a moment. */
  get isPassing(): boolean {
    return PASSING.includes(this.status);
  }

  /** The server takes that from people alone who are signed in. */
  get needsSignIn(): boolean {
    return this.type === "urn:reina:problem:sign-in-needed";
  }

  /** This page may watch the session, but not change it. */
  get isForbidden(): boolean {
    return this.status === 401 || this.status === 403;
  }
}

/** The person gave it up: there is nothing to tell. */
export class GivenUpError extends ProblemError {
  /** @param type of the problem that it was given up for, where it was for one */
  constructor(type = "") {
    // The status that servers note for whoever went away before the answer.
    super({ type, status: 499, title: told.givenUp, detail: "", errors: [] });
  }
}

/** What is wrong with a response that is not 2xx. */
export async function problemOf(response: Response): Promise<ProblemError> {
  const body: unknown = await response.json().catch(() => null);
  const fallback = { title: told.answered({ status: `${response.status}` }), detail: "", errors: [] };
  const problem = typeof body === "object" && body !== null ? (body as Partial<Problem>) : {};
  return new ProblemError({ ...fallback, ...problem, status: response.status }, retryAfterOf(response.headers));
}

/** Seconds of a `Retry-After`, which says so many or a date. */
function retryAfterOf(headers: Headers): number | null {
  const said = headers.get("Retry-After");
  if (said === null) return null;
  const seconds = /^\d+$/.test(said) ? Number(said) : (Date.parse(said) - Date.now()) / 1000;
  return Number.isFinite(seconds) ? Math.max(seconds, 0) : null;
}

/** The server did not answer at all. */
export function unreachable(): ProblemError {
  return new ProblemError({
    status: 0,
    title: told.unreachable,
    detail: told.unreachableMeans,
    errors: [],
  });
}
