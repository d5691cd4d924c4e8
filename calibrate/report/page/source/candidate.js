// One simulation of the search, as small pictures and numbers.
import { element, svgElement } from "./dom.js";
import { fullName, number, plusMinus, unitOf, words } from "./numbers.js";
import { shareOf } from "./parameters.js";

const [width, height, edge] = [220, 90, 10];

/// Its heap from the side, or its curve; thin: that of a confirmed run, and what the laboratory read of a heap. All of one
/// test have one scale.
function sketchOf(point, history, measured) {
  const ofTest = history.filter((one) => one.sketch && one.test === point.test);
  const all = ofTest.flatMap((one) => one.sketch.points);
  const { heap, points } = point.sketch;
  const range = (axis) => [
    Math.min(0, ...all.map((place) => place[axis])),
    Math.max(...all.map((place) => place[axis])),
  ];
  const [xs, ys] = [range(0), range(1)];
  const scales = [(width - 2 * edge) / (xs[1] - xs[0]), (height - 2 * edge) / (ys[1] - ys[0])];
  const [across, up] = heap ? Array(2).fill(Math.min(...scales)) : scales;
  const left = (width - across * (xs[1] - xs[0])) / 2;
  const x = (value) => left + across * (value - xs[0]),
    y = (value) => height - edge - up * (value - ys[0]);
  const line = (list, kind) =>
    svgElement("polyline", {
      points: list.map((place) => `${x(place[0]).toFixed(1)},${y(place[1]).toFixed(1)}`).join(" "),
      class: kind,
    });
  const confirmed = ofTest.find((one) => one.confirmation);
  // A heap is drawn as it stood last.
  const read = (name) =>
    heap
      ? (measured.get(fullName(point.test, `step2.${name}`)) ?? measured.get(fullName(point.test, `step1.${name}`)))
      : undefined;
  const [tall, wide] = [read("height_mm"), read("spread_mm")];
  const lab = (x1, y1, x2, y2) => svgElement("line", { x1: x(x1), y1: y(y1), x2: x(x2), y2: y(y2), class: "read" });
  return svgElement(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      class: "candidate-picture sketch",
      role: "img",
      "aria-label": `its ${heap ? "heap from the side" : "curve"}${confirmed ? "; thin: a confirmed one" : ""}${tall ? "; dashed: the laboratory's height and spread" : ""}`,
    },
    svgElement("line", { x1: edge, x2: width - edge, y1: y(0), y2: y(0), class: "bounds" }),
    ...(heap
      ? [
          svgElement("polygon", {
            points: [...points, [points.at(-1)[0], 0], [points[0][0], 0]]
              .map((place) => `${x(place[0]).toFixed(1)},${y(place[1]).toFixed(1)}`)
              .join(" "),
            class: "heap",
          }),
        ]
      : []),
    line(points, "own"),
    ...(confirmed && confirmed.number !== point.number ? [line(confirmed.sketch.points, "fitted")] : []),
    ...(tall ? [lab(xs[0], tall, xs[1], tall)] : []),
    ...(wide ? [lab(-wide / 2, 0, -wide / 2, 0.3 * ys[1]), lab(wide / 2, 0, wide / 2, 0.3 * ys[1])] : []),
  );
}

/// Where its parameters lie within their bounds: a line through one axis each.
function picture(point, free) {
  const x = (k) => (free.length > 1 ? edge + ((width - 2 * edge) * k) / (free.length - 1) : width / 2);
  const y = (share) => height - edge - (height - 2 * edge) * share;
  const told = free.map((one, k) => [x(k), y(shareOf(one, point.values[one.name] ?? one.value))]);
  const best = free.filter((one) => one.value !== undefined).map((one, k) => [x(k), y(shareOf(one, one.value))]);
  return svgElement(
    "svg",
    {
      viewBox: `0 0 ${width} ${height}`,
      class: "candidate-picture",
      role: "img",
      "aria-label": "its parameters within their bounds; thin: the fitted ones",
    },
    ...free.map((_, k) => svgElement("line", { x1: x(k), x2: x(k), y1: edge, y2: height - edge, class: "bounds" })),
    svgElement("polyline", { points: best.map((place) => place.join(",")).join(" "), class: "fitted" }),
    svgElement("polyline", { points: told.map((place) => place.join(",")).join(" "), class: "own" }),
    ...told.map(([cx, cy]) => svgElement("circle", { cx, cy, r: 3.5, class: "own" })),
  );
}

/// What it was for, and how it ended.
export function kindOf(point) {
  if (point.failure) return "failure";
  if (point.confirmation) return "confirmation";
  if (point.other_grains) return "other grains";
  return point.ended_early ? "ended early" : "search";
}

/// `measured`: readings of the laboratory by name, `noise`: from packing to packing; of all tests.
export function candidateCard(point, { search, parameters = [], inference }, measured) {
  const unit = search.misfit_unit;
  const known = (name) => measured.get(fullName(point.test, name));
  const noise = (name) => inference?.noise?.[fullName(point.test, name)];
  const free = parameters.filter((one) => one.free && point.values[one.name] !== undefined);
  const told = Object.entries(point.readings).filter(([name]) => measured.size === 0 || known(name) !== undefined);
  const misfit =
    point.misfit === undefined ? null : `${point.ended_early ? "at least " : ""}${number(point.misfit, 3)} ${unit}`;
  return element(
    "div",
    { class: "candidate" },
    element(
      "p",
      {},
      element("strong", {}, `Simulation ${point.number}`),
      ` ${kindOf(point)}${point.test ? `, test ${point.test}` : ""}, packing ${point.packing}`,
    ),
    misfit ? element("p", {}, `Misfit ${misfit}`) : null,
    point.failure ? element("p", { class: "failed" }, point.failure) : null,
    point.sketch ? sketchOf(point, search.history, measured) : null,
    free.length > 0 ? picture(point, free) : null,
    element(
      "dl",
      { class: "pairs" },
      ...Object.entries(point.values).flatMap(([name, value]) => [
        element("dt", {}, name),
        element("dd", {}, number(value)),
      ]),
      ...told.flatMap(([name, value]) => [
        element("dt", {}, words(name)),
        element(
          "dd",
          {},
          `${plusMinus(value, noise(name))} ${unitOf(name)}${known(name) !== undefined ? ` (${number(known(name))})` : ""}`,
        ),
      ]),
    ),
  );
}
