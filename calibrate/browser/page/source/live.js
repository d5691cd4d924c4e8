// What is seen of a calibration while it runs.
import { element, pairs, table } from "../../../report/page/source/dom.js";
import { unitOf, words } from "../../../report/page/source/names.js";
import { duration, number } from "../../../report/page/source/numbers.js";
import { sketchScale, size } from "../../../report/page/source/sketch.js";
import { svgElement, svgPicture } from "../../../report/page/source/svg.js";
import { english } from "./fields.js";
import { fill, wordOf } from "./language.js";
import { readingOf } from "./sheet.js";

/** @typedef {import("./language.js").Texts} Texts */
/** @typedef {import("./search.js").Outline} Outline */
/** @typedef {import("./search.js").Progress} Progress */

/**
 * @typedef {object} Live
 * @property {string} title
 * @property {string[]} notes on the sheet
 * @property {Progress | null} progress
 * @property {Outline | null} outline of the latest heap
 * @property {number} seconds so far, earlier sessions included
 * @property {number | null} remaining seconds at most
 * @property {number} deaths of workers
 * @property {boolean} stopping
 */

/**
 * Seconds until the budget is used up, by the simulations of this session.
 * @param {number} simulations of this session
 * @param {number} seconds of this session
 * @param {Progress} progress
 */
export function remainingSeconds(simulations, seconds, { simulations: done, budget }) {
  return simulations > 0 ? (Math.max(0, budget - done) * seconds) / simulations : null;
}

/**
 * The name of a reading as the form has it; of others as the report has it.
 * @param {string} name
 * @param {Texts} texts
 */
function nameOf(name, texts) {
  const field = readingOf(name)?.name;
  const label = field ? texts[/** @type {"slump"} */ (field)] : words(name);
  const unit = unitOf(name);
  return unit && !label.includes("[") ? `${label} [${unit}]` : label;
}

/**
 * @param {Progress} progress
 * @param {Texts} texts
 */
function readingsTable({ readings }, texts) {
  const heads = [texts.reading, texts.measured, texts.simulated, texts.tolerance, texts.within];
  const head = element(
    "tr",
    {},
    ...heads.map((one, k) => element("th", { scope: "col", class: k > 0 ? "number" : null }, one)),
  );
  const rows = readings.map(({ name, measured, simulated, tolerance }) => {
    const isKnown = typeof simulated === "number";
    const isMet = isKnown && Math.abs(simulated - measured) <= tolerance;
    const within = isMet ? texts.yes : texts.no;
    const cells = [number(measured), number(simulated), `\u00b1 ${number(tolerance, 3)}`, isKnown ? within : ""];
    return element(
      "tr",
      { class: isMet ? "met" : null },
      element("th", { scope: "row" }, nameOf(name, texts)),
      ...cells.map((cell, k) => element("td", { class: "number", "data-head": heads[k + 1] }, cell)),
    );
  });
  return table(head, rows, { class: "readings" });
}

/**
 * @param {Outline | null} outline
 * @param {Texts} texts
 */
function heapFigure(outline, texts) {
  if (!outline) return null;
  const at = sketchScale(outline, true);
  const foot = at([0, 0])[1];
  const points = outline.map(at);
  const closed = [...points, [points[points.length - 1][0], foot], [points[0][0], foot]];
  const heap = svgElement("polygon", { points: closed.map((one) => one.join(",")).join(" "), class: "heap" });
  const line = svgElement("polyline", { points: points.map((one) => one.join(",")).join(" "), class: "own" });
  const picture = svgPicture(size, "candidate-picture sketch", texts.heapNow, [heap, line]);
  return element("figure", { class: "latest" }, picture, element("figcaption", { class: "note" }, texts.heapNow));
}

/**
 * @param {Live} live
 * @param {Texts} texts
 */
function facts({ progress, seconds, remaining }, texts) {
  const error = progress && progress.best_error !== null ? number(progress.best_error, 2) : null;
  const [sheared, heaps] = progress?.sheared ?? [0, 0];
  /** @type {[string, string | HTMLElement][]} */
  const entries = [
    [texts.phase, progress?.phase ? wordOf(texts.phases, progress.phase) : texts.starting],
    [
      texts.simulations,
      progress ? fill(texts.simulationsOf, { done: progress.simulations, budget: progress.budget }) : texts.none,
    ],
    [texts.bestError, error ? fill(texts.bestErrorOf, { error }) : texts.none],
    [texts.elapsed, duration(Math.round(seconds))],
    [
      texts.remaining,
      remaining === null ? texts.unknown : fill(texts.remainingAtMost, { time: duration(Math.round(remaining)) }),
    ],
  ];
  if (progress?.why) entries.push([texts.why, element("span", english, progress.why)]);
  if (sheared > 0) entries.push([texts.sheared, fill(texts.shearedOf, { k: sheared, n: heaps })]);
  return pairs(entries);
}

/**
 * @param {Live} live
 * @param {Texts} texts
 */
function moving(live, texts) {
  const { progress, deaths } = live;
  const replaced = deaths === 1 ? texts.replacedOne : fill(texts.replaced, { count: deaths });
  const [value, max] = [progress?.simulations ?? 0, progress?.budget || 1];
  const bar = element("progress", { value, max, "aria-label": texts.simulations });
  return [
    bar,
    facts(live, texts),
    progress && progress.readings.length > 0 ? readingsTable(progress, texts) : null,
    heapFigure(live.outline, texts),
    deaths > 0 ? element("p", { class: "note" }, replaced) : null,
  ].filter((one) => one !== null);
}

/**
 * @param {Live} live
 * @param {{stop: () => void, resize: (text: string) => void, workers: string}} actions
 * @param {Texts} texts
 */
export function liveView(live, actions, texts) {
  const place = element("div", {}, ...moving(live, texts));
  const phase = element("p", { class: "unseen", role: "status" });
  const stop = element("button", { class: "main", type: "button", onclick: actions.stop }, texts.stop);
  const workers = element("input", { id: "workers", type: "number", min: 1, max: 256, value: actions.workers });
  workers.addEventListener("change", () => actions.resize(workers.value));
  const view = element(
    "section",
    { id: "run", "aria-labelledby": "run-heading" },
    element("h1", { id: "run-heading", tabindex: "-1", dir: "auto" }, `${texts.runHeading}: ${live.title}`),
    place,
    phase,
    element("div", { class: "row" }, stop, element("label", { class: "choice" }, texts.workers, workers)),
    element("p", { class: "note" }, texts.stopHint),
    notesPart(live.notes, texts),
  );
  /** @param {Live} now */
  const update = (now) => {
    place.replaceChildren(...moving(now, texts));
    const said = now.progress?.phase ? wordOf(texts.phases, now.progress.phase) : "";
    if (phase.textContent !== said) phase.textContent = said;
    stop.disabled = now.stopping;
    stop.textContent = now.stopping ? texts.stopping : texts.stop;
  };
  return Object.assign(view, { update });
}

/**
 * @param {string[]} notes
 * @param {Texts} texts
 */
function notesPart(notes, texts) {
  if (notes.length === 0) return null;
  const list = element("ul", english, ...notes.map((note) => element("li", {}, note)));
  return element("details", { open: true }, element("summary", {}, texts.notes), list);
}
