// A reading on every packing, as dots on one line, over what the laboratory measured and allows.
import { number } from "./numbers.js";
import { svgElement, svgLine, svgPicture } from "./svg.js";

const [width, height, edge] = [160, 18, 6];

/**
 * Where a value lies across the strip [pixels]; in the middle if all are one.
 * @param {number[]} values all that are shown
 * @returns {(value: number) => number}
 */
export function stripScale(values) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  return (value) => edge + (width - 2 * edge) * (high > low ? (value - low) / (high - low) : 0.5);
}

/**
 * Null where the card does not say what each packing read.
 * @param {import("./content.js").Reading} reading
 */
export function packingStrip({ packings, measured, tolerance = 0, simulated }) {
  if (packings.length === 0) return null;
  const allowed = measured === undefined ? [] : [measured - tolerance, measured + tolerance];
  const x = stripScale([...packings, ...allowed]);
  /** @type {(value: number, kind: string) => Element} */
  const line = (value, kind) => svgLine([x(value), 2], [x(value), height - 2], kind);
  /** @type {Element[]} */
  const marks = [];
  if (measured !== undefined) {
    const [low, high] = allowed.map(x);
    const box = { x: low, width: Math.max(high - low, 1), y: 4, height: height - 8, class: "allowed" };
    marks.push(svgElement("rect", box), line(measured, "measured-mark"));
  }
  const dots = packings.map((value) =>
    svgElement("circle", { cx: x(value), cy: height / 2, r: 2.6, class: "packing" }),
  );
  marks.push(...dots, line(simulated, "mean-mark"));
  const ends = [Math.min(...packings), Math.max(...packings)].map((value) => number(value));
  return svgPicture([width, height], "strip", `${packings.length} packings, ${ends.join(" to ")}`, marks);
}
