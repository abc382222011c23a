export { beginLanguage, beginMessages, chooseLanguage } from "./choose-language";
export { decimalSign, list, megabytes, number, row } from "./format";
export { isLanguage, language, LANGUAGES, type Language } from "./language";
export { keyName, noteName } from "./note-names";
export { serverMessage } from "./server-message";
export { isNamed, limbName, pieceName, serverWords } from "./server-words";
