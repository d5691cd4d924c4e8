// The drawings of a test (calibrate/laboratory/drawing.h): a heap with its dimensions, a curve over its strength.
import { element, figure } from "./dom.js";
import { plusMinus, unitOf } from "./numbers.js";
import { colour, legend, Plot } from "./plots.js";

const middle = ([x1, y1], [x2, y2]) => [(x1 + x2) / 2, (y1 + y2) / 2];
const isUpright = ({ from, to }) => from[0] === to[0];

/// The box of all that is drawn.
function boxOf({ bands, lines, lengths }) {
  const points = [
    ...bands.flatMap(({ points: some }) =>
      some.flatMap(([x, low, high]) => [
        [x, low],
        [x, high],
      ]),
    ),
    ...lines.flatMap((line) => line.points),
    ...lengths.flatMap(({ from, to }) => [from, to]),
  ];
  const range = (axis) => [
    Math.min(...points.map((point) => point[axis])),
    Math.max(...points.map((point) => point[axis])),
  ];
  return { x: range(0), y: range(1) };
}

/// A length: thin lines from what it is the distance of, arrows at both ends, and its value; `scale`: pixels for 1 upwards, `among`: from where to where the axis goes.
function lengthMarks(length, scale, among) {
  const stroke = colour[length.by],
    centre = middle(length.from, length.to);
  const unit = unitOf(length.reading);
  const text = `${plusMinus(length.value, length.deviation)} ${unit}`;
  const links = [
    [length.first, length.from],
    [length.last, length.to],
  ].map(([[x1, y1], [x2, y2]]) => ({ x1, y1, x2, y2 }));
  // Beside an arrow that is shorter than its text there is no room; above it there is, one line for each.
  const along = isUpright(length) && Math.abs(length.to[1] - length.from[1]) * scale > 6.6 * text.length;
  const above = isUpright(length) && !along;
  const left = centre[0] < (among[0] + among[1]) / 2;
  const place = above ? [centre[0], Math.max(length.from[1], length.to[1])] : centre;
  const arrows = [length.from, length.to].map(([x2, y2]) => ({ x1: centre[0], y1: centre[1], x2, y2 }));
  const ends = { x1: "x1", y1: "y1", x2: "x2", y2: "y2", stroke };
  return [
    Plot.link(links, { ...ends, strokeWidth: 0.7, strokeDasharray: "2 3" }),
    Plot.arrow(arrows, { ...ends, strokeWidth: 1.4, headLength: 7, headAngle: 40 }),
    Plot.text([{ x: place[0], y: place[1] }], {
      x: "x",
      y: "y",
      text: () => text,
      fill: stroke,
      stroke: "var(--page)",
      strokeWidth: 4,
      rotate: along ? -90 : 0,
      dy: above ? (length.by === "laboratory" && !left ? -28 : -10) : along ? 0 : -8,
      dx: along ? -8 : above ? (left ? -10 : 12) : 0,
      textAnchor: above ? (left ? "start" : "end") : "middle",
      fontWeight: 600,
    }),
  ];
}

/// How a line looks, by whose word it is.
const looks = {
  laboratory: { stroke: colour.laboratory, strokeWidth: 2.2, strokeDasharray: "8 3" },
  simulation: { stroke: colour.simulation, strokeWidth: 2.2 },
  apparatus: { stroke: colour.apparatus, strokeWidth: 1.2, strokeDasharray: "5 3" },
  run: { stroke: colour.simulation, strokeWidth: 0.8, strokeOpacity: 0.6 },
  rejected: { stroke: colour.failure, strokeWidth: 1, strokeOpacity: 0.9 },
};

function lineMarks({ by, points, deviation }) {
  const { stroke } = looks[by];
  const band =
    deviation > 0
      ? [
          Plot.areaY(points, {
            x: "0",
            y1: ([, y]) => y - deviation,
            y2: ([, y]) => y + deviation,
            fill: stroke,
            fillOpacity: 0.15,
          }),
        ]
      : [];
  return [...band, Plot.line(points, looks[by])];
}

function drawn(drawing, width) {
  const { x, y } = boxOf(drawing);
  const margins = { marginLeft: 52, marginRight: 24, marginTop: drawing.to_scale ? 16 : 30, marginBottom: 42 };
  const scale = (width - margins.marginLeft - margins.marginRight) / (x[1] - x[0]);
  const height = drawing.to_scale
    ? Math.round((y[1] - y[0]) * scale * 1.08 + margins.marginTop + margins.marginBottom)
    : Math.round(Math.min(420, 0.6 * width));
  const pad = drawing.to_scale ? 0.04 * (y[1] - y[0]) : 0;
  const upwards = drawing.to_scale
    ? scale
    : (height - margins.marginTop - margins.marginBottom) / (1.05 * y[1] - Math.min(0, y[0]));
  return Plot.plot({
    width,
    height,
    ...margins,
    style: { fontSize: "13px", background: "none" },
    x: { label: drawing.x, domain: x, labelAnchor: "center", labelArrow: "none" },
    y: {
      label: drawing.y,
      domain: drawing.to_scale ? [y[0] - pad, y[1] + pad] : [Math.min(0, y[0]), 1.05 * y[1]],
      labelArrow: "none",
      ticks: drawing.to_scale ? 5 : undefined,
    },
    marks: [
      ...drawing.bands.map(({ points }) =>
        Plot.areaY(points, { x: "0", y1: "1", y2: "2", fill: colour.simulation, fillOpacity: 0.22 }),
      ),
      ...drawing.lines.flatMap(lineMarks),
      ...drawing.lengths.flatMap((length) => lengthMarks(length, upwards, x)),
    ],
  });
}

function legendOf({ bands, lines, lengths }) {
  const names = new Map(lines.map(({ name, by }) => [name, `line ${by}`])); // heaps share one
  const entries = [...bands.map(({ name }) => [name, "band"]), ...names];
  const told = new Set();
  for (const { by } of lengths) if (!told.has(by)) told.add(by);
  for (const by of told)
    entries.push([
      by === "laboratory"
        ? "the laboratory's lengths \u00b1 deviation"
        : "simulated lengths, means \u00b1 standard error",
      `line ${by}`,
    ]);
  return legend(entries);
}

/// A drawing of one width, for paper, where nothing is drawn anew.
export function drawingSheet(drawing, width, heading) {
  return element(
    "figure",
    { class: "sheet-drawing" },
    drawn(drawing, width),
    element("figcaption", {}, element("strong", {}, heading), legendOf(drawing)),
  );
}

export function drawingFigure(drawing) {
  return figure(
    { class: "test-drawing" },
    (width) => drawn(drawing, width),
    element("figcaption", {}, element("strong", {}, drawing.name), legendOf(drawing)),
  );
}
