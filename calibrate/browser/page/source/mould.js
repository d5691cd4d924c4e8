// The drawing of a mould and of the heap that it leaves, to scale, with what is measured.
import { svgElement, svgLine, svgPicture } from "../../../report/page/source/svg.js";
import { number } from "../../../report/page/source/numbers.js";

/** @typedef {import("./sheet.js").Mould} Mould */
/** @typedef {import("./language.js").Texts} Texts */
/** @typedef {[x: number, y: number]} Place */

const [width, height] = [360, 190];
const ground = 140;
const middle = 160;
const room = { across: 250, up: 112 };

/**
 * @param {Place} place
 * @param {string} words
 * @param {string} anchor
 */
function lettering([x, y], words, anchor = "middle") {
  const text = svgElement("text", { x, y, "text-anchor": anchor });
  text.textContent = words;
  return text;
}

/**
 * A line with a bar at each end.
 * @param {Place} from
 * @param {Place} to
 * @param {string} kind
 */
function dimension([x1, y1], [x2, y2], kind) {
  const [bx, by] = x1 === x2 ? [4, 0] : [0, 4];
  return [
    svgLine([x1, y1], [x2, y2], kind),
    svgLine([x1 - bx, y1 - by], [x1 + bx, y1 + by], kind),
    svgLine([x2 - bx, y2 - by], [x2 + bx, y2 + by], kind),
  ];
}

/**
 * The line of a heap of this width and height about the middle: round at its top, steep at its foot.
 * @param {number} wide
 * @param {number} high
 */
function heapLine(wide, high) {
  const [left, right, top] = [middle - wide / 2, middle + wide / 2, ground - high];
  const [steep, flat, shoulder] = [0.06 * wide, 0.2 * wide, top + 0.25 * high];
  const up = `C${left + steep},${shoulder} ${left + flat},${top} ${middle},${top}`;
  const down = `C${right - flat},${top} ${right - steep},${shoulder} ${right},${ground}`;
  return `M${left},${ground} ${up} ${down} Z`;
}

/**
 * @param {number} drops
 * @param {Texts} texts
 */
function groundMarks(drops, texts) {
  const [left, right] = [middle - 140, middle + 140];
  if (drops === 0) return [svgLine([left, ground], [right, ground], "mould-ground")];
  const plate = svgElement("rect", { x: left, y: ground, width: right - left, height: 5, class: "mould-plate" });
  const lifted = drops === 1 ? svgLine([left, ground + 5], [right, ground - 10], "mould-lifted") : null;
  const words = drops === 1 ? texts.plate : `${texts.table}, \u00d7 ${drops}`;
  return [plate, ...(lifted ? [lifted] : []), lettering([right, ground + 20], words, "end")];
}

/**
 * @param {Mould} mould
 * @param {number} drops
 * @param {Texts} texts
 */
export function mouldDrawing({ base_diameter_mm: base, top_diameter_mm: top, height_mm: tall }, drops, texts) {
  const heap = [1.65 * Math.max(base, top), 0.42 * tall]; // of a middling paste
  const scale = Math.min(room.across / Math.max(heap[0], base, top), room.up / tall);
  const [wide, high, rim] = [scale * heap[0], scale * heap[1], ground - scale * tall];
  const corners = [
    [middle - (scale * base) / 2, ground],
    [middle - (scale * top) / 2, rim],
    [middle + (scale * top) / 2, rim],
    [middle + (scale * base) / 2, ground],
  ];
  const [beside, below] = [middle + wide / 2 + 14, ground + 14];
  const measured = [texts.slump, texts.height, texts.spread].join(", ");
  return svgPicture(
    [width, height],
    "mould-drawing",
    texts.mouldPicture.replace("{what}", () => measured),
    [
      svgElement("path", { d: heapLine(wide, high), class: "mould-heap" }),
      svgElement("polyline", { points: corners.map((one) => one.join(",")).join(" "), class: "mould-wall" }),
      ...groundMarks(drops, texts),
      svgLine([middle, rim], [beside + 4, rim], "mould-link"),
      svgLine([middle, ground - high], [beside + 4, ground - high], "mould-link"),
      ...dimension([beside, rim], [beside, ground - high], "mould-measure"),
      ...dimension([beside, ground - high], [beside, ground], "mould-measure"),
      lettering([beside + 8, (rim + ground - high) / 2 + 4], texts.slump, "start"),
      lettering([beside + 8, ground - high / 2 + 4], texts.height, "start"),
      ...dimension([middle - wide / 2, below], [middle + wide / 2, below], "mould-measure"),
      lettering([middle - wide / 2, below + 17], texts.spread, "start"),
      lettering([middle, rim - 6], `\u2300 ${number(top)} mm`),
      lettering([middle, ground - 6], `\u2300 ${number(base)} mm`),
      lettering([middle - (scale * Math.max(base, top)) / 2 - 4, rim + 14], `${number(tall)} mm`, "end"),
    ],
  );
}

const millimetres = { mm: 1, cm: 10, in: 25.4 };

/**
 * The mould of the fields of its own dimensions, once all are typed.
 * @param {import("./sheet.js").Values} values
 * @returns {Mould | null}
 */
export function typedMould({ base, top, moulded, lengthUnit }) {
  const unit = millimetres[/** @type {keyof typeof millimetres} */ (lengthUnit)] ?? 1;
  const [wide, narrow, tall] = [base, top, moulded].map((text) => unit * Number.parseFloat(text ?? ""));
  if (!(wide > 0 && narrow > 0 && tall > 0)) return null;
  return { base_diameter_mm: wide, top_diameter_mm: narrow, height_mm: tall };
}
