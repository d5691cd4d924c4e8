// The first sheet of the page on paper: the material and how it meets the laboratory, to be signed and handed over.
import { element, pairs, table } from "./dom.js";
import { drawingSheet } from "./drawing.js";
import { fullName, wordsAndUnit } from "./names.js";
import { errorWords, number, plusMinus } from "./numbers.js";
import { conditionsOf } from "./provenance.js";
import { isMeasured, judged } from "./readings.js";
import { packingStrip } from "./strip.js";
import { drawingsOf } from "./tests.js";
import { typeInTable } from "./type_in.js";
import { answerLines, answerOf } from "./verdict.js";

/** @typedef {import("./content.js").CardContent} CardContent */
/** @typedef {import("./content.js").MeasuredReading} MeasuredReading */
/** @typedef {import("./content.js").Test} Test */

const mostDrawings = 2;
const drawnWidth = 520;

/** @param {Test[]} tests */
function drawings(tests) {
  const found = tests.flatMap((test) =>
    drawingsOf(test).map((drawing) => ({
      drawing,
      heading: test.name ? `${test.name}: ${drawing.name}` : drawing.name,
    })),
  );
  const sheets = found.slice(0, mostDrawings).map(({ drawing, heading }) => drawingSheet(drawing, drawnWidth, heading));
  return element("div", { class: found.length > 1 ? "sheet-drawings several" : "sheet-drawings" }, ...sheets);
}

/**
 * @param {Test} test
 * @param {MeasuredReading} one
 */
function readingRow(test, one) {
  const [kind, said] = judged(one, test);
  const numbers = [
    plusMinus(one.measured, one.standard_deviation),
    plusMinus(one.simulated, one.standard_error) + errorWords(one),
    number(one.tolerance, 3),
  ];
  return element(
    "tr",
    { class: kind },
    element("th", { scope: "row" }, wordsAndUnit(fullName(test.name, one.name))),
    ...numbers.map((text) => element("td", { class: "number" }, text)),
    element("td", {}, packingStrip(one)),
    element("td", {}, said),
  );
}

/** @param {Test[]} tests */
function readings(tests) {
  const heads = ["Reading", "Measured", "Simulated", "Allowed", "Each packing", ""];
  const head = element("tr", {}, ...heads.map((text) => element("th", {}, text)));
  const rows = tests.flatMap((test) => test.readings.filter(isMeasured).map((one) => readingRow(test, one)));
  return table(head, rows, { class: "readings" });
}

/** @param {CardContent} content */
function origin({ provenance, program, tests, verdict, search }) {
  const laboratories = tests.flatMap((test) => {
    const file = `${test.lab_file} (${test.lab_hash})${test.source ? `, ${test.source}` : ""}`;
    /** @type {[string, string][]} */
    const rows = [
      [test.name ? `Laboratory, ${test.name}` : "Laboratory", file],
      ["Conditions", conditionsOf(test)],
    ];
    return rows;
  });
  const study = `${provenance.study_file} (${provenance.study_hash})`;
  const packings = verdict.fresh ? "fresh packings" : "packings that the search had seen";
  const versions = provenance.program === program ? program : `card ${provenance.program}, page ${program}`;
  return pairs([
    ...laboratories,
    ["Study", `${study}, ${search.strategy} search, seed ${search.seed}`],
    [verdict.unconfirmed ? "Simulated on" : "Confirmed on", `${packings}: ${verdict.packings.join(", ")}`],
    ["Versions", versions],
  ]);
}

/**
 * The date as ISO 8601 writes it, of this place.
 * @param {Date} date
 */
export function dateWords(date) {
  const two = (/** @type {number} */ value) => String(value).padStart(2, "0");
  return `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
}

/** @param {CardContent} content */
function answer(content) {
  const { sign, heading, sentence } = answerOf(content);
  const open = answerLines(content).flatMap(([what, lines]) => (what === "Open" ? lines : []));
  const items = [...content.verdict.reservations, ...open.map((line) => `Open: ${line}`)];
  const notes = items.map((one) => element("li", {}, one));
  return element(
    "div",
    { class: "answer" },
    element("span", { class: "badge", "aria-hidden": "true" }, sign),
    element("div", {}, element("strong", {}, heading), element("p", {}, sentence), element("ul", {}, ...notes)),
  );
}

/** @param {CardContent} content */
function halves({ tests, type_in: groups, radius_mm: radius }) {
  const note =
    "Each packing: dots, their mean (line), and the laboratory's mean with what is allowed (shaded). " +
    "\u00b1: the laboratory's standard deviation, the standard error of the simulated mean.";
  return element(
    "div",
    { class: "halves" },
    element("div", {}, drawings(tests), readings(tests), element("p", { class: "note" }, note)),
    element(
      "div",
      {},
      element("h2", {}, "Numbers to type in"),
      element("p", { class: "note" }, `For grains of ${radius} mm radius.`),
      typeInTable(groups),
    ),
  );
}

/** @param {CardContent} content */
export function certificatePart(content) {
  const date = element("span", {}, dateWords(new Date()));
  addEventListener("beforeprint", () => date.replaceChildren(dateWords(new Date())));
  const confirmed = !content.verdict.unconfirmed;
  const what = confirmed ? "certificate of a calibrated material" : "a material that is not confirmed";
  const brand = `pastefit \u00b7 ${what}`;
  const lines = ["Name", "Date", "Signature"].map((line) => element("div", {}, line));
  return element(
    "section",
    { id: "certificate", class: answerOf(content).kind, "aria-label": "First sheet, for paper" },
    element("p", { class: "brand" }, brand, element("span", { class: "printed" }, "printed ", date)),
    element("p", { class: "title" }, content.title),
    confirmed ? null : element("p", { class: "unconfirmed" }, `NOT CONFIRMED: ${content.verdict.unconfirmed}`),
    answer(content),
    halves(content),
    origin(content),
    confirmed ? element("div", { class: "signatures" }, ...lines) : null,
  );
}
