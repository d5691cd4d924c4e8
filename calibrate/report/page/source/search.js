// How the search went.
import { element, section } from "./dom.js";
import { historyFigure } from "./history.js";
import { scatterFigure } from "./scatter.js";

/** @param {import("./content.js").Content} content */
export function searchPart(content) {
  const { history, reason } = content.search;
  if (history.length === 0) return null;
  const failed = history.filter((one) => one.failure).length;
  const failures = failed === 0 ? "none failed" : `${failed} failed`;
  const unknown = "Without the study the misfit of these simulations is unknown.";
  const note = "All other parameters differ from point to point; dashed: the laboratory, with its standard deviation.";
  return section(
    "search",
    "The search",
    `${history.length} simulations are kept, ${failures}.${reason ? ` ${reason}` : ""}`,
    history.some((one) => one.misfit !== undefined)
      ? historyFigure(content)
      : element("p", { class: "notice" }, unknown),
    element("h3", {}, "What a parameter does to a reading"),
    scatterFigure(content),
    element("p", { class: "note" }, note),
  );
}
