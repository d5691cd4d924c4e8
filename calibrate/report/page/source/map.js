// What the readings leave open: the misfit over two parameters, and the materials that meet them as well.
import { element, figure, section } from "./dom.js";
import { atNoise, fullName, number, plusMinus, unitOf, words } from "./numbers.js";
import { colour, legend, plot, Plot } from "./plots.js";

const levels = [1, 2, 3, 5, 8];
const shades = [
  "var(--shade-0)",
  "var(--shade-1)",
  "var(--shade-2)",
  "var(--shade-3)",
  "var(--shade-4)",
  "var(--shade-5)",
];

/// The edges of the fields of an axis, half way between its places.
function edges({ scale, places }) {
  const there = scale === "log" ? Math.log : (x) => x,
    back = scale === "log" ? Math.exp : (x) => x;
  const between = places.slice(1).map((place, k) => back((there(places[k]) + there(place)) / 2));
  return [places[0], ...between, places.at(-1)];
}

function drawn({ x, y, miss, equivalent, simulated }, width) {
  const [xs, ys] = [edges(x), edges(y)],
    columns = x.places.length;
  const fields = miss.map((value, k) => ({ value, column: k % columns, row: Math.floor(k / columns) }));
  const axis = ({ name, scale, lower, upper }) => ({
    label: name,
    type: scale,
    domain: [lower, upper],
    tickFormat: scale === "log" ? "~g" : undefined,
    nice: false,
    grid: false,
  });
  return plot(width, {
    className: "map",
    height: Math.round(Math.min(460, 0.7 * width)),
    x: axis({ ...x }),
    y: axis({ ...y }),
    color: { type: "threshold", domain: levels, range: shades },
    marks: [
      Plot.rect(fields, {
        x1: ({ column }) => xs[column],
        x2: ({ column }) => xs[column + 1],
        y1: ({ row }) => ys[row],
        y2: ({ row }) => ys[row + 1],
        fill: "value",
        inset: -0.3,
        shapeRendering: "crispEdges",
      }),
      Plot.dot(simulated, { x: "0", y: "1", r: 2, fill: colour.quiet }),
      Plot.dot(equivalent.slice(1), {
        x: "0",
        y: "1",
        r: 6,
        symbol: "diamond",
        fill: colour.equivalent,
        stroke: "var(--page)",
      }),
      Plot.dot(equivalent.slice(0, 1), {
        x: "0",
        y: "1",
        r: 7,
        symbol: "star",
        fill: colour.laboratory,
        stroke: "var(--page)",
      }),
      Plot.tip(
        fields,
        Plot.pointer({
          x: ({ column }) => x.places[column],
          y: ({ row }) => y.places[row],
          title: ({ value, column, row }) =>
            `${number(value, 2)} standard deviations\n${x.name} ${number(x.places[column], 3)}\n${y.name} ${number(y.places[row], 3)}`,
          fill: "var(--card)",
        }),
      ),
    ],
  });
}

function levelLegend() {
  const words = [
    `below ${levels[0]}`,
    ...levels.slice(1).map((level, k) => `${levels[k]} to ${level}`),
    `above ${levels.at(-1)}`,
  ];
  return words.map((text, k) => [
    k === 0 ? `${text} standard deviation from the laboratory` : text,
    `field shade-${k}`,
  ]);
}

/// What the laboratory measured of a reading, with its deviation.
function measuredOf(tests, name) {
  for (const test of tests)
    for (const one of test.readings)
      if (fullName(test.name, one.name) === name && one.measured !== undefined)
        return plusMinus(one.measured, one.standard_deviation);
  return "";
}

/// With places where a name may be broken.
const broken = (name) => name.replace(/[_.]/g, "$&\u200b");

function familyTable({ family, noise }, tests) {
  const names = Object.keys(family[0].values),
    readings = Object.keys(family[0].readings);
  return element(
    "div",
    { class: "wide" },
    element(
      "table",
      {},
      element(
        "caption",
        {},
        "Materials that may well meet the laboratory too; the first is the recommended one. \u201cPredicted\u201d ones are told from simulations nearby, and were not simulated themselves.",
      ),
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          ...names.map((name) => element("th", { class: "number" }, broken(name))),
          ...readings.map((name) =>
            element("th", { class: "number" }, unitOf(name) ? `${words(name)} [${unitOf(name)}]` : words(name)),
          ),
          element("th", {}, "Known from"),
        ),
      ),
      element(
        "tbody",
        {},
        element(
          "tr",
          { class: "measured" },
          element("th", { colspan: names.length, scope: "row" }, "Laboratory"),
          ...readings.map((name) => element("td", { class: "number" }, measuredOf(tests, name))),
          element("td"),
        ),
        ...family.map((one) =>
          element(
            "tr",
            {},
            ...names.map((name) => element("td", { class: "number" }, number(one.values[name], 3))),
            ...readings.map((name) => element("td", { class: "number" }, atNoise(one.readings[name], noise?.[name]))),
            element("td", {}, one.simulated ? "simulated" : "predicted"),
          ),
        ),
      ),
    ),
  );
}

export function openPart({ inference, search, tests = [] }) {
  if (!inference) return null;
  const map = search.map;
  return section(
    "open",
    "What is determined, and what is not",
    `From ${inference.simulations} simulations of this study.`,
    element("pre", { class: "words" }, inference.words.trimEnd()),
    map
      ? figure(
          {},
          (width) => drawn(map, width),
          element(
            "figcaption",
            {},
            element(
              "strong",
              {},
              `Predicted misfit over ${map.x.name} and ${map.y.name}, the other parameters as recommended`,
            ),
            legend([
              ...levelLegend(),
              ["recommended", "mark star"],
              ["equivalent materials; their other parameters differ too", "mark diamond"],
              ["simulated", "mark dot"],
            ]),
          ),
        )
      : null,
    familyTable(inference, tests),
  );
}
