// One simulation of the search, as small pictures and numbers.
import { element, pairs } from "./dom.js";
import { fullName, withUnit, words } from "./names.js";
import { number, plusMinus } from "./numbers.js";
import { isFree, shareOf } from "./parameters.js";
import { kindOf } from "./simulation.js";
import { edge, size, sketchOf } from "./sketch.js";
import { svgElement, svgLine, svgPicture } from "./svg.js";

/** @typedef {import("./content.js").Content} Content */
/** @typedef {import("./content.js").Simulation} Simulation */

/**
 * Where its parameters lie within their bounds: a line through one axis each.
 * @param {Simulation} simulation
 * @param {Content} content
 */
function picture({ values }, { parameters = [] }) {
  const free = parameters.filter(isFree).filter(({ name }) => values[name] !== undefined);
  if (free.length === 0) return null;
  const [width, height] = size;
  const x = free.map((_, k) => (free.length > 1 ? edge + ((width - 2 * edge) * k) / (free.length - 1) : width / 2));
  /** @type {(k: number, value: number) => string} */
  const place = (k, value) => `${x[k]},${height - edge - (height - 2 * edge) * shareOf(free[k], value)}`;
  const own = free.map(({ name }, k) => place(k, values[name]));
  const fitted = free.flatMap(({ value }, k) => (value === undefined ? [] : [place(k, value)]));
  const dots = own.map((one) => {
    const [cx, cy] = one.split(",");
    return svgElement("circle", { cx, cy, r: 3.5, class: "own" });
  });
  return svgPicture(size, "candidate-picture", "its parameters within their bounds; thin: the fitted ones", [
    ...x.map((at) => svgLine([at, edge], [at, height - edge], "bounds")),
    svgElement("polyline", { points: fitted.join(" "), class: "fitted" }),
    svgElement("polyline", { points: own.join(" "), class: "own" }),
    ...dots,
  ]);
}

/**
 * Its parameters, and its readings with the laboratory's in brackets: those that were taken, if any are known.
 * @param {Simulation} simulation
 * @param {Content} content
 * @returns {[name: string, value: string][]}
 */
function numbersOf({ test, values, readings }, { search: { measured }, inference }) {
  const anyMeasured = Object.keys(measured).length > 0;
  /** @type {[string, string][]} */
  const rows = Object.entries(values).map(([name, value]) => [words(name), withUnit(number(value), name)]);
  for (const [name, value] of Object.entries(readings)) {
    const full = fullName(test, name);
    const known = measured[full];
    if (anyMeasured && known === undefined) continue;
    const told = withUnit(plusMinus(value, inference?.noise?.[full]), name);
    rows.push([words(name), known === undefined ? told : `${told} (${number(known)})`]);
  }
  return rows;
}

/**
 * @param {Simulation} simulation
 * @param {Content} content
 */
export function candidateCard(simulation, content) {
  const { number: place, test, packing, misfit, failure, ended_early: ended } = simulation;
  const { search } = content;
  const misfitWords = `Misfit ${ended ? "at least " : ""}${number(misfit, 3)} ${search.error_unit}`;
  const kind = ` ${kindOf(simulation)}${test ? `, test ${test}` : ""}, packing ${packing}`;
  return element(
    "div",
    { class: "candidate" },
    element("p", {}, element("strong", {}, `Simulation ${place}`), kind),
    misfit === undefined ? null : element("p", {}, misfitWords),
    failure ? element("p", { class: "failed" }, failure) : null,
    sketchOf(simulation, search),
    picture(simulation, content),
    pairs(numbersOf(simulation, content)),
  );
}
