// The predicted misfit over two parameters, as fields of colour.
import { withUnit, words, wordsAndUnit } from "./names.js";
import { number } from "./numbers.js";
import { colour, plot, Plot, tip } from "./plots.js";

/** @typedef {import("./content.js").MapAxis} MapAxis */
/** @typedef {import("./content.js").MisfitMap} MisfitMap */

const levels = [1, 2, 3, 5, 8]; // standard deviations
const shades = [0, ...levels].map((_, k) => `var(--shade-${k})`);

/**
 * The edges of the fields of an axis, half way between its places.
 * @param {Pick<MapAxis, "scale" | "places">} axis
 */
export function edgesOf({ scale, places }) {
  /** @type {(one: number, other: number) => number} */
  const between = (one, other) => (scale === "log" ? Math.sqrt(one * other) : (one + other) / 2);
  return [places[0], ...places.slice(1).map((place, k) => between(places[k], place)), places[places.length - 1]];
}

/**
 * @param {MapAxis} axis
 * @returns {Plot.ScaleOptions}
 */
function scaleOf({ name, scale, lower, upper }) {
  const tickFormat = scale === "log" ? "~g" : undefined;
  return { label: wordsAndUnit(name), type: scale, domain: [lower, upper], tickFormat, nice: false, grid: false };
}

/**
 * The fields of the map, row by row, each with its place and its corners.
 * @param {Pick<MisfitMap, "x" | "y" | "miss">} map
 */
export function fieldsOf({ x, y, miss }) {
  const [xs, ys] = [edgesOf(x), edgesOf(y)];
  return miss.map((value, k) => {
    const column = k % x.places.length;
    const row = Math.floor(k / x.places.length);
    const corners = { x1: xs[column], x2: xs[column + 1], y1: ys[row], y2: ys[row + 1] };
    return { value, x: x.places[column], y: y.places[row], ...corners };
  });
}

/**
 * @param {MisfitMap} map
 * @param {number} width
 */
export function mapPlot(map, width) {
  const { x, y, equivalent, simulated } = map;
  const fields = fieldsOf(map);
  const ends = { x1: "x1", x2: "x2", y1: "y1", y2: "y2" };
  /** @type {(axis: MapAxis, value: number) => string} */
  const at = ({ name }, value) => `${words(name)} ${withUnit(number(value, 3), name)}`;
  /** @param {typeof fields[number]} field */
  const title = (field) => `${number(field.value, 2)} standard deviations\n${at(x, field.x)}\n${at(y, field.y)}`;
  const edge = { stroke: "var(--page)" };
  return plot(width, {
    className: "map",
    height: Math.round(Math.min(460, 0.7 * width)),
    x: scaleOf(x),
    y: scaleOf(y),
    color: { type: "threshold", domain: levels, range: shades },
    marks: [
      Plot.rect(fields, { ...ends, fill: "value", inset: -0.3, shapeRendering: "crispEdges" }),
      Plot.dot(simulated, { x: "0", y: "1", r: 2, fill: colour.quiet }),
      Plot.dot(equivalent.slice(1), { x: "0", y: "1", r: 6, symbol: "diamond", fill: colour.equivalent, ...edge }),
      Plot.dot(equivalent.slice(0, 1), { x: "0", y: "1", r: 7, symbol: "star", fill: colour.laboratory, ...edge }),
      tip(fields, { x: "x", y: "y", title }),
    ],
  });
}

/**
 * What the colours mean: [words, class of the sign].
 * @returns {[string, string][]}
 */
export function levelLegend() {
  const between = levels.slice(1).map((level, k) => `${levels[k]} to ${level}`);
  const first = `below ${levels[0]} standard deviation from the laboratory`;
  return [first, ...between, `above ${levels[levels.length - 1]}`].map((text, k) => [text, `field shade-${k}`]);
}
