// Measured against simulated, each with its noise.
import { element, section } from "./dom.js";
import { packingStrip } from "./strip.js";
import { errorWords, number, plusMinus, plusMinusSigned, unitOf, words } from "./numbers.js";

/// Its class and words: within what is allowed, or so near to the edge that its error decides.
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
  "Reading",
  "Measured \u00b1 deviation",
  "Simulated \u00b1 standard error",
  "From packing to packing",
  "Difference",
  "Allowed",
  "",
];

/// The standard deviation of one packing, with the packings themselves.
function scatter(reading, noise) {
  const deviation = noise ?? (reading.standard_error === undefined ? undefined : reading.simulated_standard_deviation);
  return [element("span", {}, number(deviation, 2)), packingStrip(reading)];
}

function row(reading, noise, test) {
  const unit = unitOf(reading.name);
  const off = reading.simulated - reading.measured;
  const [kind, verdict] = judged(reading, test);
  return element(
    "tr",
    { class: kind },
    element("th", { scope: "row" }, words(reading.name), unit ? ` [${unit}]` : ""),
    ...[
      plusMinus(reading.measured, reading.standard_deviation),
      plusMinus(reading.simulated, reading.standard_error) + errorWords(reading),
      scatter(reading, noise),
      plusMinusSigned(off, reading.standard_error),
      number(reading.tolerance, 3),
    ].map((text, k) =>
      element(
        "td",
        { class: "number", "data-head": heads[k + 1], title: k === 0 ? `${reading.repeats} reading(s)` : null },
        text,
      ),
    ),
    element("td", {}, verdict),
  );
}

function table(test, inference) {
  const measured = test.readings.filter((one) => one.measured !== undefined);
  const others = test.readings.filter((one) => one.measured === undefined);
  const name = (reading) => (test.name ? `${test.name}/${reading.name}` : reading.name);
  return [
    test.name
      ? element("h3", {}, `Test ${test.name}${test.hold_out ? ", held out: predicted, not fitted" : ""}`)
      : null,
    measured.length === 0
      ? element("p", { class: "notice" }, "This test was not simulated, or nothing of it was measured.")
      : element(
          "div",
          { class: "wide" },
          element(
            "table",
            { class: "readings" },
            element(
              "thead",
              {},
              element(
                "tr",
                {},
                ...heads.map((head, k) => element("th", { class: k > 0 && k < 6 ? "number" : null }, head)),
              ),
            ),
            element("tbody", {}, ...measured.map((one) => row(one, inference?.noise?.[name(one)], test))),
          ),
        ),
    test.remarks ? element("p", { class: "notice" }, test.remarks) : null,
    others.length === 0
      ? null
      : element(
          "details",
          {},
          element("summary", {}, `${others.length} readings that the laboratory did not take`),
          element(
            "dl",
            { class: "pairs" },
            ...others.flatMap((one) => [
              element("dt", {}, words(one.name), unitOf(one.name) ? ` [${unitOf(one.name)}]` : ""),
              element("dd", {}, plusMinus(one.simulated, one.standard_error), errorWords(one)),
            ]),
          ),
        ),
  ];
}

export function readingsPart({ tests, inference, verdict }) {
  return section(
    "readings",
    "Measured and simulated",
    verdict.packings.length > 1
      ? `Simulated values are means over ${verdict.packings.length} random packings, \u00b1 their standard error. A difference below it says nothing. Beside the scatter each packing is a dot, and shaded what is allowed.`
      : "Simulated values are those of one packing: their error is unknown.",
    ...tests.flatMap((test) => table(test, inference)),
  );
}
