// The numbers to type into a DEM program: grains, pairs of surfaces, attraction.
import { element, section } from "./dom.js";

/** @param {import("./content.js").TypeInGroup[]} groups */
export function typeInTable(groups) {
  const bodies = groups.map(({ title, rows }) =>
    element(
      "tbody",
      {},
      element("tr", {}, element("th", { colspan: 4, scope: "rowgroup", class: "group" }, title)),
      ...rows.map(({ quantity, value, unit, remark }) =>
        element(
          "tr",
          {},
          element("th", { scope: "row" }, quantity),
          element("td", { class: "number" }, value),
          element("td", {}, unit),
          element("td", { class: "remark" }, remark),
        ),
      ),
    ),
  );
  return element("table", { class: "type-in" }, ...bodies);
}

/** @param {import("./content.js").CardContent} content */
export function typeInPart({ type_in: groups, damping, radius_mm: radius }) {
  return section(
    "type-in",
    "Type this into your DEM program",
    `The numbers hold for grains of ${radius} mm radius. For another size: pastefit rescale.`,
    element("div", { class: "wide" }, typeInTable(groups)),
    element("p", { class: "note" }, `Damping of each pair: ${damping.join("; ")}.`),
  );
}
