// The misfit of every simulation, failures included, with a card beside it that follows the pointer.
import { candidateCard } from "./candidate.js";
import { element, figure } from "./dom.js";
import { colour, legend, plot, Plot } from "./plots.js";
import { bestOf, bestSoFar, dots, kindsIn, placed } from "./simulation.js";

/** @typedef {import("./content.js").Content} Content */
/** @typedef {import("./content.js").Search} Search */
/** @typedef {import("./simulation.js").Placed} Placed */

/** @type {Record<string, string>} */
const legendWords = {
  failure: "failed, or without a fitted reading (at the top)",
  "ended early": "ended early: lower bound of the misfit",
  "other grains": "coarser grains (drawn at the top: their misfit is not comparable)",
};

/** @param {number} asked the misfit that is allowed */
function allowedMarks(asked) {
  const label = { text: () => "allowed", frameAnchor: "left", dx: 4, dy: -8, fill: colour.laboratory };
  return [
    Plot.ruleY([asked], { stroke: colour.laboratory, strokeDasharray: "6 4" }),
    Plot.text([asked], { y: (misfit) => misfit, .../** @type {Plot.TextOptions} */ (label) }),
  ];
}

/**
 * @param {Placed[]} points
 * @param {Search} search
 * @param {number} width
 */
function historyPlot(points, { misfit_asked: asked, error_unit: unit = "tolerances" }, width) {
  const pointed = Plot.pointer({ x: "number", y: "at", maxRadius: 40 });
  return plot(width, {
    className: "history",
    x: { label: "simulations, in the order in which they ended", nice: false },
    y: { type: "log", label: `misfit [${unit}]`, tickFormat: "~g" },
    marks: [
      ...(asked ? allowedMarks(asked) : []),
      Plot.line(bestSoFar(points), {
        x: "number",
        y: "at",
        curve: "step-after",
        stroke: colour.simulation,
        strokeWidth: 1.2,
      }),
      ...dots(
        points,
        ({ number }) => number,
        ({ at }) => at,
      ),
      Plot.dot(points, { ...pointed, r: 8, stroke: "currentColor", strokeWidth: 2 }),
    ],
  });
}

/** @param {Placed[]} points */
function caption(points) {
  return element(
    "figcaption",
    {},
    legend([
      ...kindsIn(points).map(
        (kind) => /** @type {[string, string]} */ ([legendWords[kind] ?? kind, `mark ${kind.replace(" ", "-")}`]),
      ),
      ["best single run so far", "line simulation"],
    ]),
  );
}

/** @param {Content} content */
export function historyFigure(content) {
  const points = placed(content.search);
  const card = element("div", { class: "beside", "aria-live": "polite" });
  let chosen = -1;
  /** @param {Placed | null} point */
  const choose = (point) => {
    if (!point) return;
    chosen = points.indexOf(point);
    const note = "Point at a simulation, or step through them with the arrow keys.";
    card.replaceChildren(candidateCard(point, content), element("p", { class: "note" }, note));
  };
  const attributes = {
    class: "with-card",
    tabindex: 0,
    "aria-label": "Misfit of every simulation; arrow keys step through them",
  };
  /** @param {number} width */
  const draw = (width) => {
    const drawn = historyPlot(points, content.search, width);
    drawn.addEventListener("input", () => choose(drawn.value));
    return drawn;
  };
  const made = figure(attributes, draw, card, caption(points));
  choose(bestOf(points));
  made.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0 || event.target instanceof HTMLSelectElement) return;
    event.preventDefault();
    choose(points[Math.min(Math.max(chosen + step, 0), points.length - 1)]);
  });
  return made;
}
