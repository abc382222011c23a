import type { Finding, Session } from "../generated/protocol";
import { language } from "../words";
import { told } from "../words/told/en";
import { findingText } from "./finding-text";

/** What of a session's findings stands in its list: everything but a choice that is as anybody would expect. */
export function worthKnowing(findings: readonly Finding[]): readonly Finding[] {
  return findings.filter(
    ({ about, kind, values }) => about !== "choice" || kind === "drums_alone" || values["side"] === "none",
  );
}

/** A way to bring a player's part into the instrument's range. */
export interface OctaveOffer {
  /** The player's place in the cast. */
  readonly player: number;
  /** How far up; down is negative. */
  readonly octaves: number;
}

/** What is said of a score that was just opened. */
export interface Arrival {
  /** Who plays what. */
  readonly title: string;
  /** What more there is to say of it. */
  readonly detail: string;
  /** There is no other part to choose. */
  readonly drumsAlone: boolean;
  /** What became of it, and of the file. */
  readonly lines: readonly string[];
  readonly offers: readonly OctaveOffer[];
}

/** How many things that became of the parts are told at once; the rest stands in the piece's panel. */
const MOST_PLAYING = 3;

/** What to say of a session that was just opened with a score. */
export function arrivalOf({ findings, cast }: Pick<Session, "findings" | "cast">): Arrival {
  const several = cast.castings.length > 1;
  const choice = findings.filter(({ about }) => about === "choice").map(findingText);
  const playing = findings.filter(({ about }) => about === "playing");
  const file = findings.filter(({ about }) => about === "file" || about === "song");
  const repaired = file.filter(({ weight }) => weight === "repaired").reduce((sum, { count }) => sum + count, 0);
  const lines = [
    ...choice.slice(1),
    ...file.filter(({ weight }) => weight === "cut").map(findingText),
    ...playing
      .slice(0, MOST_PLAYING)
      .map((found) => (several ? ofPlayer(found.player, findingText(found)) : findingText(found))),
    ...(repaired > 0 ? [told.repairedIn({ count: repaired })] : []),
  ];
  const offers = playing.flatMap(({ kind, player, count, values }) =>
    kind === "octave_fit_possible" && player !== null
      ? [{ player, octaves: values["side"] === "down" ? -count : count }]
      : [],
  );
  const [title = "", ...more] = (choice[0] ?? "").split(/\. |。(?=.)/);
  const drumsAlone = findings.some(({ kind }) => kind === "drums_alone");
  return { title, detail: more.join(language() === "ja" ? "。" : ". "), drumsAlone, lines, offers };
}

function ofPlayer(player: number | null, text: string): string {
  if (player === null) return text;
  const what = language() === "en" ? `${text.charAt(0).toLowerCase()}${text.slice(1)}` : text;
  return told.ofPlayer({ player: player + 1, what });
}
