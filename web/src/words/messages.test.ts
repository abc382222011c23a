import { describe, expect, it } from "vitest";

/** Each area's English module, as it stands, and its messages in the other languages. */
const ENGLISH = import.meta.glob<string>("./*/en.ts", { query: "?raw", import: "default", eager: true });
const MODULES = import.meta.glob<Record<string, object>>("./*/en.ts", { eager: true });
const OTHERS = import.meta.glob<Messages>("./*/{de,ja}.json", { import: "default", eager: true });

type Message = string | Readonly<Record<string, string>>;
type Messages = Readonly<Record<string, Message>>;

/** What may be the same in German or Japanese as in English. */
const SAME =
  /^(\p{P}|\s|\{\w+\}|%|Film|Show|Name|HTML|Letter|Detail|Instrument|Position|MIDI|BVH|Euphonium|Spot|Tempo|Solo|Keyframes?|Looks?|Ctrl|Del|CCD|FABRIK|Slerp|Matrix|Shift|Home|End)*$/u;

const areas = Object.keys(ENGLISH).map((path) => path.split("/")[1] ?? "");

/** An area's messages as English says them: texts, and forms for numbers. */
function english(area: string): Messages {
  const source = ENGLISH[`./${area}/en.ts`] ?? "";
  const exports = Object.values(MODULES[`./${area}/en.ts`] ?? {});
  expect(source).toContain(`words("${area}"`);
  expect(exports).toHaveLength(1);
  const found: Record<string, Message> = {};
  for (const [name, shown] of Object.entries(exports[0] ?? {})) found[name] = recorded(shown as Message | Said);
  return found;
}

type Said = (values: Readonly<Record<string, unknown>>) => string;

/** What a message says, with its places still in it. */
function recorded(message: Message | Said): Message {
  if (typeof message !== "function") return message;
  const places = new Proxy({}, { get: (_, name) => (name === "count" ? 2 : `{${String(name)}}`) });
  return message(places);
}

function placesOf(message: Message): ReadonlySet<string> {
  const texts = typeof message === "string" ? [message] : Object.values(message);
  return new Set(texts.flatMap((text) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name = ""]) => name)));
}

describe.each(areas)("the messages of %s", (area) => {
  const own = english(area);

  describe.each(["de", "ja"])("in %s", (code) => {
    const other = OTHERS[`./${area}/${code}.json`] ?? {};

    it("are all there, and no others", () => {
      expect(Object.keys(other)).toEqual(Object.keys(own));
    });

    it("have the same places in them", () => {
      for (const [name, message] of Object.entries(other)) {
        const places = new Set([...placesOf(message)].filter((place) => place !== "count"));
        const expected = new Set([...placesOf(own[name] ?? "")].filter((place) => place !== "count"));
        expect(places, name).toEqual(expected);
      }
    });

    it("have every form that the language's numbers need", () => {
      const forms = new Intl.PluralRules(code).resolvedOptions().pluralCategories.toSorted();
      for (const [name, message] of Object.entries(other)) {
        if (typeof message !== "string") expect(Object.keys(message).toSorted(), name).toEqual(forms);
      }
    });

    it("are not English", () => {
      const same = Object.entries(other).filter(
        ([name, message]) => typeof message === "string" && message === own[name] && !SAME.test(message),
      );
      expect(same).toEqual([]);
    });
  });
});
