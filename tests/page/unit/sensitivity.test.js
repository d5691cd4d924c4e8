import assert from "node:assert/strict";
import { test } from "node:test";
import { changeWords } from "../../../calibrate/report/page/source/sensitivity.js";

test("a change is told as a share of the value, up or down", () => {
  assert.equal(changeWords({ from: 3117, to: 3740.4 }), "+20 %");
  assert.equal(changeWords({ from: 1, to: 0.8 }), "\u221220 %");
  assert.equal(changeWords({ from: -0.5, to: -0.4 }), "+20 %");
});

test("a change of nothing is told by where it leads", () => {
  assert.equal(changeWords({ from: 0, to: 0.1 }), "to 0.1");
});
