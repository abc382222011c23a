import { areasOf } from "./areas";

/** All of the page in German, loaded where it is read. */
export default areasOf(import.meta.glob("./*/de.json", { eager: true, import: "default" }));
