import { words } from "../words";

/** What stands in index.html while the page is loading, and says what this is. */
export const first = words("first", {
  what: "Your MIDI, played on trumpet and drums by hands that know how.",
  loading: "Reina is loading",
});
