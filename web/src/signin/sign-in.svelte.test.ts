import { describe, expect, it } from "vitest";
import { ProblemError } from "../connection";
import type { Password, SignIn } from "../generated/protocol";
import { SignInDesk } from "./sign-in.svelte";

const NOBODY: SignIn = { needed: true, asks: "name-and-password", signed_in: false, name: null, by: null };

function desk(asks: SignIn["asks"]): { desk: SignInDesk; tried: Password[] } {
  const tried: Password[] = [];
  const api = {
    signInState: () => Promise.resolve({ ...NOBODY, asks }),
    signInBy: (given: Password) => {
      tried.push(given);
      if (given.password === "right") return Promise.resolve({ ...NOBODY, signed_in: true });
      return Promise.reject(new ProblemError({ status: 401, title: "wrong", detail: "", errors: [] }));
    },
  };
  return { desk: new SignInDesk(api), tried };
}

async function asked(one: SignInDesk): Promise<void> {
  while (one.asked === null) await Promise.resolve();
}

describe("a desk to sign in at", () => {
  it("asks once for all uploads that wait, and lets them go on when the password is right", async () => {
    const { desk: one, tried } = desk("name-and-password");
    const waiting = Promise.all([one.ask(), one.ask()]);
    await asked(one);
    await one.attempt("ada", "wrong");
    expect(one.fault?.title).toBe("wrong");
    expect(one.asked).toBe("name-and-password");
    await one.attempt("ada", "right");
    expect(await waiting).toEqual([true, true]);
    expect(one.asked).toBeNull();
    expect(tried.map(({ name }) => name)).toEqual(["ada", "ada"]);
  });

  it("sends no name where all have one password", async () => {
    const { desk: one, tried } = desk("password");
    const waiting = one.ask();
    await asked(one);
    await one.attempt("", "right");
    expect(await waiting).toBe(true);
    expect(tried).toEqual([{ password: "right" }]);
  });

  it("can be left, and asked again", async () => {
    const { desk: one } = desk("password");
    for (let time = 0; time < 2; time += 1) {
      const waiting = one.ask();
      await asked(one);
      one.cancel();
      expect(await waiting).toBe(false);
    }
  });

  it("asks nobody where a proxy does", async () => {
    expect(await desk("proxy").desk.ask()).toBeNull();
  });
});
