export { beginLanguage, chooseLanguage } from "./choose-language";
export { decimalSign, list, number } from "./format";
export { isLanguage, language, LANGUAGES, type Language } from "./language";
export { keyName, noteName } from "./note-names";
export { serverWords } from "./server-words";
