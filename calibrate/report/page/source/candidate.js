// One simulation of the search, as a small picture and numbers.
import { element, svgElement } from "./dom.js";
import { number, unitOf, words } from "./numbers.js";
import { shareOf } from "./parameters.js";

/// Where its parameters lie within their bounds: a line through one axis each.
function picture(point, free) {
  const [width, height, edge] = [220, 90, 10];
  const x = (k) => (free.length > 1 ? edge + ((width - 2 * edge) * k) / (free.length - 1) : width / 2);
  const y = (share) => height - edge - (height - 2 * edge) * share;
  const told = free.map((one, k) => [x(k), y(shareOf(one, point.values[one.name] ?? one.value))]);
  const best = free.map((one, k) => [x(k), y(shareOf(one, one.value))]);
  return svgElement("svg", { viewBox: `0 0 ${width} ${height}`, class: "candidate-picture", role: "img", "aria-label": "its parameters within their bounds; thin: the fitted ones" },
    ...free.map((_, k) => svgElement("line", { x1: x(k), x2: x(k), y1: edge, y2: height - edge, class: "bounds" })),
    svgElement("polyline", { points: best.map((place) => place.join(",")).join(" "), class: "fitted" }),
    svgElement("polyline", { points: told.map((place) => place.join(",")).join(" "), class: "own" }),
    ...told.map(([cx, cy]) => svgElement("circle", { cx, cy, r: 3.5, class: "own" })));
}

/// What it was for, and how it ended.
export function kindOf(point) {
  if (point.failure) return "failure";
  if (point.confirmation) return "confirmation";
  if (point.other_grains) return "other grains";
  return point.ended_early ? "ended early" : "search";
}

/// `measured`: readings of the laboratory by name, of all tests.
export function candidateCard(point, parameters, measured, unit) {
  const free = parameters.filter((one) => one.free && point.values[one.name] !== undefined);
  const told = Object.entries(point.readings).filter(([name]) => measured.size === 0 || measured.has(name));
  const misfit = point.misfit === undefined ? null : `${point.ended_early ? "at least " : ""}${number(point.misfit, 3)} ${unit}`;
  return element("div", { class: "candidate" },
    element("p", {}, element("strong", {}, `Simulation ${point.number}`), ` ${kindOf(point)}${point.test ? `, test ${point.test}` : ""}, packing ${point.packing}`),
    misfit ? element("p", {}, `Misfit ${misfit}`) : null,
    point.failure ? element("p", { class: "failed" }, point.failure) : null,
    free.length > 0 ? picture(point, free) : null,
    element("dl", { class: "pairs" }, ...Object.entries(point.values).flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, number(value))]),
      ...told.flatMap(([name, value]) => [element("dt", {}, words(name)),
        element("dd", {}, `${number(value)} ${unitOf(name)}${measured.has(name) ? ` (${number(measured.get(name))})` : ""}`)])));
}
