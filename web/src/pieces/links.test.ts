import { describe, expect, it } from "vitest";
import { controlLink, controlToken, embedding, watchLink } from "./links";

const ORIGIN = "http://localhost:8000";

describe("links", () => {
  it("hold the token where no server sees it", () => {
    const link = new URL(controlLink("abc", "to-k_3n", ORIGIN));
    expect(link.pathname).toBe("/s/abc");
    expect(link.search).toBe("");
    expect(controlToken(link.hash)).toBe("to-k_3n");
    expect(new URL(watchLink("abc", ORIGIN)).hash).toBe("");
  });

  it("find no token where there is none", () => {
    for (const hash of ["", "#", "#control=", "#other=x", "#uncontrol=x"]) expect(controlToken(hash)).toBeNull();
    expect(controlToken("#t=3&control=x")).toBe("x");
  });

  it("write titles safely into HTML", () => {
    const page = embedding("a", `"><script>alert(1)</script> & co`, ORIGIN);
    expect(page).not.toContain("<script>");
    expect(page).toContain('title="&quot;>&lt;script>alert(1)&lt;/script> &amp; co"');
    expect(page).toContain(`src="${ORIGIN}/s/a?clean=1"`);
  });
});
