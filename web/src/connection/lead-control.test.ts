import { describe, expect, it } from "vitest";
import { LeadControl } from "./lead-control";

const NEAR = 0.001;
const FAR = 0.3;

/** Messages that arrive so long after they are sent, one every 50 ms from a server time on; what was asked for. */
function watched(control: LeadControl, from: number, ways: readonly number[], roundTrip: number): number[] {
  const asked: number[] = [];
  ways.forEach((way, place) => {
    const sent = from + place * 0.05;
    control.arrived(sent + control.lead, sent + way);
    const lead = control.wanted(sent + way, roundTrip);
    if (lead !== null) asked.push(lead);
  });
  return asked;
}

function begun(): LeadControl {
  const control = new LeadControl();
  control.begin(100);
  return control;
}

describe("LeadControl", () => {
  it("asks for nothing in a room's own network", () => {
    expect(watched(begun(), 101, Array<number>(200).fill(0.004), NEAR)).toEqual([]);
  });

  it("asks behind a far network before anything is late: a lost packet takes two round trips more", () => {
    expect(begun().wanted(100, FAR)).toBe(1);
    expect(begun().wanted(100, 0.03)).toBe(0.3);
  });

  it("asks for more where messages come late, and for no more than it must", () => {
    const ways = Array.from({ length: 100 }, (_, place) => (place === 40 ? 0.22 : 0.01));
    expect(watched(begun(), 101, ways, NEAR)).toEqual([0.3]);
  });

  it("comes back when nothing was late for long", () => {
    const control = begun();
    watched(control, 101, [0.01, 0.5, 0.01], NEAR);
    expect(control.lead).toBe(0.6);
    const asked = watched(control, 102, Array<number>(1200).fill(0.01), NEAR);
    expect(asked).toEqual([0.1]);
  });

  it("forgets what was late before the server was started again, and its clock with it", () => {
    const control = begun();
    watched(control, 101, [0.01, 0.5, 0.01], NEAR);
    control.forgetAsked();
    control.begin(3);
    expect(watched(control, 4, Array<number>(1000).fill(0.01), NEAR).at(-1)).toBe(0.1);
  });

  it("does not take for late what could not be sent sooner, nor what a sleep held up", () => {
    const control = begun();
    control.arrived(100.05, 100.3);
    control.arrived(200, 260);
    expect(control.wanted(260, NEAR)).toBeNull();
  });

  it("asks again on another connection", () => {
    const control = begun();
    expect(control.wanted(100, FAR)).toBe(1);
    expect(control.wanted(101, FAR)).toBeNull();
    control.forgetAsked();
    expect(control.wanted(102, FAR)).toBe(1);
  });
});
