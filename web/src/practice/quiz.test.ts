import { describe, expect, it } from "vitest";
import type { ChartLine } from "../generated/protocol";
import { judge, Quiz, questionsOf, timeFor } from "./quiz.svelte";

function note(index: number, sounding_pitch: number, valves: number[], usual_valves = valves) {
  const name = `${sounding_pitch}`;
  return {
    index,
    onset_s: index,
    duration_s: 1,
    sounding_pitch,
    valves,
    usual_valves,
    written_name: name,
    sounding_name: name,
  };
}

const chart: ChartLine[] = [
  { sounding_pitch: 62, written_pitch: 64, sounding_names: [], written_names: [], fingerings: [[1, 2], [3]] },
  { sounding_pitch: 58, written_pitch: 60, sounding_names: [], written_names: [], fingerings: [[]] },
];

const line = [note(0, 62, [1, 2]), note(1, 62, [1, 2]), note(2, 58, []), note(3, 62, [3], [1, 2]), note(4, 65, [1])];
const all = questionsOf(line, chart, { start: 0, end: 10 });

describe("questions", () => {
  it("are the notes of a stretch, repeated ones once", () => {
    expect(all.map((question) => question.note.index)).toEqual([0, 2, 3, 4]);
    expect(questionsOf(line, chart, { start: 1, end: 4 }).map((question) => question.note.index)).toEqual([1, 2, 3]);
  });

  it("take every fingering of the chart, the usual one first, and what is played", () => {
    expect(all.map(({ accepted }) => accepted)).toEqual([[[1, 2], [3]], [[]], [[1, 2], [3]], [[1]]]);
    const [first] = all;
    if (first === undefined) throw new Error("nothing is asked for");
    expect(judge(first, [2, 1])).toBe("usual");
    expect(judge(first, [3])).toBe("alternate");
    expect(judge(first, [])).toBe("wrong");
    expect(judge(first, [1])).toBe("wrong");
  });

  it("leave time by the rate, and less for quick notes", () => {
    const [first] = all;
    if (first === undefined) throw new Error("nothing is asked for");
    expect(timeFor(first, 1).until).toBeCloseTo(0.25, 9);
    expect(timeFor(first, 0.5).until).toBeCloseTo(0.125, 9);
    expect(timeFor({ ...first, note: { ...first.note, duration_s: 0.1 } }, 1).until).toBeCloseTo(0.06, 9);
  });
});

describe("Quiz", () => {
  it("goes on from right answers, and shows what a wrong one should have been", () => {
    const quiz = new Quiz(all, { repeats: true });
    expect(quiz.answer([1, 2])).toBe("usual");
    expect(quiz.current?.note.index).toBe(2);
    expect(quiz.answer([1])).toBe("wrong");
    expect(quiz.shown).toBe(true);
    expect(quiz.answer([]), "it was shown").toBeNull();
    quiz.goOn();
    expect(quiz.current?.note.index).toBe(3);
  });

  it("asks again for what was not known, a few questions later, and counts the first try", () => {
    const quiz = new Quiz(all, { repeats: true });
    const asked: number[] = [];
    while (quiz.current !== null) {
      const { index } = quiz.current.note;
      const first = !asked.includes(index);
      asked.push(index);
      quiz.answer(index === 0 && first ? [1, 3] : (quiz.current.accepted[0] ?? []));
      quiz.goOn();
    }
    expect(asked).toEqual([0, 2, 3, 4, 0]);
    expect([quiz.right, quiz.missed.length, quiz.answered, quiz.total]).toEqual([3, 1, 4, 4]);
  });

  it("asks until it is known", () => {
    const quiz = new Quiz(all.slice(0, 1), { repeats: true });
    for (let tries = 0; tries < 3; tries += 1) {
      quiz.answer([2]);
      quiz.goOn();
    }
    expect(quiz.current?.note.index).toBe(0);
    expect(quiz.missed).toHaveLength(1);
    quiz.answer([3]);
    expect(quiz.current).toBeNull();
    expect(quiz.right).toBe(0);
  });

  it("waits for nobody in time", () => {
    const quiz = new Quiz(all, { repeats: false });
    quiz.answer([2]);
    expect([quiz.shown, quiz.current?.note.index]).toEqual([false, 2]);
    for (let rest = 0; rest < 3; rest += 1) quiz.answer([3]);
    expect(quiz.current).toBeNull();
    expect([quiz.right, quiz.missed.length]).toEqual([1, 3]);
  });
});
