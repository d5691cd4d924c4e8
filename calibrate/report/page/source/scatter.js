// A reading of all simulations against a parameter, both of the reader's choice.
import { choice, element, figure } from "./dom.js";
import { fullName, withUnit, words, wordsAndUnit } from "./names.js";
import { number, plusMinus } from "./numbers.js";
import { colour, plot, Plot, tip } from "./plots.js";
import { dots, readingsOf } from "./simulation.js";

/** @typedef {import("./content.js").Content} Content */
/** @typedef {import("./content.js").Simulation} Simulation */

/**
 * The readings of the simulations: first those that were fitted, then what else the laboratory took, last those of the
 * filling.
 * @param {Simulation[]} simulations
 * @param {Content} content
 */
export function readingNames(simulations, { search, tests = [] }) {
  const fitted = new Set(
    tests.flatMap((test) =>
      test.readings.filter(({ weight = 0 }) => weight > 0).map((one) => fullName(test.name, one.name)),
    ),
  );
  /** @param {string} name */
  const rank = (name) => {
    if (name in search.measured) return fitted.has(name) ? 0 : 1;
    return /(^|\/)fill\./.test(name) ? 3 : 2;
  };
  const names = new Set(simulations.flatMap((one) => [...readingsOf(one).keys()]));
  return [...names].sort((one, other) => rank(one) - rank(other));
}

/**
 * What the laboratory measured, with its deviation.
 * @param {Content} content
 * @param {string} reading
 */
function laboratoryMarks({ search, tests = [] }, reading) {
  const measured = search.measured[reading];
  if (measured === undefined) return [];
  const rule = Plot.ruleY([measured], { stroke: colour.laboratory, strokeDasharray: "6 4" });
  const all = tests.flatMap((test) => test.readings.map((one) => ({ ...one, name: fullName(test.name, one.name) })));
  const deviation = all.find(({ name }) => name === reading)?.standard_deviation;
  if (!deviation) return [rule];
  const look = { fill: colour.laboratory, fillOpacity: 0.12 };
  return [Plot.rect([measured], { y1: measured - deviation, y2: measured + deviation, ...look }), rule];
}

/**
 * @param {Simulation[]} simulations
 * @param {string} parameter
 * @param {string} reading
 * @param {Content} content
 * @param {number} width
 */
function scatterPlot(simulations, parameter, reading, content, width) {
  const logarithmic = content.parameters?.find(({ name }) => name === parameter)?.scale === "log";
  const noise = content.inference?.noise?.[reading];
  /** @param {Simulation} one */
  const x = (one) => one.values[parameter];
  /** @param {Simulation} one */
  const y = (one) => readingsOf(one).get(reading);
  /** @param {Simulation} one */
  const title = (one) =>
    `simulation ${one.number}${one.ended_early ? ", ended early" : ""}\n` +
    `${words(parameter)} ${withUnit(number(x(one)), parameter)}\n` +
    `${words(reading)} ${withUnit(plusMinus(y(one) ?? NaN, noise), reading)}`;
  const known = simulations.filter((one) => y(one) !== undefined);
  return plot(width, {
    className: "scatter",
    x: {
      label: wordsAndUnit(parameter),
      type: logarithmic ? "log" : "linear",
      tickFormat: logarithmic ? "~g" : undefined,
    },
    y: { label: wordsAndUnit(reading) },
    marks: [...laboratoryMarks(content, reading), ...dots(known, x, y), tip(known, { x, y, title })],
  });
}

/** @param {Content} content */
export function scatterFigure(content) {
  const done = content.search.history.filter((one) => !one.failure && !one.other_grains);
  const parameters = [...new Set(done.flatMap((one) => Object.keys(one.values)))];
  const readings = readingNames(done, content);
  if (parameters.length === 0 || readings.length === 0) return null;
  let [parameter] = parameters;
  let [reading] = readings;
  const made = figure({}, (width) => scatterPlot(done, parameter, reading, content, width));
  const ofParameters = choice(
    "Parameter",
    parameters.map((name) => [name, words(name)]),
    parameter,
    (name) => {
      parameter = name;
      made.redraw();
    },
  );
  const ofReadings = choice(
    "Reading",
    readings.map((name) => [name, words(name)]),
    reading,
    (name) => {
      reading = name;
      made.redraw();
    },
  );
  made.prepend(element("div", { class: "row" }, ofParameters, ofReadings));
  return made;
}
