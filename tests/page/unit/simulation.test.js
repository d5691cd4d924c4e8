import assert from "node:assert/strict";
import { test } from "node:test";
import { readingNames } from "../../../calibrate/report/page/source/scatter.js";
import {
  bestOf,
  bestSoFar,
  kindOf,
  kindsIn,
  placed,
  readingsOf,
} from "../../../calibrate/report/page/source/simulation.js";

/** @typedef {import("../../../calibrate/report/page/source/content.js").Simulation} Simulation */

/** @type {(number: number, part?: Partial<Simulation>) => Simulation} */
const simulation = (number, part = {}) => ({ number, packing: 1001, values: {}, readings: {}, ...part });

test("a failure is a failure, whatever else a simulation was for", () => {
  assert.equal(kindOf(simulation(1, { failure: "unstable", confirmation: true })), "failure");
  assert.equal(kindOf(simulation(1, { confirmation: true })), "confirmation");
  assert.equal(kindOf(simulation(1, { other_grains: true })), "other grains");
  assert.equal(kindOf(simulation(1, { ended_early: true })), "ended early");
  assert.equal(kindOf(simulation(1)), "search");
});

test("the legend has the kinds that there are, in one order", () => {
  const history = [simulation(1, { failure: "unstable" }), simulation(2), simulation(3, { ended_early: true })];
  assert.deepEqual(kindsIn(history), ["search", "ended early", "failure"]);
});

test("what has no misfit is drawn above all others, and no misfit below a fiftieth of what is asked for", () => {
  const points = placed({
    history: [simulation(1, { misfit: 40 }), simulation(2, { misfit: 0 }), simulation(3, { failure: "unstable" })],
    misfit_asked: 5,
  });
  assert.deepEqual(
    points.map(({ at }) => at),
    [40, 0.1, 64],
  );
});

test("without any misfit all is drawn above what is asked for", () => {
  assert.equal(placed({ history: [simulation(1)], misfit_asked: 5 })[0].at, 8);
  assert.equal(placed({ history: [simulation(1)] })[0].at, 1.6);
});

test("the best so far counts whole runs of the search only", () => {
  const points = placed({
    history: [
      simulation(1, { misfit: 9 }),
      simulation(2, { misfit: 1, ended_early: true }),
      simulation(3, { misfit: 12 }),
      simulation(4, { misfit: 4 }),
      simulation(5, { misfit: 2, confirmation: true }),
      simulation(6),
    ],
  });
  assert.deepEqual(bestSoFar(points), [
    { number: 1, at: 9 },
    { number: 3, at: 9 },
    { number: 4, at: 4 },
  ]);
});

test("a confirmed run is shown to begin with, else the best whole one, else the first", () => {
  const early = simulation(1, { misfit: 0.1, ended_early: true });
  const good = simulation(3, { misfit: 2 });
  assert.equal(bestOf([early, simulation(2, { misfit: 5 }), good, simulation(4, { misfit: 2 })]), good);
  const confirmed = simulation(5, { misfit: 9, confirmation: true });
  assert.equal(bestOf([early, good, confirmed]), confirmed);
  assert.equal(bestOf([early, simulation(6)]), early);
});

test("readings have the names that they have among all tests", () => {
  const readings = { "step1.height_mm": 150 };
  assert.deepEqual([...readingsOf(simulation(1, { readings }))], [["step1.height_mm", 150]]);
  assert.deepEqual([...readingsOf(simulation(1, { readings, test: "plate" }))], [["plate/step1.height_mm", 150]]);
});

test("of the readings those stand first that were fitted, then measured ones, those of the filling last", () => {
  const readings = { "fill.mass_kg": 12, "step1.slump_mm": 140, "step1.spread_mm": 400, "step1.height_mm": 160 };
  const reading = { simulated: 1, simulated_standard_deviation: 0, packings: [] };
  const test1 = { name: "", readings: [{ ...reading, name: "step1.height_mm", weight: 1 }] };
  const content = /** @type {import("../../../calibrate/report/page/source/content.js").Content} */ (
    /** @type {unknown} */ ({
      tests: [test1],
      search: { measured: { "step1.height_mm": 150, "step1.spread_mm": 390 } },
    })
  );
  assert.deepEqual(readingNames([simulation(1, { readings })], content), [
    "step1.height_mm",
    "step1.spread_mm",
    "step1.slump_mm",
    "fill.mass_kg",
  ]);
});
