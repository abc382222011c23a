/** Files that a person dropped or chose, sorted by what they are for. */
export interface SortedFiles {
  readonly score: File | null;
  readonly song: File | null;
  readonly show: File | null;
  /** Names of those that nothing can be done with. */
  readonly unknown: readonly string[];
}

type Role = "score" | "song" | "show";

const ROLE_BY_EXTENSION: Readonly<Record<string, Role | "json">> = {
  mid: "score",
  midi: "score",
  smf: "score",
  kar: "score",
  rmi: "score",
  gz: "score",
  zip: "score",
  wav: "song",
  mp3: "song",
  ogg: "song",
  oga: "song",
  opus: "song",
  flac: "song",
  m4a: "song",
  mp4: "song",
  aac: "song",
  webm: "song",
  json: "json",
};

/** What a file picker offers. */
export const ACCEPTED = Object.keys(ROLE_BY_EXTENSION)
  .map((extension) => `.${extension}`)
  .join(",");

/** Sort files into score, song and show; of several for one role the last counts. */
export async function sortFiles(files: Iterable<File>): Promise<SortedFiles> {
  const sorted: Record<Role, File | null> = { score: null, song: null, show: null };
  const unknown: string[] = [];
  for (const file of files) {
    const role = await roleOf(file);
    if (role === null) unknown.push(file.name);
    else sorted[role] = file;
  }
  return { ...sorted, unknown };
}

async function roleOf(file: File): Promise<Role | null> {
  const extension = file.name.split(".").at(-1)?.toLowerCase() ?? "";
  const role = ROLE_BY_EXTENSION[extension] ?? (file.type.startsWith("audio/") ? "song" : null);
  return role === "json" ? ((await isShow(file)) ? "show" : "score") : role;
}

/**
 * A show has tracks of parameters; of scores, Tone.js's has tracks too, of notes. A JSON file that cannot be read is left to the
 * server, which says what is wrong.
 */
async function isShow(file: File): Promise<boolean> {
  try {
    const document: unknown = JSON.parse(await file.text());
    if (typeof document !== "object" || document === null || !("tracks" in document)) return false;
    const { tracks } = document;
    const ofNotes =
      Array.isArray(tracks) &&
      tracks.some((track: unknown) => typeof track === "object" && track !== null && "notes" in track);
    return !ofNotes && !["notes", "parts", "header"].some((key) => key in document);
  } catch {
    return false;
  }
}
