// How the search went: the misfit of every simulation, failures included.
import { candidateCard, kindOf } from "./candidate.js";
import { choice, element, figure, section } from "./dom.js";
import { fullName, number, plusMinus, unitOf, words } from "./numbers.js";
import { colour, legend, plot, Plot } from "./plots.js";

const kinds = {
  search: { symbol: "circle", stroke: colour.simulation },
  "ended early": { symbol: "triangle", stroke: colour.quiet },
  confirmation: { symbol: "square", stroke: colour.laboratory },
  "other grains": { symbol: "plus", stroke: colour.quiet },
  failure: { symbol: "times", stroke: colour.failure },
};

const legendWords = {
  failure: "failed, or without a fitted reading (at the top)",
  "ended early": "ended early: lower bound of the misfit",
  "other grains": "coarser grains (drawn at the top: their misfit is not comparable)",
};

function kindsIn(history) {
  const there = new Set(history.map(kindOf));
  return Object.keys(kinds).filter((kind) => there.has(kind));
}

function dots(points, x, y) {
  return Object.entries(kinds).map(([kind, { symbol, stroke }]) =>
    Plot.dot(
      points.filter((point) => kindOf(point) === kind),
      {
        x,
        y,
        symbol,
        stroke,
        r: 4,
        strokeWidth: 1.6,
        fill: kind === "confirmation" ? stroke : null,
        fillOpacity: 0.35,
      },
    ),
  );
}

/// The points with the height at which they are drawn: those without a misfit at the upper edge.
function placed({ history, misfit_asked: asked }) {
  const known = history.filter((point) => point.misfit !== undefined).map((point) => point.misfit);
  const least = 0.02 * (asked ?? 1),
    most = Math.max(...known, asked ?? 1);
  return history.map((point) => ({
    ...point,
    at: point.misfit === undefined ? 1.6 * most : Math.max(point.misfit, least),
  }));
}

function bestSoFar(points) {
  let best = Infinity;
  return points
    .filter((point) => kindOf(point) === "search" && point.misfit !== undefined)
    .map((point) => ({ number: point.number, at: (best = Math.min(best, point.at)) }));
}

/// What is shown to begin with: a run that confirmed the material, or else the best one.
function best(points) {
  const known = points.filter((point) => point.misfit !== undefined && !point.ended_early);
  return (
    points.find((point) => point.confirmation) ??
    known.reduce((one, other) => (other.misfit < one.misfit ? other : one), known[0] ?? points[0])
  );
}

function historyPlot(points, search, width) {
  return plot(width, {
    className: "history",
    x: { label: "simulations, in the order in which they ended", nice: false },
    y: { type: "log", label: `misfit [${search.misfit_unit ?? "tolerances"}]`, tickFormat: "~g" },
    marks: [
      search.misfit_asked
        ? Plot.ruleY([search.misfit_asked], { stroke: colour.laboratory, strokeDasharray: "6 4" })
        : null,
      search.misfit_asked
        ? Plot.text([search.misfit_asked], {
            y: (d) => d,
            text: () => "allowed",
            frameAnchor: "left",
            dx: 4,
            dy: -8,
            fill: colour.laboratory,
          })
        : null,
      Plot.line(bestSoFar(points), {
        x: "number",
        y: "at",
        curve: "step-after",
        stroke: colour.simulation,
        strokeWidth: 1.2,
      }),
      ...dots(points, "number", "at"),
      Plot.dot(
        points,
        Plot.pointer({ x: "number", y: "at", r: 8, stroke: "currentColor", strokeWidth: 2, maxRadius: 40 }),
      ),
    ],
  });
}

/// The history with a card beside it that follows the pointer, or the arrow keys.
function historyFigure(content, measured) {
  const { search } = content;
  const points = placed(search);
  const card = element("div", { class: "beside", "aria-live": "polite" });
  const note = () =>
    element("p", { class: "note" }, "Point at a simulation, or step through them with the arrow keys.");
  let chosen = -1;
  const choose = (point) => {
    if (!point) return;
    chosen = points.indexOf(point);
    card.replaceChildren(candidateCard(point, content, measured), note());
  };
  const made = figure(
    { class: "with-card", tabindex: 0, "aria-label": "Misfit of every simulation; arrow keys step through them" },
    (width) => {
      const drawn = historyPlot(points, search, width);
      drawn.addEventListener("input", () => choose(drawn.value));
      return drawn;
    },
    card,
    element(
      "figcaption",
      {},
      legend([
        ...kindsIn(points).map((kind) => [legendWords[kind] ?? kind, `mark ${kind.replace(" ", "-")}`]),
        ["best single run so far", "line simulation"],
      ]),
    ),
  );
  choose(best(points));
  made.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step || event.target.tagName === "SELECT") return;
    event.preventDefault();
    choose(points[Math.min(Math.max(chosen + step, 0), points.length - 1)]);
  });
  return made;
}

