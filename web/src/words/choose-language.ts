import { remember } from "../state/storage";
import { isLanguage, languageStore, type Language } from "./language";
import { loadMessages, type Share } from "./words";

/** What was asked for last: a language that comes later than another does not count. */
let wanted: Language = "en";

/**
 * Show the language that `first-language.js` found; where its messages cannot be loaded, the page is English.
 *
 * @param share what of its messages the page begins with
 */
export async function beginLanguage(share: Share = "page"): Promise<void> {
  const code = document.documentElement.lang;
  if (!isLanguage(code)) return;
  await show(code, share).catch(() => (document.documentElement.lang = languageStore.get()));
}

/**
 * Have more of the messages of the language that is shown, from now on.
 *
 * @throws Error when they cannot be loaded.
 */
export function beginMessages(share: Share): Promise<void> {
  return loadMessages(languageStore.get(), share);
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

async function show(code: Language, share?: Share): Promise<void> {
  wanted = code;
  await loadMessages(code, share);
  if (wanted !== code) return;
  languageStore.set(code);
  document.documentElement.lang = code;
}
