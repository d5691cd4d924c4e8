// What the readings leave open: the misfit over two parameters, and the materials that meet them as well.
import { element, figure, section, table } from "./dom.js";
import { levelLegend, mapPlot } from "./misfit_map.js";
import { fullName, words, wordsAndUnit } from "./names.js";
import { atNoise, number, plusMinus } from "./numbers.js";
import { legend } from "./plots.js";
import { isMeasured } from "./readings.js";

/** @typedef {import("./content.js").EquivalentMaterial} EquivalentMaterial */
/** @typedef {import("./content.js").MisfitMap} MisfitMap */
/** @typedef {import("./content.js").Test} Test */

/**
 * What the laboratory measured of a reading, with its deviation.
 * @param {Test[]} tests
 * @param {string} name
 */
function measuredOf(tests, name) {
  for (const test of tests)
    for (const one of test.readings.filter(isMeasured))
      if (fullName(test.name, one.name) === name) return plusMinus(one.measured, one.standard_deviation);
  return "";
}

/** @param {string[]} texts */
const numberCells = (texts) => texts.map((text) => element("td", { class: "number" }, text));

/** @param {string[]} texts */
const numberHeads = (texts) => texts.map((text) => element("th", { class: "number" }, text));

/**
 * @param {EquivalentMaterial[]} family
 * @param {Record<string, number>} noise
 * @param {Test[]} tests
 */
function familyTable(family, noise, tests) {
  if (family.length === 0) return null;
  const names = Object.keys(family[0].values);
  const readings = Object.keys(family[0].readings);
  const heads = numberHeads([...names, ...readings].map(wordsAndUnit));
  const laboratory = element("th", { colspan: names.length, scope: "row" }, "Laboratory");
  const measured = numberCells(readings.map((name) => measuredOf(tests, name)));
  const rows = family.map(({ values, readings: told, simulated }) => {
    const cells = [
      ...names.map((name) => number(values[name], 3)),
      ...readings.map((name) => atNoise(told[name], noise[name])),
    ];
    return element("tr", {}, ...numberCells(cells), element("td", {}, simulated ? "simulated" : "predicted"));
  });
  const caption =
    "Materials that may well meet the laboratory too; the first is the recommended one. " +
    "\u201cPredicted\u201d ones are told from simulations nearby, and were not simulated themselves.";
  const all = table(
    element("tr", {}, ...heads, element("th", {}, "Known from")),
    [element("tr", { class: "measured" }, laboratory, ...measured, element("td")), ...rows],
    {},
    caption,
  );
  return element("div", { class: "wide" }, all);
}

/** @param {MisfitMap} map */
function mapFigure(map) {
  const axes = `${words(map.x.name)} and ${words(map.y.name)}`;
  const heading = `Predicted misfit over ${axes}, the other parameters as recommended`;
  const signs = legend([
    ...levelLegend(),
    ["recommended", "mark star"],
    ["equivalent materials; their other parameters differ too", "mark diamond"],
    ["simulated", "mark dot"],
  ]);
  const caption = element("figcaption", {}, element("strong", {}, heading), signs);
  return figure({}, (width) => mapPlot(map, width), caption);
}

/** @param {import("./content.js").Content} content */
export function openPart({ inference, search, tests = [] }) {
  if (!inference) return null;
  return section(
    "open",
    "What is determined, and what is not",
    `From ${inference.simulations} simulations of this study.`,
    element("pre", { class: "words" }, inference.words.trimEnd()),
    search.map ? mapFigure(search.map) : null,
    familyTable(inference.family ?? [], inference.noise ?? {}, tests),
  );
}
