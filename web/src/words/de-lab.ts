import { areasOf } from "./areas";

/** The lab in German, loaded where it is read. */
export default areasOf(import.meta.glob("./lab*/de.json", { eager: true, import: "default" }));
