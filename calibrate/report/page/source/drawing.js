// The drawings of a test (calibrate/laboratory/drawing.h): a heap with its dimensions, a curve over its strength.
import { element, figure } from "./dom.js";
import { unitOf } from "./names.js";
import { plusMinus } from "./numbers.js";
import { colour, legend, lettering, Plot } from "./plots.js";

/** @typedef {import("./content.js").Drawing} Drawing */
/** @typedef {import("./content.js").Length} Length */
/** @typedef {import("./content.js").Line} Line */
/** @typedef {import("./content.js").Point} Point */

/** @type {(one: Point, other: Point) => Point} */
const middle = ([x1, y1], [x2, y2]) => [(x1 + x2) / 2, (y1 + y2) / 2];

/**
 * The box of all that is drawn.
 * @param {Drawing} drawing
 * @returns {{x: Point, y: Point}}
 */
export function boxOf({ bands, lines, lengths }) {
  const xs = [];
  const ys = [];
  for (const [x, low, high] of bands.flatMap(({ points }) => points)) {
    xs.push(x);
    ys.push(low, high);
  }
  for (const [x, y] of [...lines.flatMap(({ points }) => points), ...lengths.flatMap(({ from, to }) => [from, to])]) {
    xs.push(x);
    ys.push(y);
  }
  return { x: [Math.min(...xs), Math.max(...xs)], y: [Math.min(...ys), Math.max(...ys)] };
}

/** @param {Length} length */
export const isUpright = ({ from, to }) => from[0] === to[0];

/**
 * Where the text of a length stands, and how. Beside an arrow that is shorter than its text there is no room; above it
 * there is, one line for each.
 * @param {Length} length
 * @param {string} text
 * @param {number} scale pixels for 1 upwards
 * @param {Point} among from where to where the axis goes
 */
function textOf(length, text, scale, among) {
  const centre = middle(length.from, length.to);
  if (!isUpright(length)) return { place: centre, options: { dy: -8 } };
  const [low, high] = [length.from[1], length.to[1]];
  if (Math.abs(high - low) * scale > 6.6 * text.length) return { place: centre, options: { rotate: -90, dx: -8 } };
  const left = centre[0] < (among[0] + among[1]) / 2;
  const dy = length.by === "laboratory" && !left ? -28 : -10;
  /** @type {Plot.TextOptions} */
  const options = { dy, dx: left ? -10 : 12, textAnchor: left ? "start" : "end" };
  return { place: [centre[0], Math.max(low, high)], options };
}

/**
 * A length: thin lines from what it is the distance of, arrows at both ends, and its value.
 * @param {Length} length
 * @param {number} scale
 * @param {Point} among
 */
function lengthMarks(length, scale, among) {
  const stroke = colour[/** @type {"laboratory" | "simulation"} */ (length.by)];
  const text = `${plusMinus(length.value, length.deviation)} ${unitOf(length.reading)}`;
  const { place, options } = textOf(length, text, scale, among);
  const [x1, y1] = middle(length.from, length.to);
  const arrows = [length.from, length.to].map(([x2, y2]) => ({ x1, y1, x2, y2 }));
  const links = [
    { x1: length.first[0], y1: length.first[1], x2: length.from[0], y2: length.from[1] },
    { x1: length.last[0], y1: length.last[1], x2: length.to[0], y2: length.to[1] },
  ];
  const ends = { x1: "x1", y1: "y1", x2: "x2", y2: "y2", stroke };
  const halo = { stroke: "var(--page)", strokeWidth: 4, fontWeight: 600 };
  return [
    Plot.link(links, { ...ends, strokeWidth: 0.7, strokeDasharray: "2 3" }),
    Plot.arrow(arrows, { ...ends, strokeWidth: 1.4, headLength: 7, headAngle: 40 }),
    Plot.text([place], { text: () => text, fill: stroke, ...halo, ...options }),
  ];
}

