/** Finds text for people that stands in the code itself, where it should be a message: what the test of all files asks. */

import { parse } from "svelte/compiler";

/** Attributes that people read or hear. */
const READ = new Set([
  "title",
  "alt",
  "placeholder",
  "label",
  "aria-label",
  "aria-description",
  "aria-roledescription",
  "aria-valuetext",
]);
/** Errors for those who program: people see their words only where the page is broken. */
const FOR_PROGRAMMERS = /^(Type|Range|Rig|Layout)Error$/;
/** Calls whose strings are the browser's or the API's. */
const NOT_READ = /^(startsWith|querySelector|querySelectorAll|closest|matchMedia|getContext|execCommand|matches)$/;
/** What is the same in every language. */
const NAMES = new Set(["Reina", "MIDI", "JSON", "BVH", "PNG", "PDF", "HTML", "MP4", "WebM", "Opus", "kB", "MB", "mm"]);
/** What stands on keys, which `keyLabel` says. */
const KEYS = /^((Ctrl|Shift|Alt|Del|Esc)( |$))*(\S|F10|[←→])?$/;
/** What keys are called by KeyboardEvent, and other words of the web. */
const WEB =
  /^(Arrow(Up|Down|Left|Right)|Home|End|Enter|Escape|Delete|Backspace|Tab|Space|Plus|Page(Up|Down)|Shift(\+.*)?|Control|Alt|Meta|Bearer|Accept|Authorization|Content-Type|If-Match|AbortError|Files)$/;

interface Node {
  readonly type: string;
  readonly [key: string]: unknown;
}

/**
 * Texts of a source that look as if people were to read them.
 *
 * @param source of a Svelte component, or of a module
 * @param isComponent which of the two it is
 */
export function literalTexts(source: string, isComponent: boolean): string[] {
  const code = isComponent ? source : `<script lang="ts">\n${source.replaceAll("</script", "<\\/script")}\n</script>`;
  const found: string[] = [];
  const { fragment, instance, module } = parse(code, { modern: true });
  for (const part of [fragment, instance, module]) if (isNode(part)) visit(part, [], found);
  return found;
}

function visit(node: Node, above: readonly Node[], found: string[]): void {
  if (isLeftOut(node, above)) return;
  const text = textOf(node, above);
  if (text !== null && !NAMES.has(text.replaceAll("…", "").trim())) found.push(text.trim().replaceAll(/\s+/g, " "));
  const path = [...above, node];
  for (const value of Object.values(node)) {
    for (const child of Array.isArray(value) ? value : [value]) if (isNode(child)) visit(child, path, found);
  }
}

function textOf(node: Node, above: readonly Node[]): string | null {
  const parent = above.at(-1);
  if (node.type === "Text") {
    const data = String(node["data"]);
    if (parent?.type === "Attribute") {
      const owner = above.at(-2)?.type;
      const read = owner === "Component" ? isSentence(data) : READ.has(String(parent["name"]));
      return read && hasWord(data) ? data : null;
    }
    return hasWord(data) ? data : null;
  }
  if (node.type === "Literal" && typeof node["value"] === "string") {
    const { value } = node;
    return isSentence(value) || (isShown(above) && hasWord(value)) ? value : null;
  }
  if (node.type === "TemplateLiteral") {
    const pieces = (node["quasis"] as readonly { value: { raw: string } }[]).map(({ value }) => value.raw);
    const whole = pieces.join("…");
    return isSentence(whole) || (isShown(above) && pieces.some(hasWord)) ? whole : null;
  }
  return null;
}

/** What an expression comes to that stands between tags, or in an attribute that people read: `{one ? "note" : "notes"}`. */
function isShown(above: readonly Node[]): boolean {
  const place = above.findLastIndex(({ type }) => !/^(Conditional|Logical)Expression$|^TemplateLiteral$/.test(type));
  if (above[place]?.type !== "ExpressionTag") return false;
  const parent = above[place - 1];
  return parent?.type !== "Attribute" || READ.has(String(parent["name"]));
}

function hasWord(text: string): boolean {
  return /\p{L}{2}/u.test(text);
}

/** Two words in a row, or one that begins with a capital. */
function isSentence(text: string): boolean {
  const trimmed = text.trim();
  if (WEB.test(trimmed) || KEYS.test(trimmed) || /[;{}=]|^[.#[(/-]|gl_|vec\d|\bserif$|^\d+px /.test(trimmed))
    return false;
  return /\p{L}[\p{L}’']*[,.:;]? [“„(]?(\p{L}|…)|… \p{L}{2}/u.test(trimmed) || /^\p{Lu}\p{Ll}+[ .!?…]*$/u.test(trimmed);
}

function isLeftOut(node: Node, above: readonly Node[]): boolean {
  const { type } = node;
  if (/^Import|^ExportAll/.test(type)) return true;
  if (/^TS(?!(As|Satisfies|NonNull|TypeAssertion)Expression$)/.test(type)) return true;
  if (type === "StyleDirective" || type === "ClassDirective") return true;
  if (type === "Attribute" && /^(class|style|d|href|type|accept|role|id|points|viewBox)$/.test(String(node["name"])))
    return true;
  if (type === "RegularElement" && /^(style|code|kbd|script)$/.test(String(node["name"]))) return true;
  if (type === "BinaryExpression") return /^[=!]==?$/.test(String(node["operator"]));
  if (type === "NewExpression") return FOR_PROGRAMMERS.test(nameOf(node["callee"]));
  if (type === "CallExpression") return NOT_READ.test(nameOf(node["callee"]));
  const parent = above.at(-1);
  if (parent?.type === "Property" && parent["key"] === node && parent["computed"] !== true) return true;
  return parent?.type === "PropertyDefinition" && nameOf(parent["key"]) === "name";
}

function nameOf(node: unknown): string {
  if (!isNode(node)) return "";
  if (node.type === "MemberExpression") return nameOf(node["property"]);
  return typeof node["name"] === "string" ? node["name"] : "";
}

function isNode(value: unknown): value is Node {
  return typeof value === "object" && value !== null && typeof (value as Node).type === "string";
}
