// The simulations of a search: what each was for, how it ended, and how it is drawn.
import { fullName } from "./names.js";
import { colour, Plot } from "./plots.js";

/** @typedef {import("./content.js").Search} Search */
/** @typedef {import("./content.js").Simulation} Simulation */
/** @typedef {Simulation & {at: number}} Placed with the height at which it is drawn */

/** @type {Record<string, {symbol: Plot.SymbolType, stroke: string}>} */
const kinds = {
  search: { symbol: "circle", stroke: colour.simulation },
  "ended early": { symbol: "triangle", stroke: colour.quiet },
  confirmation: { symbol: "square", stroke: colour.laboratory },
  "other grains": { symbol: "plus", stroke: colour.quiet },
  failure: { symbol: "times", stroke: colour.failure },
};

/**
 * What it was for, and how it ended.
 * @param {Simulation} simulation
 * @returns {string} one of `kinds`
 */
export function kindOf(simulation) {
  if (simulation.failure) return "failure";
  if (simulation.confirmation) return "confirmation";
  if (simulation.other_grains) return "other grains";
  return simulation.ended_early ? "ended early" : "search";
}

/** @param {Simulation[]} history */
export function kindsIn(history) {
  const there = new Set(history.map(kindOf));
  return Object.keys(kinds).filter((kind) => there.has(kind));
}

/**
 * Marks of each kind.
 * @template {Simulation} One
 * @param {One[]} simulations
 * @param {(one: One) => number | undefined} x
 * @param {(one: One) => number | undefined} y
 */
export function dots(simulations, x, y) {
  return Object.entries(kinds).map(([kind, { symbol, stroke }]) => {
    const fill = kind === "confirmation" ? stroke : "none";
    const look = { symbol, stroke, strokeWidth: 1.6, fill, fillOpacity: 0.35, r: 4 };
    const some = simulations.filter((one) => kindOf(one) === kind);
    return Plot.dot(some, { x, y, ...look });
  });
}

/**
 * Those without a misfit are drawn at the upper edge.
 * @param {Pick<Search, "history" | "misfit_asked">} search
 * @returns {Placed[]}
 */
export function placed({ history, misfit_asked: asked = 1 }) {
  const least = 0.02 * asked;
  const most = Math.max(...history.map(({ misfit = 0 }) => misfit), asked);
  return history.map((one) => ({
    ...one,
    at: one.misfit === undefined ? 1.6 * most : Math.max(one.misfit, least),
  }));
}

/**
 * The course of the best single run that the search made.
 * @param {Placed[]} simulations
 */
export function bestSoFar(simulations) {
  let best = Infinity;
  return simulations
    .filter((one) => kindOf(one) === "search" && one.misfit !== undefined)
    .map(({ number, at }) => ({ number, at: (best = Math.min(best, at)) }));
}

/**
 * What is shown to begin with: a run that confirmed the material, or else the best one.
 * @template {Simulation} One
 * @param {One[]} simulations at least one
 */
export function bestOf(simulations) {
  /** @param {One} one */
  const misfit = (one) => (one.ended_early ? Infinity : (one.misfit ?? Infinity));
  const better = (/** @type {One} */ one, /** @type {One} */ other) => (misfit(other) < misfit(one) ? other : one);
  return simulations.find((one) => one.confirmation) ?? simulations.reduce(better);
}

/**
 * The readings of a simulation by their names among those of all tests.
 * @param {Simulation} simulation
 */
export function readingsOf({ test, readings }) {
  return new Map(Object.entries(readings).map(([name, value]) => [fullName(test, name), value]));
}
