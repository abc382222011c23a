import { areasOf } from "./areas";

/** The show's editor in Japanese, loaded where it is read. */
export default areasOf(import.meta.glob("./editor*/ja.json", { eager: true, import: "default" }));
