// What a change of one parameter does to the readings, as the model of the simulations predicts it.
import { element, table } from "./dom.js";
import { withUnit, words } from "./names.js";
import { number, plusMinusSigned } from "./numbers.js";

/** @typedef {import("./content.js").Inference} Inference */
/** @typedef {import("./content.js").Sensitivity} Sensitivity */

/**
 * "+20 %", or where the value is zero "to 0.1": shares of nothing are nothing.
 * @param {Pick<Sensitivity, "from" | "to">} change
 */
export function changeWords({ from, to }) {
  if (from === 0) return `to ${number(to, 3)}`;
  const percent = 100 * ((to - from) / Math.abs(from));
  return `${percent > 0 ? "+" : ""}${number(percent, 2)} %`;
}

/**
 * @param {Sensitivity} one
 * @param {string[]} readings
 */
function row({ parameter, from, to, changes }, readings) {
  const known = readings.some((name) => changes[name]);
  const cells = readings.map((name) => {
    const [change, deviation] = changes[name] ?? [NaN, NaN];
    const quiet = Math.abs(change) < deviation ? " unclear" : "";
    return element("td", { class: `number${quiet}` }, withUnit(plusMinusSigned(change, deviation), name));
  });
  const jump = element("td", { colspan: readings.length }, "no prediction: the readings jump here");
  return element(
    "tr",
    {},
    element("th", { scope: "row" }, `${words(parameter)} ${changeWords({ from, to })}`),
    element("td", {}, `${number(from, 3)} to ${withUnit(number(to, 3), parameter)}`),
    ...(known ? cells : [jump]),
  );
}

/** @param {Inference | undefined} inference */
export function sensitivityTable(inference) {
  const all = inference?.sensitivities ?? [];
  const readings = [...new Set(all.flatMap(({ changes }) => Object.keys(changes)))];
  if (!inference || readings.length === 0) return null;
  const heads = readings.map((name) => element("th", { class: "number" }, words(name)));
  const head = element("tr", {}, element("th", {}, "Change"), element("th", {}, "From, to"), ...heads);
  const caption =
    `Predicted from ${inference.simulations} simulations: one parameter changes, the others stay. ` +
    "\u00b1: standard deviation of the prediction; a change below it says nothing.";
  return element(
    "div",
    { class: "wide" },
    element("h3", {}, "What a change does to the readings"),
    table(
      head,
      all.map((one) => row(one, readings)),
      { class: "sensitivities" },
      caption,
    ),
  );
}
