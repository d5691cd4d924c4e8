// The first sheet of the page on paper: the material and how it meets the laboratory, to be signed and handed over.
import { element } from "./dom.js";
import { drawingSheet } from "./drawing.js";
import { errorWords, fullName, number, plusMinus, unitOf, words } from "./numbers.js";
import { judged } from "./readings.js";
import { packingStrip } from "./strip.js";
import { withNoise } from "./tests.js";
import { groupRows } from "./type_in.js";
import { answerOf } from "./verdict.js";

const mostDrawings = 2,
  drawnWidth = 520;

function drawings(tests) {
  const found = tests.flatMap((test) => test.drawings.map((drawing) => ({ test, drawing })));
  return element(
    "div",
    { class: found.length > 1 ? "sheet-drawings several" : "sheet-drawings" },
    ...found
      .slice(0, mostDrawings)
      .map(({ test, drawing }) =>
        drawingSheet(
          withNoise(drawing, test.readings),
          drawnWidth,
          test.name ? `${test.name}: ${drawing.name}` : drawing.name,
        ),
      ),
  );
}

function readingRow(test, one) {
  const [kind, said] = judged(one, test),
    unit = unitOf(one.name);
  return element(
    "tr",
    { class: kind },
    element("th", { scope: "row" }, words(fullName(test.name, one.name)), unit ? ` [${unit}]` : ""),
    element("td", { class: "number" }, plusMinus(one.measured, one.standard_deviation)),
    element("td", { class: "number" }, plusMinus(one.simulated, one.standard_error), errorWords(one)),
    element("td", { class: "number" }, number(one.tolerance, 3)),
    element("td", {}, packingStrip(one)),
    element("td", {}, said),
  );
}

function readings(tests) {
  const rows = tests.flatMap((test) =>
    test.readings.filter((one) => one.measured !== undefined).map((one) => readingRow(test, one)),
  );
  return element(
    "table",
    { class: "readings" },
    element(
      "thead",
      {},
      element(
        "tr",
        {},
        ...["Reading", "Measured", "Simulated", "Allowed", "Each packing", ""].map((head) => element("th", {}, head)),
      ),
    ),
    element("tbody", {}, ...rows),
  );
}

function origin({ provenance, program, tests, verdict, search }) {
  const laboratories = tests.flatMap((test) => [
    [
      test.name ? `Laboratory, ${test.name}` : "Laboratory",
      `${test.lab_file} (${test.lab_hash})${test.source ? `, ${test.source}` : ""}`,
    ],
    [
      "Conditions",
      test.conditions
        .trim()
        .replace(/\s*\n\s*/g, "; ")
        .replace(/ {2,}/g, " "),
    ],
  ]);
  const rows = [
    ...laboratories,
    ["Study", `${provenance.study_file} (${provenance.study_hash}), ${search.strategy} search, seed ${search.seed}`],
    [
      "Confirmed on",
      `${verdict.fresh ? "fresh packings" : "packings that the search had seen"}: ${verdict.packings.join(", ")}`,
    ],
    ["Versions", provenance.program === program ? program : `card ${provenance.program}, page ${program}`],
  ];
  return element(
    "dl",
    { class: "pairs" },
    ...rows.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
  );
}

/// Dates as ISO 8601 writes them, of this place.
function today() {
  const now = new Date(),
    two = (value) => String(value).padStart(2, "0");
  return `${now.getFullYear()}-${two(now.getMonth() + 1)}-${two(now.getDate())}`;
}

export function certificatePart(content) {
  const { title, tests, type_in: groups, radius_mm: radius } = content;
  const [kind, sign, heading, sentence] = answerOf(content);
  const date = element("span", {}, today());
  addEventListener("beforeprint", () => date.replaceChildren(today()));
  return element(
    "section",
    { id: "certificate", class: kind, "aria-label": "Certificate, for paper" },
    element(
      "p",
      { class: "brand" },
      "pastefit \u00b7 certificate of a calibrated material",
      element("span", { class: "printed" }, "printed ", date),
    ),
    element("p", { class: "title" }, title),
    element(
      "div",
      { class: "answer" },
      element("span", { class: "badge", "aria-hidden": "true" }, sign),
      element(
        "div",
        {},
        element("strong", {}, heading),
        element("p", {}, sentence),
        element("ul", {}, ...(content.verdict.reservations ?? []).map((one) => element("li", {}, one))),
      ),
    ),
    element(
      "div",
      { class: "halves" },
      element(
        "div",
        {},
        drawings(tests),
        readings(tests),
        element(
          "p",
          { class: "note" },
          `Each packing: dots, their mean (line), and the laboratory's mean with what is allowed (shaded). \u00b1: the laboratory's standard deviation, the standard error of the simulated mean.`,
        ),
      ),
      element(
        "div",
        {},
        element("h2", {}, "Numbers to type in"),
        element("p", { class: "note" }, `For grains of ${radius} mm radius.`),
        element("table", { class: "type-in" }, ...groups.map((group) => element("tbody", {}, ...groupRows(group)))),
      ),
    ),
    origin(content),
    element("div", { class: "signatures" }, ...["Name", "Date", "Signature"].map((what) => element("div", {}, what))),
  );
}
