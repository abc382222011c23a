import { language } from "./language";
import { fill, foreign } from "./words";

type Forms = Partial<Record<Intl.LDMLPluralRule, string>>;

/**
 * What the language that is shown has for words of the server's, whose English stands with the server alone: the
 * folder of the area has no `en.ts`.
 *
 * @param area the folder
 * @param name what it stands under in `de.json` and `ja.json`
 * @param values what its places hold; `count` chooses the form
 * @returns null in English, and where the language has no words of its own
 */
export function serverMessage(
  area: string,
  name: string,
  values: Readonly<Record<string, string | number>> = {},
): string | null {
  const code = language();
  const message = foreign(area, code)?.[name] as string | Forms | undefined;
  if (message === undefined) return null;
  if (typeof message === "string") return fill(code, message, values);
  const form = new Intl.PluralRules(code).select(Number(values["count"] ?? 0));
  return fill(code, message[form] ?? message.other ?? "", values);
}
