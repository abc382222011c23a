import { counted, words } from "../words";

/** Signing in, where a server takes uploads from some people alone. */
export const signin = words("signin", {
  title: "Sign in",
  means: "This server plays scores for people who have its password. Watching by a link needs none.",
  name: "Name",
  password: "Password",
  signIn: "Sign in",
  cancel: "Cancel",
  wrong: "This is not the password. Try again.",
  wrongPair: "Name and password do not match. Try again.",
  tooOften: counted({
    one: "Too many tries. Wait {count} minute, then try again.",
    other: "Too many tries. Wait {count} minutes, then try again.",
  }),
});
