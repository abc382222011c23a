import { atom } from "nanostores";
import { fromStore } from "svelte/store";

/** The languages of the page, each as it calls itself. */
export const LANGUAGES = { en: "English", de: "Deutsch", ja: "日本語" } as const;
export type Language = keyof typeof LANGUAGES;

export function isLanguage(code: string): code is Language {
  return code in LANGUAGES;
}

/** The language that is shown; it becomes another when that one's messages are there. */
export const languageStore = atom<Language>("en");
const shown = fromStore(languageStore);

/** The language that is shown; what reads it in a component or an effect follows it. */
export function language(): Language {
  return shown.current;
}
