import { areasOf } from "./areas";

/** What the page says first in Japanese, loaded where it is read. */
export default areasOf(import.meta.glob(["./*/ja.json", "!./{editor,lab}*/*"], { eager: true, import: "default" }));
