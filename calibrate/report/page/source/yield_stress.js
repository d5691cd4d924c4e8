// What the readings of a test say of its material as a fluid with a yield stress.
import { element, table } from "./dom.js";
import { words } from "./names.js";
import { number, plusMinus } from "./numbers.js";

/** @typedef {import("./content.js").Test} Test */

/**
 * How often a simulated yield stress holds the measured one, and by how many deviations it is above it.
 * @param {{ratio?: number, deviations?: number}} stress
 */
export function comparedWords({ ratio, deviations }) {
  if (ratio === undefined || deviations === undefined) return "";
  return `\u00d7 ${number(ratio, 2)} (${deviations > 0 ? "+" : ""}${number(deviations, 2)} deviations)`;
}

/** @param {Pick<Test, "yield_stress" | "measured_yield_stress">} test */
export function yieldStressTable({ yield_stress: stresses, measured_yield_stress: measured }) {
  if (!stresses) return null;
  const heads = ["Measured reading says [Pa]", "Simulated says [Pa]", ...(measured ? ["Over the measured"] : [])];
  const rows = Object.entries(stresses).map(([name, stress]) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, `${words(name)}, ${stress.formula}`),
      element("td", { class: "number" }, number(stress.measured, 3)),
      element("td", { class: "number" }, number(stress.simulated, 3)),
      measured ? element("td", { class: "number" }, comparedWords(stress)) : null,
    ),
  );
  const head = element(
    "tr",
    {},
    element("th", {}, "By"),
    ...heads.map((one) => element("th", { class: "number" }, one)),
  );
  const own = measured
    ? ` The laboratory measured ${plusMinus(measured.value, measured.standard_deviation)} Pa, which is not fitted.`
    : "";
  const caption = `As a fluid with a yield stress.${own} Height and spread of one heap may differ by a factor of four.`;
  return element("div", { class: "wide" }, table(head, rows, { class: "yield-stress" }, caption));
}
