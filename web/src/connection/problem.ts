import type { Fault, Problem } from "../generated/protocol";
import { serverWords } from "../words";
import { told } from "../words/told/en";

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

  constructor(problem: Omit<Problem, "type"> & Partial<Pick<Problem, "type">>) {
    const { type = "", status } = problem;
    const title = serverWords("problem", type, problem.title);
    super(problem.detail === "" ? title : `${title}: ${problem.detail}`);
    this.status = status;
    this.type = type;
    this.title = title;
    this.detail = problem.detail;
    this.errors = problem.errors;
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

  /** The server takes that from people alone who are signed in. */
  get needsSignIn(): boolean {
    return this.type === "urn:reina:problem:sign-in-needed";
  }

  /** This page may watch the session, but not change it. */
  get isForbidden(): boolean {
    return this.status === 401 || this.status === 403;
  }
}

/** What is wrong with a response that is not 2xx. */
export async function problemOf(response: Response): Promise<ProblemError> {
  const body: unknown = await response.json().catch(() => null);
  const fallback = { title: told.answered({ status: `${response.status}` }), detail: "", errors: [] };
  const problem = typeof body === "object" && body !== null ? (body as Partial<Problem>) : {};
  return new ProblemError({ ...fallback, ...problem, status: response.status });
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
