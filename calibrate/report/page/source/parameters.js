// The fitted parameters with their intervals, and the fixed ones.
import { element, section, svgElement } from "./dom.js";
import { number } from "./numbers.js";

/// The share of the way from the lower to the upper bound.
export function shareOf({ lower, upper, scale }, value) {
  const along = scale === "log" ? Math.log : (x) => x;
  return Math.min(Math.max((along(value) - along(lower)) / (along(upper) - along(lower)), 0), 1);
}

/// The bounds of the study as a line, the interval on it, and the value.
function bar(parameter) {
  const [width, height, edge] = [200, 18, 6];
  const x = (value) => edge + (width - 2 * edge) * shareOf(parameter, value);
  const marks = [svgElement("line", { x1: edge, x2: width - edge, y1: height / 2, y2: height / 2, class: "bounds" })];
  if (parameter.interval) {
    const [low, high] = parameter.interval;
    marks.push(
      svgElement("rect", {
        x: x(low),
        width: Math.max(x(high) - x(low), 2),
        y: height / 2 - 4,
        height: 8,
        rx: 2,
        class: "interval",
      }),
    );
  }
  marks.push(svgElement("circle", { cx: x(parameter.value), cy: height / 2, r: 5, class: "value" }));
  return svgElement(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      class: "bar",
      role: "img",
      "aria-label": `from ${number(parameter.lower)} to ${number(parameter.upper)}`,
    },
    ...marks,
  );
}

function intervalWords(parameter, level) {
  if (parameter.interval) return `${number(parameter.interval[0], 3)} to ${number(parameter.interval[1], 3)}`;
  return parameter.not_identified ?? (level > 0 ? "not bounded by the readings" : "not worked out");
}

export function parametersPart({ parameters, interval_level: level, radius_mm: radius }) {
  const free = parameters.filter((one) => one.free),
    fixed = parameters.filter((one) => !one.free);
  const rows = free.map((one) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, one.name, element("small", {}, one.meaning)),
      element("td", { class: "number" }, number(one.value)),
      element("td", {}, intervalWords(one, level)),
      element(
        "td",
        {},
        bar(one),
        element(
          "small",
          { class: "ends" },
          element("span", {}, number(one.lower, 3)),
          element("span", {}, `${number(one.upper, 3)}${one.scale === "log" ? ", log" : ""}`),
        ),
      ),
    ),
  );
  return section(
    "parameters",
    "The material",
    `Scale-free parameters, fitted with grains of ${number(radius, 3)} mm radius. The bar is what the readings leave open within the study's bounds.`,
    element(
      "div",
      { class: "wide" },
      element(
        "table",
        {},
        element(
          "thead",
          {},
          element(
            "tr",
            {},
            element("th", {}, "Parameter"),
            element("th", { class: "number" }, "Value"),
            element("th", {}, level > 0 ? `${number(100 * level, 3)} % interval` : "Interval"),
            element("th", {}, "Within the bounds"),
          ),
        ),
        element("tbody", {}, ...rows),
      ),
    ),
    element(
      "details",
      {},
      element("summary", {}, `${fixed.length} fixed parameters`),
      element(
        "dl",
        { class: "pairs" },
        ...fixed.flatMap((one) => [
          element("dt", { title: one.meaning }, one.name),
          element("dd", {}, number(one.value)),
        ]),
      ),
    ),
  );
}
