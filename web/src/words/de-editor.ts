import { areasOf } from "./areas";

/** The show's editor in German, loaded where it is read. */
export default areasOf(import.meta.glob("./editor*/de.json", { eager: true, import: "default" }));
