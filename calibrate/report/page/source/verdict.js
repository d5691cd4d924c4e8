// What the calibration answers, on top of everything.
import { element } from "./dom.js";
import { duration, number } from "./numbers.js";

const signs = { meets: ["\u2713", "The material meets the laboratory"], open: ["?", "Not certain"], fails: ["\u2717", "The material does not meet the laboratory"], none: ["\u2026", "No answer yet"], goes: ["\u2026", "The calibration is under way"] };

/// "meets", "open", "fails", "goes" or "none".
export function verdictKind({ verdict, under_way }) {
  if (!verdict) return under_way ? "goes" : "none";
  if (verdict.meets_laboratory) return "meets";
  return verdict.misfit <= 1 || !verdict.fresh ? "open" : "fails";
}

function facts({ verdict, search, parameters, interval_level: level }) {
  const list = [];
  if (verdict) {
    const told = number(verdict.misfit * search.misfit_asked, 3);
    list.push([`${told} ${search.misfit_unit}`, `largest difference from the laboratory; asked for ${number(search.misfit_asked, 3)}`]);
    list.push([String(verdict.packings.length), verdict.fresh ? "random packings that the search had not seen" : "random packings, which the search had seen"]);
    const open = parameters.filter((one) => one.not_identified).length, free = parameters.filter((one) => one.free).length;
    if (level > 0) list.push([`${free - open} of ${free}`, "fitted parameters bounded by the readings"]);
  } else if (search.misfit_asked) {
    const runs = search.history.filter((one) => one.misfit !== undefined && !one.ended_early);
    if (runs.length > 0) list.push([`${number(Math.min(...runs.map((one) => one.misfit)), 3)} ${search.misfit_unit}`,
      `misfit of the best single run so far; asked for, as a mean over fresh packings, ${number(search.misfit_asked, 3)}`]);
  }
  list.push([`${search.history.length}`, `simulations kept, ${duration(search.wall_s)} of computing`]);
  return element("dl", { class: "facts" }, ...list.map(([value, what]) => element("div", {}, element("dt", {}, value), element("dd", {}, what))));
}

export function verdictPart(content) {
  const kind = verdictKind(content);
  const [sign, heading] = signs[kind];
  return element("header", { id: "verdict", class: kind },
    element("p", { class: "brand" }, "pastefit"),
    element("h1", {}, content.title ?? "A calibration that has no card yet"),
    element("div", { class: "answer" }, element("span", { class: "badge", "aria-hidden": "true" }, sign),
      element("div", {}, element("strong", {}, heading), element("p", {}, content.verdict?.words ?? (kind === "goes" ? "This page looks again every ten seconds." : "Below is what the folder holds so far.")))),
    facts(content));
}

/// What is missing, if something is.
export function missingPart({ missing }) {
  if (missing.length === 0) return null;
  return element("aside", { id: "missing", "aria-label": "What is missing" }, element("h2", {}, "What this page lacks"),
    element("ul", {}, ...missing.map((sentence) => element("li", {}, sentence))));
}
