import { FocusOrigin } from "./focus-origin";

/** Of this page. */
export const focusOrigin = new FocusOrigin(window);
