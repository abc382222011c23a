import { describe, expect, it, vi } from "vitest";
import { ProblemError } from "../connection";
import type { Cast, CastFields, Casting } from "../generated/protocol";
import { CastState } from "./cast.svelte";

function casting(part: number, changes: Partial<Casting> = {}): Casting {
  return {
    part,
    part_name: `Trumpet ${part + 1}`,
    instrument: "trumpet",
    player: "trumpeter",
    seat: "left",
    seat_chosen: false,
    transposition: 0,
    written: false,
    octave_fit: false,
    joined_parts: [],
    handedness: "right",
    usual_fingerings: false,
    cast_because: [],
    sounding_transposition: 0,
    notes: 4,
    playable: 4,
    reasons: [],
    choices: [],
    ...changes,
  };
}

const AS_CHOSEN = { sequence: 0, auto: false, unplayed: [], tune: [] };

/** A server that does what it is asked, as far as a part and a figure go. */
const obliging = (fields: CastFields): Promise<Cast> =>
  Promise.resolve({
    ...AS_CHOSEN,
    castings: fields.castings.map(({ part, player }, i) => casting(part ?? i, { player: player ?? "trumpeter" })),
  });

function refusing(status: number): () => Promise<Cast> {
  return () =>
    Promise.reject(new ProblemError({ status, title: "It does not fit", detail: "part 1 is taken", errors: [] }));
}

describe("CastState", () => {
  it("asks for the whole cast with one player's field changed, and keeps what others chose", async () => {
    const put = vi.fn(obliging);
    const both = [casting(0, { seat: "middle", seat_chosen: true, octave_fit: true }), casting(1)];
    const cast = new CastState({ ...AS_CHOSEN, castings: both }, put, vi.fn());
    await cast.change(1, { player: "soloist" });
    expect(put.mock.calls[0]?.[0].castings).toMatchObject([
      { part: 0, seat: "middle", octave_fit: true, player: "trumpeter" },
      { part: 1, seat: null, octave_fit: false, player: "soloist" },
    ]);
    expect(Object.keys(put.mock.calls[0]?.[0].castings[0] ?? {})).not.toContain("reasons");
    expect(cast.castings[1]?.player).toBe("soloist");
  });

  it("makes each change on what the one before has left, however fast they are asked for", async () => {
    const answers: (() => void)[] = [];
    const asked: CastFields[] = [];
    const put = (fields: CastFields): Promise<Cast> => {
      asked.push(fields);
      return new Promise((resolve) => answers.push(() => resolve(obliging(fields))));
    };
    const cast = new CastState({ ...AS_CHOSEN, castings: [casting(0), casting(1)] }, put, vi.fn());
    const both = Promise.all([cast.change(0, { player: "soloist" }), cast.change(1, { part: 2 })]);
    await vi.waitFor(() => expect(answers).toHaveLength(1));
    expect(cast.busy).toBe(true);
    answers[0]?.();
    await vi.waitFor(() => expect(answers).toHaveLength(2));
    expect(asked[1]?.castings).toMatchObject([
      { part: 0, player: "soloist" },
      { part: 2, player: "trumpeter" },
    ]);
    expect(cast.busy).toBe(true);
    answers[1]?.();
    await both;
    expect(cast.busy).toBe(false);
    expect(cast.castings).toMatchObject([{ player: "soloist" }, { part: 2 }]);
  });

  it("plays another part alone", async () => {
    const put = vi.fn(obliging);
    const cast = new CastState({ ...AS_CHOSEN, castings: [casting(0, { joined_parts: [2] })] }, put, vi.fn());
    await cast.change(0, { part: 1 });
    expect(put.mock.calls[0]?.[0].castings[0]).toMatchObject({ part: 1, joined_parts: [] });
    await cast.change(0, { joined_parts: [2] });
    expect(put.mock.calls[1]?.[0].castings[0]).toMatchObject({ part: 1, joined_parts: [2] });
  });

  it("follows whom it adds, and whoever stays when somebody is left out", async () => {
    const cast = new CastState({ ...AS_CHOSEN, castings: [casting(0)] }, obliging, vi.fn());
    await cast.add("soloist", "trumpet");
    await cast.add("trumpeter", "trumpet");
    expect([cast.castings.length, cast.followed]).toEqual([3, 2]);
    await cast.leaveOut(0);
    expect([cast.castings.length, cast.followed]).toEqual([2, 1]);
    await cast.leaveOut(1);
    expect([cast.castings.length, cast.followed]).toEqual([1, 0]);
  });

  it("follows nobody who is not there", () => {
    const cast = new CastState({ ...AS_CHOSEN, castings: [casting(0), casting(1)] }, obliging, vi.fn());
    cast.follow(1);
    cast.follow(2);
    cast.follow(-1);
    expect(cast.followed).toBe(1);
    cast.castings = [casting(0)];
    expect(cast.followed).toBe(0);
  });

  it("says what the server refused where it was asked for, and leaves the cast", async () => {
    const tell = vi.fn();
    const cast = new CastState({ ...AS_CHOSEN, castings: [casting(0), casting(1)] }, refusing(422), tell);
    await cast.change(1, { part: 0 });
    expect(cast.refusal).toEqual({ player: 1, place: "part", words: "part 1 is taken" });
    expect(cast.castings.map(({ part }) => part)).toEqual([0, 1]);
    await cast.add("soloist", "trumpet");
    expect(cast.refusal).toMatchObject({ player: 2, place: "add" });
    expect([cast.followed, cast.busy]).toEqual([0, false]);
    expect(tell).not.toHaveBeenCalled();
  });

  it("tells the page of what is nobody's fault in the cast", async () => {
    const tell = vi.fn();
    const cast = new CastState({ ...AS_CHOSEN, castings: [casting(0)] }, refusing(0), tell);
    await cast.change(0, { octave_fit: true });
    expect(cast.refusal).toBeNull();
    expect(tell).toHaveBeenCalledOnce();
  });

  it("keeps what the server says of a cast: which hand leads, and why nobody plays a part", async () => {
    const put = vi.fn(obliging);
    const found = { ...casting(0), handedness: "left" as const, cast_because: ["it has the tune"] };
    const unplayed = [{ part: 2, part_name: "Organ", reason: "several notes at once" }];
    const cast = new CastState({ ...AS_CHOSEN, castings: [found], unplayed }, put, vi.fn());
    expect(cast.casting?.cast_because).toEqual(["it has the tune"]);
    expect(cast.unplayed).toEqual(unplayed);
    await cast.change(0, { octave_fit: true });
    expect(put.mock.calls[0]?.[0].castings[0]).toMatchObject({ handedness: "left", octave_fit: true });
  });
});
