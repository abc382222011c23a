import type { FileRole } from "../generated/protocol";
import { list } from "../words";

/** Files that a person dropped or chose, sorted by what they are for. */
export interface SortedFiles {
  /** In the order in which they came; one is opened, the others are offered. */
  readonly scores: readonly File[];
  readonly songs: readonly File[];
  readonly shows: readonly File[];
  /** What nothing can be done with: what it is, and what would be right. */
  readonly unusable: readonly { readonly file: File; readonly told: FileRole }[];
}

/** What a file picker offers; what a file is, its content says. */
export const ACCEPTED =
  ".mid,.midi,.smf,.kar,.rmi,.musicxml,.mxl,.xml,.gz,.zip,.json,.wav,.aif,.aiff,.aifc,.mp3,.ogg,.oga,.opus,.flac,.m4a,.mp4,.aac,.webm";

/**
 * Sort files into scores, songs and shows.
 *
 * @param roleOf what the server says a file is
 */
export async function sortFiles(
  files: Iterable<File>,
  roleOf: (file: File) => Promise<FileRole>,
): Promise<SortedFiles> {
  const told = await Promise.all([...files].map(async (file) => ({ file, told: await roleOf(file) })));
  const of = (role: FileRole["role"]): File[] => told.filter((each) => each.told.role === role).map(({ file }) => file);
  return {
    scores: of("score"),
    songs: of("song"),
    shows: of("show"),
    unusable: told.filter((each) => each.told.role === null),
  };
}

/** The names of files that were left aside, in a sentence. */
export function namesOf(files: readonly File[]): string {
  return list(files.map(({ name }) => name));
}