/** How a line looks, by whose word it is. */
const looks = {
  laboratory: { stroke: colour.laboratory, strokeWidth: 2.2, strokeDasharray: "8 3" },
  simulation: { stroke: colour.simulation, strokeWidth: 2.2 },
  apparatus: { stroke: colour.apparatus, strokeWidth: 1.2, strokeDasharray: "5 3" },
  run: { stroke: colour.simulation, strokeWidth: 0.8, strokeOpacity: 0.6 },
  rejected: { stroke: colour.failure, strokeWidth: 1, strokeOpacity: 0.9 },
};

/** @param {Line} line */
function lineMarks({ by, points, deviation }) {
  const line = Plot.line(points, looks[by]);
  if (deviation <= 0) return [line];
  const area = { x: "0", fill: looks[by].stroke, fillOpacity: 0.15 };
  return [Plot.areaY(points, { ...area, y1: ([, y]) => y - deviation, y2: ([, y]) => y + deviation }), line];
}

/**
 * Height and domain of a drawing of some width [pixels], and how many pixels are 1 upwards. A drawing to scale is as
 * high as its width makes it; of others the ground is shown.
 * @param {Drawing} drawing
 * @param {number} width
 */
export function frameOf(drawing, width) {
  const { x, y } = boxOf(drawing);
  const margins = { marginLeft: 52, marginRight: 24, marginTop: drawing.to_scale ? 16 : 30, marginBottom: 42 };
  const beside = margins.marginLeft + margins.marginRight;
  const above = margins.marginTop + margins.marginBottom;
  if (drawing.to_scale) {
    const scale = (width - beside) / (x[1] - x[0]);
    const pad = 0.04 * (y[1] - y[0]);
    const domain = [y[0] - pad, y[1] + pad];
    return { x, y: domain, height: Math.round((domain[1] - domain[0]) * scale + above), scale, margins };
  }
  const height = Math.round(Math.min(420, 0.6 * width));
  const domain = [Math.min(0, y[0]), 1.05 * y[1]];
  return { x, y: domain, height, scale: (height - above) / (domain[1] - domain[0]), margins };
}

/**
 * @param {Drawing} drawing
 * @param {number} width
 */
function drawn(drawing, width) {
  const { x, y, height, scale, margins } = frameOf(drawing, width);
  const band = { x: "0", y1: "1", y2: "2", fill: colour.simulation, fillOpacity: 0.22 };
  return Plot.plot({
    width,
    height,
    ...margins,
    style: lettering,
    x: { label: drawing.x, domain: x, labelAnchor: "center", labelArrow: "none" },
    y: { label: drawing.y, domain: y, labelArrow: "none", ticks: drawing.to_scale ? 5 : undefined },
    marks: [
      ...drawing.bands.map(({ points }) => Plot.areaY(points, band)),
      ...drawing.lines.flatMap(lineMarks),
      ...drawing.lengths.flatMap((length) => lengthMarks(length, scale, x)),
    ],
  });
}

/**
 * @param {Drawing} drawing
 * @returns {[name: string, sign: string][]} lines of one name share an entry
 */
export function legendOf({ bands, lines, lengths }) {
  const lengthWords = (/** @type {string} */ by) =>
    by === "laboratory"
      ? "the laboratory's lengths \u00b1 deviation"
      : "simulated lengths, means \u00b1 standard error";
  return [
    ...bands.map(({ name }) => /** @type {[string, string]} */ ([name, "band"])),
    ...new Map(lines.map(({ name, by }) => [name, `line ${by}`])),
    ...new Map(lengths.map(({ by }) => [lengthWords(by), `line ${by}`])),
  ];
}

/**
 * @param {Drawing} drawing
 * @param {string} heading
 */
function caption(drawing, heading) {
  return element("figcaption", {}, element("strong", {}, heading), legend(legendOf(drawing)));
}

/**
 * A drawing of one width, for paper, where nothing is drawn anew.
 * @param {Drawing} drawing
 * @param {number} width
 * @param {string} heading
 */
export function drawingSheet(drawing, width, heading) {
  return element("figure", { class: "sheet-drawing" }, drawn(drawing, width), caption(drawing, heading));
}

/** @param {Drawing} drawing */
export function drawingFigure(drawing) {
  return figure({ class: "test-drawing" }, (width) => drawn(drawing, width), caption(drawing, drawing.name));
}
