// What the calibration answers, on top of everything.
import { element, pairs } from "./dom.js";
import { fullName, unitOf, withUnit, words } from "./names.js";
import { duration, errorWords, number, plusMinus } from "./numbers.js";
import { endsInWords } from "./parameters.js";
import { isMeasured } from "./readings.js";

/** @typedef {import("./content.js").Content} Content */
/** @typedef {import("./content.js").Parameter} Parameter */
/** @typedef {import("./content.js").MeasuredReading} MeasuredReading */
/** @typedef {import("./content.js").Test} Test */

const answers = {
  meets: ["\u2713", "The material reproduces the measurement"],
  reserved: ["!", "The material reproduces the measurement, with reservations"],
  open: ["?", "Not certain"],
  rejected: ["!", "The readings are within their tolerances"],
  fails: ["\u2717", "The material does not reproduce the measurement"],
  none: ["\u2026", "No answer yet"],
  goes: ["\u2026", "The calibration is under way"],
};

/**
 * @param {Pick<Content, "verdict" | "under_way">} content
 * @returns {keyof answers}
 */
export function verdictKind({ verdict, under_way }) {
  if (!verdict) return under_way ? "goes" : "none";
  if (verdict.meets_laboratory) return verdict.reservations.length > 0 ? "reserved" : "meets";
  if (!verdict.fresh) return "open";
  if (verdict.only_heaps_refute) return "rejected";
  return verdict.misfit > 1 || verdict.refuted ? "fails" : "open";
}

/**
 * What the verdict rests on, in numbers.
 * @param {Content} content
 * @returns {[value: string, what: string][]}
 */
export function facts({ verdict, search, parameters = [], interval_level: level = 0 }) {
  /** @type {[string, string][]} */
  const list = [];
  const { misfit_asked: asked = NaN, error_unit: unit = "", history } = search;
  if (verdict) {
    const allowed = `largest difference from the laboratory; allowed: ${number(asked, 3)}`;
    list.push([`${number(verdict.misfit * asked, 3)} ${unit}`, allowed]);
    const packings = verdict.packings.length === 1 ? "random packing" : "random packings";
    const unseen = verdict.fresh
      ? `${packings} that the search had not seen`
      : `${packings}, which the search had seen`;
    list.push([String(verdict.packings.length), unseen]);
    const open = parameters.filter((one) => one.not_identified).length;
    const free = parameters.filter((one) => one.free).length;
    if (level > 0) list.push([`${free - open} of ${free}`, "fitted parameters bounded by the readings"]);
  } else if (asked) {
    const misfits = history.flatMap((one) => (one.misfit === undefined || one.ended_early ? [] : [one.misfit]));
    const allowed = `misfit of the best single run so far; allowed, as a mean over fresh packings: ${number(asked, 3)}`;
    if (misfits.length > 0) list.push([`${number(Math.min(...misfits), 3)} ${unit}`, allowed]);
  }
  if (history.length > 0)
    list.push([`${history.length}`, `simulations kept, ${duration(search.wall_s)} from start to end`]);
  return list;
}

/** @param {Parameter} parameter */
const withValue = ({ name, value }) => `${words(name)} ${withUnit(number(value), name)}`;

/**
 * @param {Parameter} parameter
 * @param {number} level
 */
function withInterval(parameter, level) {
  return `${withValue(parameter)} (${number(100 * level, 3)} %: ${endsInWords(parameter)})`;
}

/**
 * @param {Test} test
 * @param {MeasuredReading} one
 */
function readingWords(test, one) {
  const simulated = `${plusMinus(one.simulated, one.standard_error)} ${unitOf(one.name)}${errorWords(one)}`;
  const measured = plusMinus(one.measured, one.standard_deviation);
  return `${words(fullName(test.name, one.name))} ${simulated}, measured ${measured}`;
}

/** @param {Parameter[]} open */
function openWords(open) {
  const each = open.length > 1 ? "each one choice" : "one choice";
  return `${open.map(withValue).join(", ")}: ${each} among many that the readings allow`;
}

/**
 * The answer in words: what was fitted, how well each reading is met, what is open.
 * @param {Content} content
 * @returns {[what: string, lines: string[]][]}
 */
export function answerLines({ verdict, parameters = [], tests = [], interval_level: level = 0 }) {
  if (!verdict) return [];
  const free = parameters.filter((one) => one.free);
  const open = free.filter((one) => !one.interval);
  const bounded = free.filter((one) => one.interval).map((one) => withInterval(one, level));
  const readings = tests.flatMap((test) => test.readings.filter(isMeasured).map((one) => ({ test, one })));
  const fitted = readings.filter(({ test, one }) => !test.hold_out && one.weight > 0);
  const missed = fitted.filter(({ one }) => Math.abs(one.simulated - one.measured) > one.tolerance);
  /** @param {typeof readings} some */
  const told = (some) => some.map(({ test, one }) => readingWords(test, one));
  /** @type {[string, string[]][]} */
  const lines = [
    ["Reservations", verdict.reservations],
    ["Fitted", level > 0 ? bounded : free.map(withValue)],
    ["Met", told(fitted.filter((one) => !missed.includes(one)))],
    ["Missed", told(missed)],
    ["Predicted", told(readings.filter((one) => !fitted.includes(one)))],
    ["Open", level > 0 && open.length > 0 ? [openWords(open)] : []],
  ];
  return lines.filter(([, some]) => some.length > 0);
}

/**
 * Kind, sign, heading and sentence of the answer.
 * @param {Content} content
 */
export function answerOf(content) {
  const kind = verdictKind(content);
  const [sign, usual] = answers[kind];
  const heading = kind === "rejected" ? `${usual}, but ${content.verdict?.unconfirmed}` : usual;
  const waiting =
    kind === "goes" ? "This page looks again every ten seconds." : "Below is what the folder holds so far.";
  const said = content.verdict?.words ?? waiting;
  // The verdict's own sentence, without what the heading says already.
  const sentence = said.startsWith(`${heading}: `) ? said.slice(heading.length + 2) : said;
  return { kind, sign, heading, sentence };
}

/** @param {Content} content */
export function verdictPart(content) {
  const { kind, sign, heading, sentence } = answerOf(content);
  const lines = answerLines(content).map(
    ([what, some]) => /** @type {[string, Element[]]} */ ([what, some.map((line) => element("div", {}, line))]),
  );
  return element(
    "header",
    { id: "verdict", class: kind },
    element("p", { class: "brand" }, "pastefit"),
    element("h1", {}, content.title ?? "A calibration without a card"),
    element(
      "div",
      { class: "answer" },
      element("span", { class: "badge", "aria-hidden": "true" }, sign),
      element(
        "div",
        {},
        element("strong", {}, heading),
        element("p", {}, sentence),
        lines.length > 0 ? pairs(lines, "answers") : null,
      ),
    ),
    element(
      "dl",
      { class: "facts" },
      ...facts(content).map(([value, what]) => element("div", {}, element("dt", {}, value), element("dd", {}, what))),
    ),
  );
}

/**
 * What is missing, if something is.
 * @param {Content} content
 */
export function missingPart({ missing }) {
  if (missing.length === 0) return null;
  const lacks = missing.map((sentence) => element("li", {}, sentence));
  return element(
    "aside",
    { id: "missing", "aria-label": "What is missing" },
    element("h2", {}, "What this page lacks"),
    element("ul", {}, ...lacks),
  );
}
