// The numbers to type into a DEM program: grains, pairs of surfaces, attraction; also as text to take along.
import { element, section } from "./dom.js";

/** @typedef {import("./content.js").TypeInGroup} TypeInGroup */

/** @param {TypeInGroup[]} groups */
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

/**
 * The table as rows of texts with a row of heads; each row names its group.
 * @param {TypeInGroup[]} groups
 */
function rowsOf(groups) {
  const heads = ["group", "quantity", "value", "unit", "remark"];
  return [
    heads,
    ...groups.flatMap(({ title, rows }) =>
      rows.map(({ quantity, value, unit, remark }) => [title, quantity, value, unit, remark]),
    ),
  ];
}

/**
 * As comma-separated values (RFC 4180).
 * @param {TypeInGroup[]} groups
 */
export function typeInCsv(groups) {
  const cell = (/** @type {string} */ text) => (/[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  return rowsOf(groups)
    .map((row) => `${row.map(cell).join(",")}\r\n`)
    .join("");
}

/**
 * With tabs between the cells, as spreadsheets paste them.
 * @param {TypeInGroup[]} groups
 */
export function typeInTabs(groups) {
  return rowsOf(groups)
    .map((row) => `${row.join("\t")}\n`)
    .join("");
}

/**
 * Buttons that take the table along. Where the browser gives no clipboard, e.g. on a page served without https, the
 * table is selected instead, to be copied with the keyboard.
 * @param {TypeInGroup[]} groups
 * @param {HTMLElement} shown
 */
function takeAlong(groups, shown) {
  const said = element("span", { role: "status", class: "note" });
  const copy = () => {
    const selected = () => {
      getSelection()?.selectAllChildren(shown);
      said.textContent = "The table is selected: copy it with Ctrl+C or \u2318C.";
    };
    if (!navigator.clipboard) return selected();
    navigator.clipboard.writeText(typeInTabs(groups)).then(() => (said.textContent = "Copied."), selected);
  };
  const file = `data:text/csv;charset=utf-8,${encodeURIComponent(typeInCsv(groups))}`;
  return element(
    "div",
    { class: "row take-along" },
    element("button", { type: "button", onclick: copy }, "Copy the table"),
    element("a", { href: file, download: "numbers-to-type-in.csv" }, "Save as CSV"),
    said,
  );
}

/** @param {import("./content.js").CardContent} content */
export function typeInPart({ type_in: groups, damping, radius_mm: radius }) {
  const shown = typeInTable(groups);
  return section(
    "type-in",
    "Type this into your DEM program",
    `The numbers hold for grains of ${radius} mm radius. For another size: pastefit rescale.`,
    takeAlong(groups, shown),
    element("div", { class: "wide" }, shown),
    element("p", { class: "note" }, `Damping of each pair: ${damping.join("; ")}.`),
  );
}
