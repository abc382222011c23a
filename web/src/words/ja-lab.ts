import { areasOf } from "./areas";

/** The lab in Japanese, loaded where it is read. */
export default areasOf(import.meta.glob("./lab*/ja.json", { eager: true, import: "default" }));
