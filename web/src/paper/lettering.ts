const TEXT = "Academico, serif";
const SVG = "http://www.w3.org/2000/svg";

/** Put a text beside the notes; `kind` is its class. */
export function label(svg: SVGElement, x: number, y: number, text: string, kind: string): SVGTextElement {
  const element = document.createElementNS(SVG, "text");
  element.setAttribute("x", x.toFixed(1));
  element.setAttribute("y", y.toFixed(1));
  element.setAttribute("class", kind);
  element.setAttribute("font-family", kind === "tempo note" ? "Bravura" : TEXT);
  element.textContent = text;
  svg.append(element);
  return element;
}

/** Put a text about the middle of a note. */
export function centred(svg: SVGElement, x: number, y: number, text: string, kind: string): SVGTextElement {
  const element = label(svg, x, y, text, kind);
  element.setAttribute("text-anchor", "middle");
  return element;
}

/** Put a rectangle about a note; `kind` is its class. */
export function rectangle(
  svg: SVGElement,
  x: number,
  y: number,
  width: number,
  height: number,
  kind: string,
): SVGRectElement {
  const element = document.createElementNS(SVG, "rect");
  const attributes = { x, y, width, height, rx: kind === "ring" ? 7 : 0 };
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value.toFixed(1));
  element.setAttribute("class", kind);
  svg.append(element);
  return element;
}
