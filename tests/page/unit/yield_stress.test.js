import assert from "node:assert/strict";
import { test } from "node:test";
import { comparedWords } from "../../../calibrate/report/page/source/yield_stress.js";

test("a yield stress beside a measured one is a multiple of it and so many deviations above or below", () => {
  assert.equal(comparedWords({ ratio: 1.56, deviations: 5.61 }), "\u00d7 1.6 (+5.6 deviations)");
  assert.equal(comparedWords({ ratio: 0.5, deviations: -4 }), "\u00d7 0.5 (\u22124 deviations)");
});

test("a yield stress beside none that was measured is compared with nothing", () => {
  assert.equal(comparedWords({}), "");
});
