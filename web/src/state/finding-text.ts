import type { Finding } from "../generated/protocol";
import { row, serverMessage } from "../words";
import { piece } from "../words/piece/en";
import { told } from "../words/told/en";

/** What of a finding's values are names in a row, as the server writes them in English. */
const NAMES = ["part", "parts"];

/** What a finding says, in the language that is shown: in English as the server says it. */
export function findingText({
  kind,
  count,
  values,
  text,
}: Pick<Finding, "kind" | "count" | "values" | "text">): string {
  const said: Record<string, string | number> = { ...values, count };
  for (const name of NAMES) if (typeof said[name] === "string") said[name] = inRow(said[name]);
  const { side } = values;
  return (
    (side === undefined ? null : serverMessage("findings", `${kind}/${side}`, said)) ??
    serverMessage("findings", kind, said) ??
    text
  );
}

/** `Flute, part 2 and 3 more` in the language's own way. */
function inRow(names: string): string {
  const [, first = names, more] = /^(.*) and (\d+) more$/.exec(names) ?? [];
  const each = first
    .split(", ")
    .map((name) => name.replace(/^part (\d+)$/, (_, number: string) => told.partNumber({ number: Number(number) })));
  return row(more === undefined ? each : [...each, piece.moreParts({ count: Number(more) })]);
}
