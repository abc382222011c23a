import { createI18n, transform } from "@nanostores/i18n";
import type { ComponentsJSON, TranslationFunction, Translations } from "@nanostores/i18n";
import { fromStore } from "svelte/store";
import { languageStore, type Language } from "./language";

/** The messages of a language other than English, by area: what its JSON files hold. */
export type Translated = ComponentsJSON;

/** What is loaded at once: the page's first messages, what its editor adds, and the lab. */
export type Share = "page" | "editor" | "lab";

type Loader = () => Promise<{ default: Translated }>;
const LOADERS: Readonly<Record<Exclude<Language, "en">, Readonly<Record<Share, Loader>>>> = {
  de: { page: () => import("./de"), editor: () => import("./de-editor"), lab: () => import("./de-lab") },
  ja: { page: () => import("./ja"), editor: () => import("./ja-editor"), lab: () => import("./ja-lab") },
};

/** What has been asked for: another language must have all of it before it is shown. */
const asked = new Set<Share>();

const i18n = createI18n(languageStore, { baseLocale: "en", get: messagesOf });

async function messagesOf(code: Language): Promise<Translated> {
  if (code === "en") return {};
  const loaded = await Promise.all([...asked].map((share) => LOADERS[code][share]()));
  return Object.assign({}, ...loaded.map(({ default: messages }) => messages)) as Translated;
}

/**
 * Load a language, so that all its messages are there when it is shown.
 *
 * @param share what of it is needed, beside what was needed before
 */
export async function loadMessages(code: Language, share: Share = "page"): Promise<void> {
  asked.add(share);
  if (code !== "en") i18n.cache[code] = (await messagesOf(code)) as unknown as Translations;
}

/** What another language says of an area that has no English here, as JSON holds it; null for English. */
export function foreign(area: string, code: Language): Readonly<Record<string, unknown>> | null {
  // An area of a share that was not asked for is not there.
  return code === "en" ? null : ((i18n.cache[code][area] as Readonly<Record<string, unknown>> | undefined) ?? {});
}

/**
 * The messages of an area of the page in the language that is shown; what reads one in a component or an effect
 * follows the language.
 *
 * @param area the folder that holds them, beside `de.json` and `ja.json`
 * @param english each message's name, and how English says it
 */
export function words<Messages extends Translations>(area: string, english: Messages): Readonly<Messages> {
  const current = fromStore(i18n(area, english));
  const read = Object.keys(english).map((name) => [name, { enumerable: true, get: () => current.current[name] }]);
  return Object.defineProperties({}, Object.fromEntries(read) as PropertyDescriptorMap) as Messages;
}

/** What stands in braces in a text, with what it may be. */
type Values<Text extends string> = Text extends `${string}{${infer Name}}${infer Rest}`
  ? Readonly<Record<Name, Name extends "count" ? number : string | number>> & Values<Rest>
  : unknown;

/** A message with a place for each name in braces: `filled("{from} to {to}")`. Numbers are written as the language does. */
export const filled = transform((code, text: string, values: Record<string, string | number>) =>
  fill(code, text, values),
) as <Text extends string>(text: Text) => TranslationFunction<[Values<Text>], string>;

/** A message that has a form for each number, told apart by `{count}`: `counted({ one: "{count} note", other: "{count} notes" })`. */
export const counted = transform(
  (code, forms: Partial<Record<Intl.LDMLPluralRule, string>>, values: Record<string, string | number>) => {
    const form = new Intl.PluralRules(code).select(Number(values["count"]));
    return fill(code, forms[form] ?? forms.other ?? "", values);
  },
) as <const Forms extends { one?: string; other: string }>(
  forms: Forms,
) => TranslationFunction<[Values<Forms["other"]> & { readonly count: number }], string>;

/** A text with its places filled, and numbers written as a language does. */
export function fill(code: string, text: string, values: Readonly<Record<string, string | number>>): string {
  return text.replaceAll(/\{(\w+)\}/g, (place, name: string) => {
    const value = values[name];
    return typeof value === "number" ? new Intl.NumberFormat(code).format(value) : (value ?? place);
  });
}
