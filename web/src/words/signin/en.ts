import { words } from "../words";

/** Signing in, where a server takes uploads from some people alone. */
export const signin = words("signin", {
  title: "Sign in to upload",
  means: "This server plays scores for people who have its password. Watching needs none.",
  name: "Name",
  password: "Password",
  signIn: "Sign in",
  cancel: "Cancel",
});
