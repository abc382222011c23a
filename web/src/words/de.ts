import { areasOf } from "./areas";

/** What the page says first in German, loaded where it is read. */
export default areasOf(import.meta.glob(["./*/de.json", "!./{editor,lab}*/*"], { eager: true, import: "default" }));
