import { areasOf } from "./areas";

/** All of the page in Japanese, loaded where it is read. */
export default areasOf(import.meta.glob("./*/ja.json", { eager: true, import: "default" }));