/// The readings of a simulation by their names among those of all tests.
const readingsOf = (point) =>
  new Map(Object.entries(point.readings).map(([name, value]) => [fullName(point.test, name), value]));
const reads = (reading) => (point) => readingsOf(point).get(reading);

/// What a point says when it is pointed at: `noise` is that of the reading from packing to packing.
const told = (parameter, reading, noise) => (point) =>
  `simulation ${point.number}${point.ended_early ? ", ended early" : ""}\n${parameter} ${number(point.values[parameter])}\n${words(reading)} ${plusMinus(reads(reading)(point), noise)} ${unitOf(reading)}`;

/// `deviation`: of the laboratory.
function scatterPlot(points, { parameter, reading, spec, measured, deviation, noise }, width) {
  const measuredAt = measured.get(reading);
  return plot(width, {
    className: "scatter",
    x: {
      label: parameter,
      type: spec?.scale === "log" ? "log" : "linear",
      tickFormat: spec?.scale === "log" ? "~g" : undefined,
    },
    y: { label: unitOf(reading) ? `${words(reading)} [${unitOf(reading)}]` : words(reading) },
    marks: [
      measuredAt === undefined || !deviation
        ? null
        : Plot.rect([measuredAt], {
            y1: (at) => at - deviation,
            y2: (at) => at + deviation,
            fill: colour.laboratory,
            fillOpacity: 0.12,
          }),
      measuredAt === undefined ? null : Plot.ruleY([measuredAt], { stroke: colour.laboratory, strokeDasharray: "6 4" }),
      ...dots(points, (point) => point.values[parameter], reads(reading)),
      Plot.tip(
        points,
        Plot.pointer({
          x: (point) => point.values[parameter],
          y: reads(reading),
          title: told(parameter, reading, noise),
          fill: "var(--card)",
        }),
      ),
    ],
  });
}

/// A reading against a parameter, both of the reader's choice.
function scatterFigure({ search, parameters = [], tests = [], inference }, measured) {
  const deviations = new Map(
    tests.flatMap((test) => test.readings.map((one) => [fullName(test.name, one.name), one.standard_deviation])),
  );
  const done = search.history.filter((point) => !point.failure && !point.other_grains);
  const names = [...new Set(done.flatMap((point) => Object.keys(point.values)))];
  const readings = [...new Set(done.flatMap((point) => [...readingsOf(point).keys()]))].sort(
    (one, other) =>
      measured.has(other) - measured.has(one) ||
      one.includes("fill.") - other.includes("fill.") ||
      other.endsWith(".height_mm") - one.endsWith(".height_mm"),
  );
  if (names.length === 0 || readings.length === 0) return null;
  const shown = { parameter: names[0], reading: readings[0] };
  const made = figure({}, (width) => {
    const points = done.filter((point) => reads(shown.reading)(point) !== undefined);
    return scatterPlot(
      points,
      {
        ...shown,
        spec: parameters.find((one) => one.name === shown.parameter),
        measured,
        deviation: deviations.get(shown.reading),
        noise: inference?.noise?.[shown.reading],
      },
      width,
    );
  });
  const change = (what) => (value) => {
    shown[what] = value;
    made.redraw();
  };
  made.prepend(
    element(
      "div",
      { class: "row" },
      choice(
        "Parameter",
        names.map((name) => [name, name]),
        names[0],
        change("parameter"),
      ),
      choice(
        "Reading",
        readings.map((name) => [name, words(name)]),
        readings[0],
        change("reading"),
      ),
    ),
  );
  return made;
}

export function searchPart(content) {
  const { search } = content;
  if (search.history.length === 0) return null;
  const measured = new Map(Object.entries(search.measured));
  const failed = search.history.filter((point) => point.failure).length;
  const lead = `${search.history.length} simulations are kept, ${failed === 0 ? "none failed" : `${failed} failed`}.${search.reason ? ` ${search.reason}` : ""}`;
  return section(
    "search",
    "The search",
    lead,
    search.history.some((point) => point.misfit !== undefined)
      ? historyFigure(content, measured)
      : element("p", { class: "notice" }, "Without the study the misfit of these simulations is unknown."),
    element("h3", {}, "What a parameter does to a reading"),
    scatterFigure(content, measured),
    element(
      "p",
      { class: "note" },
      "All other parameters differ from point to point; dashed: the laboratory, with its standard deviation.",
    ),
  );
}
