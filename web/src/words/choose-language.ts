import { remember } from "../state/storage";
import { isLanguage, languageStore, type Language } from "./language";
import { loadMessages } from "./words";

/** What was asked for last: a language that comes later than another does not count. */
let wanted: Language = "en";

/** Show the language that `first-language.js` found; where its messages cannot be loaded, the page is English. */
export async function beginLanguage(): Promise<void> {
  const code = document.documentElement.lang;
  if (!isLanguage(code)) return;
  await show(code).catch(() => (document.documentElement.lang = languageStore.get()));
}

/**
 * Show another language, and remember it for the next visit.
 *
 * @throws Error when its messages cannot be loaded; the language stays what it was.
 */
export async function chooseLanguage(code: Language): Promise<void> {
  await show(code);
  remember({ language: code });
  const address = new URL(location.href);
  if (!address.searchParams.has("lang")) return;
  // What was chosen by hand is not to be undone by a reload.
  address.searchParams.delete("lang");
  history.replaceState(history.state, "", address);
}

async function show(code: Language): Promise<void> {
  wanted = code;
  await loadMessages(code);
  if (wanted !== code) return;
  languageStore.set(code);
  document.documentElement.lang = code;
}
