// Measured against simulated, each with its noise.
import { element, section } from "./dom.js";
import { number, plusMinus, signed, unitOf, words } from "./numbers.js";

function judged(reading) {
  const off = Math.abs(reading.simulated - reading.measured);
  if (reading.weight <= 0) return ["unfitted", "not fitted"];
  return off <= reading.tolerance ? ["met", "\u2713 within"] : ["missed", "\u2717 beyond"];
}

const heads = ["Reading", "Measured \u00b1 deviation", "Simulated \u00b1 standard error", "From packing to packing", "Difference", "Allowed", ""];

function row(reading, noise) {
  const unit = unitOf(reading.name);
  const off = reading.simulated - reading.measured;
  const [kind, verdict] = judged(reading);
  return element("tr", { class: kind }, element("th", { scope: "row" }, words(reading.name), unit ? ` [${unit}]` : ""),
    ...[plusMinus(reading.measured, reading.standard_deviation), plusMinus(reading.simulated, reading.standard_error),
      number(noise ?? reading.simulated_standard_deviation, 2), signed(off, reading.standard_error), number(reading.tolerance, 3)].map((text, k) =>
      element("td", { class: "number", "data-head": heads[k + 1], title: k === 0 ? `${reading.repeats} reading(s)` : null }, text)),
    element("td", {}, verdict));
}

function table(test, inference) {
  const measured = test.readings.filter((one) => one.measured !== undefined);
  const others = test.readings.filter((one) => one.measured === undefined);
  const name = (reading) => (test.name ? `${test.name}/${reading.name}` : reading.name);
  return [
    test.name ? element("h3", {}, `Test ${test.name}${test.hold_out ? ", held out: predicted, not fitted" : ""}`) : null,
    measured.length === 0 ? element("p", { class: "notice" }, "This test was not simulated, or nothing of it was measured.") :
      element("div", { class: "wide" }, element("table", { class: "readings" }, element("thead", {}, element("tr", {}, ...heads.map((head, k) => element("th", { class: k > 0 && k < 6 ? "number" : null }, head)))),
        element("tbody", {}, ...measured.map((one) => row(one, inference?.noise?.[name(one)]))))),
    test.remarks ? element("p", { class: "notice" }, test.remarks) : null,
    others.length === 0 ? null : element("details", {}, element("summary", {}, `${others.length} readings that the laboratory did not take`),
      element("dl", { class: "pairs" }, ...others.flatMap((one) => [element("dt", {}, words(one.name), unitOf(one.name) ? ` [${unitOf(one.name)}]` : ""),
        element("dd", {}, plusMinus(one.simulated, one.standard_error))]))),
  ];
}

export function readingsPart({ tests, inference, verdict }) {
  return section("readings", "Measured and simulated",
    `Simulated values are means over ${verdict.packings.length} random packings; their standard error is the luck of the packing. A difference below it says nothing.`,
    ...tests.flatMap((test) => table(test, inference)));
}
