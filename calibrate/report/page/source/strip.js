// A reading on every packing, as dots on one line, over what the laboratory measured and allows.
import { svgElement } from "./dom.js";
import { number } from "./numbers.js";

const [width, height, edge] = [160, 18, 6];

/// Null where the card does not say what each packing read.
export function packingStrip({ packings = [], measured, tolerance, simulated }) {
  if (packings.length === 0) return null;
  const ends = [...packings, ...(measured === undefined ? [] : [measured - tolerance, measured + tolerance])];
  const [low, high] = [Math.min(...ends), Math.max(...ends)];
  const x = (value) => edge + (width - 2 * edge) * (high > low ? (value - low) / (high - low) : 0.5);
  const line = (value, kind) => svgElement("line", { x1: x(value), x2: x(value), y1: 2, y2: height - 2, class: kind });
  const laboratory =
    measured === undefined
      ? []
      : [
          svgElement("rect", {
            x: x(measured - tolerance),
            width: Math.max(x(measured + tolerance) - x(measured - tolerance), 1),
            y: 4,
            height: height - 8,
            class: "allowed",
          }),
          line(measured, "measured-mark"),
        ];
  return svgElement(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      class: "strip",
      role: "img",
      "aria-label": `${packings.length} packings, ${number(Math.min(...packings))} to ${number(Math.max(...packings))}`,
    },
    ...laboratory,
    ...packings.map((value) => svgElement("circle", { cx: x(value), cy: height / 2, r: 2.6, class: "packing" })),
    line(simulated, "mean-mark"),
  );
}
