// Where everything comes from, and how to make this page again.
import { element, section } from "./dom.js";

const pairs = (entries) =>
  element(
    "dl",
    { class: "pairs long" },
    ...entries
      .filter(([, value]) => value)
      .flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
  );

export function provenancePart({ provenance, program, command, tests = [], search, summary }) {
  const laboratories = tests.map((test) =>
    pairs([
      [test.name ? `Laboratory of ${test.name}` : "Laboratory", `${test.lab_file} (${test.lab_hash})`],
      ["Source", test.source],
      ["Licence", test.licence],
      ["Notes", test.notes],
      ["Twin", test.twin ? "made by a simulation with known parameters" : ""],
      [
        "Conditions",
        test.conditions
          ?.trim()
          .replace(/\s*\n\s*/g, "; ")
          .replace(/ {2,}/g, " "),
      ],
    ]),
  );
  return section(
    "provenance",
    "Where this comes from",
    null,
    pairs([
      ["Study", provenance ? `${provenance.study_file} (${provenance.study_hash})` : ""],
      ["Card made by", provenance?.program],
      ["Simulations made by", search.program],
      ["Page made by", program],
      [
        "Search",
        search.strategy ? `${search.strategy}, seed ${search.seed}, at most ${search.budget} simulations` : "",
      ],
    ]),
    ...laboratories,
    element("p", {}, "This page again:"),
    element("pre", { class: "command" }, command),
    summary
      ? element(
          "details",
          {},
          element("summary", {}, "The summary as the terminal shows it"),
          element("pre", {}, summary.trimEnd()),
        )
      : null,
  );
}
