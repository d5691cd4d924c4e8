// The fitted parameters with their intervals, and the fixed ones.
import { element, pairs, section, table } from "./dom.js";
import { withUnit, words, wordsAndUnit } from "./names.js";
import { number } from "./numbers.js";
import { svgElement, svgLine, svgPicture } from "./svg.js";

/** @typedef {import("./content.js").Parameter} Parameter */
/** @typedef {import("./content.js").Range} Range */
/** @typedef {Parameter & Range & {value: number}} FittedParameter */

/** @type {(parameter: Parameter) => parameter is Parameter & Range} */
export const isFree = (parameter) => parameter.free;

/** @type {(parameter: Parameter) => parameter is FittedParameter} */
const isFitted = (parameter) => isFree(parameter) && parameter.value !== undefined;

/**
 * The share of the way from the lower to the upper bound.
 * @param {Range} range
 * @param {number} value
 */
export function shareOf({ lower, upper, scale }, value) {
  /** @param {number} x */
  const along = (x) => (scale === "log" ? Math.log(x) : x);
  return Math.min(Math.max((along(value) - along(lower)) / (along(upper) - along(lower)), 0), 1);
}

/**
 * The bounds of the study as a line, the interval on it, and the value.
 * @param {FittedParameter} parameter
 */
function bar(parameter) {
  const [width, height, edge] = [200, 18, 6];
  const middle = height / 2;
  /** @param {number} value */
  const x = (value) => edge + (width - 2 * edge) * shareOf(parameter, value);
  /** @type {Element[]} */
  const marks = [svgLine([edge, middle], [width - edge, middle], "bounds")];
  if (parameter.interval) {
    const [low, high] = parameter.interval.map(x);
    const box = { x: low, width: Math.max(high - low, 2), y: middle - 4, height: 8, rx: 2, class: "interval" };
    marks.push(svgElement("rect", box));
  }
  marks.push(svgElement("circle", { cx: x(parameter.value), cy: middle, r: 5, class: "value" }));
  const label = `from ${number(parameter.lower)} to ${number(parameter.upper)}`;
  return svgPicture([width, height], "bar", label, marks);
}

/**
 * The ends of an interval; one that the readings do not set is marked.
 * @param {Parameter} parameter
 */
export function endsInWords({ interval = [NaN, NaN], at_bounds: bounds = [false, false] }) {
  return interval.map((end, i) => number(end, 3) + (bounds[i] ? " (the study's bound)" : "")).join(" to ");
}

/**
 * @param {Parameter} parameter
 * @param {number} level
 */
function intervalWords(parameter, level) {
  if (parameter.interval) return endsInWords(parameter);
  return parameter.not_identified ?? (level > 0 ? "not bounded by the readings" : "not worked out");
}

/**
 * @param {FittedParameter} one
 * @param {number} level
 */
function row(one, level) {
  const upper = `${number(one.upper, 3)}${one.scale === "log" ? ", log" : ""}`;
  const ends = [element("span", {}, number(one.lower, 3)), element("span", {}, upper)];
  return element(
    "tr",
    {},
    element(
      "th",
      { scope: "row" },
      wordsAndUnit(one.name),
      element("small", {}, one.meaning),
      element("small", {}, "in files: ", element("code", {}, one.name)),
    ),
    element("td", { class: "number" }, number(one.value)),
    element("td", {}, intervalWords(one, level)),
    element("td", {}, bar(one), element("small", { class: "ends" }, ...ends)),
  );
}

/**
 * With the key that files know it by.
 * @param {Parameter} parameter
 */
function fixedValue({ name, value }) {
  return [withUnit(number(value), name), element("small", {}, element("code", {}, name))];
}

/** @param {import("./content.js").CardContent} content */
export function parametersPart({ parameters, interval_level: level, radius_mm: radius }) {
  const free = parameters.filter(isFitted);
  const fixed = parameters.filter((one) => !one.free);
  const head = element(
    "tr",
    {},
    element("th", {}, "Parameter"),
    element("th", { class: "number" }, "Value"),
    element("th", {}, level > 0 ? `${number(100 * level, 3)} % interval` : "Interval"),
    element("th", {}, "Within the bounds"),
  );
  const rows = free.map((one) => row(one, level));
  return section(
    "parameters",
    "The material",
    `Scale-free parameters, fitted with grains of ${number(radius, 3)} mm radius. ` +
      "The bar is what the readings leave open within the study's bounds.",
    element("div", { class: "wide" }, table(head, rows)),
    element(
      "details",
      {},
      element("summary", {}, `${fixed.length} fixed parameters`),
      pairs(fixed.map((one) => [element("span", { title: one.meaning }, words(one.name)), fixedValue(one)])),
    ),
  );
}
