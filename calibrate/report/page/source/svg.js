// Small pictures in the text: shapes of SVG in a frame of pixels.

const svgNames = "http://www.w3.org/2000/svg";

/**
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, string | number>} attributes
 * @param {...Element} children
 */
export function svgElement(tag, attributes = {}, ...children) {
  const made = document.createElementNS(svgNames, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

/**
 * @param {[width: number, height: number]} size
 * @param {string} kind its class
 * @param {string} label what it shows, for those who do not see it
 * @param {Element[]} marks
 */
export function svgPicture([width, height], kind, label, marks) {
  const attributes = { viewBox: `0 0 ${width} ${height}`, class: kind, role: "img", "aria-label": label };
  return svgElement("svg", attributes, ...marks);
}

/**
 * @param {[x: number, y: number]} from
 * @param {[x: number, y: number]} to
 * @param {string} kind its class
 */
export function svgLine([x1, y1], [x2, y2], kind) {
  return svgElement("line", { x1, y1, x2, y2, class: kind });
}
