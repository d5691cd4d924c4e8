import assert from "node:assert/strict";
import { test } from "node:test";
import { boxOf, frameOf, isUpright, legendOf } from "../../../calibrate/report/page/source/drawing.js";
import { scaled } from "../../../calibrate/report/page/source/law.js";
import { edgesOf, fieldsOf, levelLegend } from "../../../calibrate/report/page/source/misfit_map.js";
import { shareOf } from "../../../calibrate/report/page/source/parameters.js";
import { sketchScale } from "../../../calibrate/report/page/source/sketch.js";
import { stripScale } from "../../../calibrate/report/page/source/strip.js";

/** @typedef {import("../../../calibrate/report/page/source/content.js").Drawing} Drawing */
/** @typedef {import("../../../calibrate/report/page/source/content.js").LawCurve} LawCurve */
/** @typedef {import("../../../calibrate/report/page/source/content.js").Length} Length */

/** @type {(one: number, other: number) => void} */
const near = (one, other) => assert.ok(Math.abs(one - other) < 1e-9, `${one} is not ${other}`);

/** @type {(part: Partial<Length>) => Length} */
const length = (part) => ({
  reading: "step1.height_mm",
  by: "laboratory",
  from: [0, 0],
  to: [0, 0],
  first: [0, 0],
  last: [0, 0],
  value: 0,
  deviation: 0,
  ...part,
});

/** @type {Drawing} */
const drawing = {
  name: "",
  x: "",
  y: "",
  to_scale: true,
  bands: [{ name: "all runs", points: [[0, -5, 20]] }],
  lines: [
    { name: "each heap", by: "run", points: [[-100, 0]], deviation: 0 },
    { name: "each heap", by: "run", points: [[100, 50]], deviation: 0 },
  ],
  lengths: [length({ from: [-150, 0], to: [-150, 95] }), length({ by: "simulation", from: [110, 0], to: [110, 90] })],
};

test("the box of a drawing holds bands, lines and lengths", () => {
  assert.deepEqual(boxOf(drawing), { x: [-150, 110], y: [-5, 95] });
});

test("a drawing to scale has as many pixels for 1 upwards as across", () => {
  const { height, scale, y, margins } = frameOf(drawing, 596);
  near(scale, (596 - margins.marginLeft - margins.marginRight) / 260);
  const upwards = (height - margins.marginTop - margins.marginBottom) / (y[1] - y[0]);
  assert.ok(Math.abs(upwards - scale) < 0.01, `${upwards} upwards, ${scale} across`);
});

test("a drawing that is not to scale begins at the ground, and keeps all below it", () => {
  /** @type {(y: number) => Drawing} */
  const above = (y) => ({ ...drawing, to_scale: false, bands: [], lengths: [], lines: lineFrom(y) });
  assert.equal(frameOf(above(30), 500).y[0], 0);
  assert.equal(frameOf(above(-30), 500).y[0], -30);
});

/** @type {(y: number) => Drawing["lines"]} */
const lineFrom = (y) => [
  {
    name: "",
    by: "run",
    deviation: 0,
    points: [
      [0, y],
      [1, 50],
    ],
  },
];

test("a length is upright where both ends have one x", () => {
  assert.ok(isUpright(length({ from: [-3, 0], to: [-3, 7] })));
  assert.ok(!isUpright(length({ from: [-3, 5], to: [3, 5] })));
});

test("lines of one name, and lengths of one origin, share an entry of the legend", () => {
  assert.deepEqual(
    legendOf(drawing).map(([, sign]) => sign),
    ["band", "line run", "line laboratory", "line simulation"],
  );
});

test("edges of fields lie half way between places, on a logarithmic axis by their ratio", () => {
  assert.deepEqual(edgesOf({ scale: "linear", places: [0, 1, 4] }), [0, 0.5, 2.5, 4]);
  edgesOf({ scale: "log", places: [1, 100, 10_000] }).forEach((edge, k) => near(edge, [1, 10, 1000, 10_000][k]));
});

test("fields of the map stand row by row", () => {
  const axis = { name: "", scale: /** @type {"linear"} */ ("linear"), lower: 0, upper: 2 };
  const fields = fieldsOf({
    x: { ...axis, places: [0, 1, 2] },
    y: { ...axis, places: [5, 6] },
    miss: [1, 2, 3, 4, 5, 6],
  });
  assert.deepEqual(fields[0], { value: 1, x: 0, y: 5, x1: 0, x2: 0.5, y1: 5, y2: 5.5 });
  assert.deepEqual(fields[5], { value: 6, x: 2, y: 6, x1: 1.5, x2: 2, y1: 5.5, y2: 6 });
});

test("every colour of the map has its words", () => {
  const legend = levelLegend();
  assert.equal(legend.length, 6);
  assert.match(legend[0][0], /^below 1 /);
  assert.equal(legend[3][0], "3 to 5");
  assert.deepEqual(legend[5], ["above 8", "field shade-5"]);
});

test("a parameter lies between its bounds as its scale has it, and never beyond", () => {
  const linear = { lower: 0, upper: 4, scale: /** @type {"linear"} */ ("linear") };
  const logarithmic = { lower: 1, upper: 100, scale: /** @type {"log"} */ ("log") };
  near(shareOf(linear, 1), 0.25);
  near(shareOf(logarithmic, 10), 0.5);
  assert.equal(shareOf(linear, -1), 0);
  assert.equal(shareOf(logarithmic, 1000), 1);
});

test("a strip goes from the smallest of its values to the largest, and one value is in the middle", () => {
  const x = stripScale([3, 1, 2]);
  assert.deepEqual([x(1), x(2), x(3)], [6, 80, 154]);
  assert.equal(stripScale([7, 7])(7), 80);
});

test("the sketch of a heap is to scale, and stands on the ground", () => {
  const at = sketchScale(
    [
      [-100, 0],
      [0, 50],
      [100, 0],
    ],
    true,
  );
  const [left, ground] = at([-100, 0]);
  const [middle, top] = at([0, 50]);
  near(middle - left, 100);
  near(ground - top, 50);
  near(ground, 80);
});

test("the sketch of a curve fills its frame, with zero in it", () => {
  const at = sketchScale(
    [
      [1, 200],
      [2, 400],
    ],
    false,
  );
  assert.deepEqual(at([0, 0]), [10, 80]);
  assert.deepEqual(at([2, 400]), [210, 10]);
});

test("the sketch of a curve that goes down keeps zero in it", () => {
  const at = sketchScale(
    [
      [-2, -400],
      [-1, -200],
    ],
    false,
  );
  assert.deepEqual(at([-2, -400]), [10, 80]);
  assert.deepEqual(at([0, 0]), [210, 10]);
});

test("a sketch of nothing but zero is drawn", () => {
  for (const heap of [true, false]) assert.ok(sketchScale([[0, 0]], heap)([0, 0]).every(Number.isFinite));
});

test("overlaps are in millimetres where bridges reach farther than half of one", () => {
  /** @type {(gap: number) => LawCurve[]} */
  const law = (gap) => [{ name: "fitted", role: "fitted", points: [[-gap, -1]] }];
  assert.equal(scaled(law(500)).unit, "\u00b5m");
  const { unit, curves } = scaled(law(7000));
  assert.equal(unit, "mm");
  assert.deepEqual(curves[0].points, [[-7, -1]]);
});
