import { shownPath } from "./names";
import type { ShowDocument, ShowTrack } from "./show-document";

/** One line of the timeline: a group's heading, or a track. */
export type Row =
  | { readonly kind: "group"; readonly name: string; readonly open: boolean; readonly tracks: readonly ShowTrack[] }
  | { readonly kind: "track"; readonly group: string; readonly track: ShowTrack };

/** The group of a parameter: the first word of its path, for another player `players 2`. */
export function groupOf(path: string): string {
  const words = path.split("/");
  return words[0] === "players" ? words.slice(0, 2).join(" ") : (words[0] ?? "");
}

/** What a group is called: `players 2` is Platz 2 in German. */
export function groupName(group: string): string {
  return shownPath(group.replace(" ", "/"));
}

/** What a track is called in its group. */
export function nameInGroup(path: string): string {
  const words = path.split("/");
  return shownPath(words.slice(words[0] === "players" ? 2 : 1).join("/"));
}

/**
 * The rows of a show: groups in the order of their first track, the tracks of open ones below them.
 *
 * @param closed names of the groups that are folded up.
 * @param found paths of the tracks that are sought, whose groups are all open; null for all tracks.
 */
export function rowsOf(
  document: ShowDocument | null,
  closed: ReadonlySet<string>,
  found: ReadonlySet<string> | null = null,
): Row[] {
  const groups = new Map<string, ShowTrack[]>();
  for (const track of document?.tracks ?? []) {
    if (found !== null && !found.has(track.parameter)) continue;
    const name = groupOf(track.parameter);
    const tracks = groups.get(name);
    if (tracks === undefined) groups.set(name, [track]);
    else tracks.push(track);
  }
  return [...groups].flatMap(([name, tracks]): Row[] => {
    const open = found !== null || !closed.has(name);
    const heading: Row = { kind: "group", name, open, tracks };
    return open ? [heading, ...tracks.map((track): Row => ({ kind: "track", group: name, track }))] : [heading];
  });
}
