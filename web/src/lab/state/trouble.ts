import { ProblemError } from "../../connection";

/** What to say of an error: the server's own words where it has some. */
export function trouble(error: unknown): string {
  if (error instanceof ProblemError) return error.detail === "" ? error.title : error.detail;
  return error instanceof Error ? error.message : String(error);
}
