import assert from "node:assert/strict";
import { test } from "node:test";
import { sayer } from "../../../calibrate/report/page/source/sentences.js";

const said = sayer(["plate/step1.height_mm", "rupture_gap_ratio", "step1.height_mm", "step1.height", "strength_pa"]);

test("sentences of the program name readings and parameters as people do, with units", () => {
  assert.equal(said("step1.height_mm is off by 7.49 mm"), "step 1, height [mm] is off by 7.49 mm");
  assert.equal(
    said("Values of plate/step1.height_mm: 110 to 282."),
    "Values of plate: step 1, height [mm]: 110 to 282.",
  );
  assert.equal(said("strength_pa lies above 737."), "strength [Pa] lies above 737.");
  assert.equal(said("strength_pa, rupture_gap_ratio."), "strength [Pa], rupture gap ratio.");
});

test("keys that are others, files and options are left as they are", () => {
  const others =
    "raise search.budget_simulations; see strength_pascal, my/strength_pa.json and table_rupture_gap_ratio";
  assert.equal(said(others), others);
});
