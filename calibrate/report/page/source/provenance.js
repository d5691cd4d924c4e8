// Where everything comes from, and how to make this page again.
import { element, pairs, section } from "./dom.js";

/** @typedef {import("./content.js").Test} Test */

/**
 * The lines of a test's conditions as one.
 * @param {Test} test
 */
export function conditionsOf({ conditions }) {
  return conditions
    .trim()
    .replace(/\s*\n\s*/g, "; ")
    .replace(/ {2,}/g, " ");
}

/** @param {[name: string, value: string | undefined][]} entries of which those without a value are left out */
function known(entries) {
  return pairs(
    entries.filter(([, value]) => value),
    "pairs long",
  );
}

/** @param {Test} test */
function laboratoryOf(test) {
  return known([
    [test.name ? `Laboratory of ${test.name}` : "Laboratory", `${test.lab_file} (${test.lab_hash})`],
    ["Source", test.source],
    ["Licence", test.licence],
    ["Notes", test.notes],
    ["Twin", test.twin ? "made by a simulation with known parameters" : ""],
    ["Conditions", conditionsOf(test)],
  ]);
}

/** @param {import("./content.js").Content} content */
export function provenancePart({ provenance, program, command, tests = [], search, summary }) {
  const { strategy, seed, budget } = search;
  const asTerminal = element("summary", {}, "The summary as the terminal shows it");
  return section(
    "provenance",
    "Where this comes from",
    null,
    known([
      ["Study", provenance ? `${provenance.study_file} (${provenance.study_hash})` : ""],
      ["Card made by", provenance?.program],
      ["Simulations made by", search.program],
      ["Page made by", program],
      ["Search", strategy ? `${strategy}, seed ${seed}, at most ${budget} simulations` : ""],
    ]),
    ...tests.map(laboratoryOf),
    element("p", {}, "This page again:"),
    element("pre", { class: "command" }, command),
    summary ? element("details", {}, asTerminal, element("pre", {}, summary.trimEnd())) : null,
  );
}
