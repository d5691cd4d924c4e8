// Measured against simulated, each with its noise.
import { element, pairs, section, table } from "./dom.js";
import { fullName, wordsAndUnit } from "./names.js";
import { errorWords, number, plusMinus, plusMinusSigned } from "./numbers.js";
import { sensitivityTable } from "./sensitivity.js";
import { packingStrip } from "./strip.js";
import { yieldStressTable } from "./yield_stress.js";

/** @typedef {import("./content.js").CardContent} CardContent */
/** @typedef {import("./content.js").Inference} Inference */
/** @typedef {import("./content.js").MeasuredReading} MeasuredReading */
/** @typedef {import("./content.js").Reading} Reading */
/** @typedef {import("./content.js").Test} Test */

/** @type {(reading: Reading) => reading is MeasuredReading} */
export const isMeasured = (reading) => reading.measured !== undefined;

/**
 * Its class and words: within what is allowed, or so near to the edge that its error decides.
 * @param {MeasuredReading} reading
 * @param {Pick<Test, "hold_out">} test
 */
export function judged(reading, test) {
  const off = Math.abs(reading.simulated - reading.measured);
  if (test.hold_out) return ["unfitted", "predicted"];
  if (reading.weight <= 0) return ["unfitted", "not fitted"];
  if (off > reading.tolerance) return ["missed", "\u2717 beyond"];
  return off + (reading.standard_error ?? 0) > reading.tolerance
    ? ["marginal", "! marginal"]
    : ["met", "\u2713 within"];
}

const heads = [
  "Measured \u00b1 deviation",
  "Simulated \u00b1 standard error",
  "From packing to packing",
  "Difference",
  "Allowed",
];

/**
 * @param {MeasuredReading} reading
 * @param {number | undefined} noise standard deviation of one packing, as the inference knows it
 * @param {Test} test
 */
function row(reading, noise, test) {
  const [kind, verdict] = judged(reading, test);
  const error = reading.standard_error;
  const deviation = noise ?? (error === undefined ? undefined : reading.simulated_standard_deviation);
  const cells = [
    [plusMinus(reading.measured, reading.standard_deviation)],
    [plusMinus(reading.simulated, error) + errorWords(reading)],
    [element("span", {}, number(deviation, 2)), packingStrip(reading)],
    [plusMinusSigned(reading.simulated - reading.measured, error)],
    [number(reading.tolerance, 3)],
  ].map((cell, k) => element("td", { class: "number", "data-head": heads[k] }, ...cell));
  cells[0].title = `${reading.repeats} reading(s)`;
  const name = element("th", { scope: "row" }, wordsAndUnit(reading.name));
  return element("tr", { class: kind }, name, ...cells, element("td", {}, verdict));
}

/**
 * @param {Test} test
 * @param {Inference | undefined} inference
 */
function measuredTable(test, inference) {
  const measured = test.readings.filter(isMeasured);
  if (measured.length === 0)
    return element("p", { class: "notice" }, "This test was not simulated, or nothing of it was measured.");
  const numbers = heads.map((head) => element("th", { class: "number" }, head));
  const head = element("tr", {}, element("th", {}, "Reading"), ...numbers, element("th"));
  const rows = measured.map((one) => row(one, inference?.noise?.[fullName(test.name, one.name)], test));
  return element("div", { class: "wide" }, table(head, rows, { class: "readings" }));
}

/** @param {Reading[]} readings */
function untaken(readings) {
  if (readings.length === 0) return null;
  /** @type {[string, string][]} */
  const entries = readings.map((one) => [
    wordsAndUnit(one.name),
    plusMinus(one.simulated, one.standard_error) + errorWords(one),
  ]);
  const summary = element("summary", {}, `${readings.length} readings that the laboratory did not take`);
  return element("details", {}, summary, pairs(entries));
}

/**
 * @param {Test} test
 * @param {Inference | undefined} inference
 */
function testReadings(test, inference) {
  const heading = `Test ${test.name}${test.hold_out ? ", held out: predicted, not fitted" : ""}`;
  return [
    test.name ? element("h3", {}, heading) : null,
    measuredTable(test, inference),
    test.remarks ? element("p", { class: "notice" }, test.remarks) : null,
    yieldStressTable(test),
    untaken(test.readings.filter((one) => !isMeasured(one))),
  ];
}

/** @param {CardContent} content */
export function readingsPart({ tests, inference, verdict }) {
  const lead =
    verdict.packings.length > 1
      ? `Simulated values are means over ${verdict.packings.length} random packings, \u00b1 their standard error. ` +
        "A difference below it says nothing. Beside the scatter each packing is a dot, and shaded what is allowed."
      : "Simulated values are those of one packing: their error is unknown.";
  const all = tests.flatMap((test) => testReadings(test, inference));
  return section("readings", "Measured and simulated", lead, ...all, sensitivityTable(inference));
}
