import assert from "node:assert/strict";
import { test } from "node:test";
import { heapsOf } from "../../../calibrate/report/page/source/heaps.js";

/** @type {(by: import("../../../calibrate/report/page/source/content.js").DrawnBy, packing?: number) => any} */
const line = (by, packing) => ({ name: "", by, points: [], deviation: 0, packing });

test("the heaps of a drawing are its single runs, sheared ones too, without the mean and what was measured", () => {
  const lines = [line("apparatus"), line("run", 11), line("rejected", 12), line("simulation"), line("laboratory")];
  assert.deepEqual(
    heapsOf({ lines }).map(({ packing }) => packing),
    [11, 12],
  );
  assert.deepEqual(heapsOf({ lines: [line("simulation"), line("laboratory")] }), []);
});
