import { ProblemError, type ReinaApi } from "../connection";
import type { SignIn } from "../generated/protocol";

/** What the person is asked for. */
export type Asked = "password" | "name-and-password";

/** Asks the person to sign in when an upload needs it, and lets the upload wait for that. */
export class SignInDesk {
  /** What is asked for; null while nothing is. */
  asked = $state.raw<Asked | null>(null);
  /** Why the last try did not go well; null before. */
  fault = $state.raw<ProblemError | null>(null);
  busy = $state(false);

  readonly #api: Pick<ReinaApi, "signInState" | "signInBy">;
  #asking: Promise<boolean | null> | null = null;
  #answer: (isIn: boolean) => void = () => undefined;

  constructor(api: Pick<ReinaApi, "signInState" | "signInBy">) {
    this.#api = api;
  }

  /** Ask, once for all who need it; resolves to whether somebody is signed in then, null where nobody can be asked. */
  ask(): Promise<boolean | null> {
    this.#asking ??= this.#ask().finally(() => (this.#asking = null));
    return this.#asking;
  }

  /** Try what was given. */
  async attempt(name: string, password: string): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    this.fault = null;
    try {
      await this.#api.signInBy(this.asked === "password" ? { password } : { name, password });
      this.#answer(true);
    } catch (error) {
      if (!(error instanceof ProblemError)) throw error;
      this.fault = error;
    } finally {
      this.busy = false;
    }
  }

  /** The person would rather not. */
  cancel(): void {
    this.#answer(false);
  }

  async #ask(): Promise<boolean | null> {
    const { asks }: SignIn = await this.#api.signInState();
    // Where a proxy asks, it is not for this page to.
    if (asks !== "password" && asks !== "name-and-password") return null;
    this.fault = null;
    this.asked = asks;
    const isIn = await new Promise<boolean>((answer) => (this.#answer = answer));
    this.asked = null;
    return isIn;
  }
}
