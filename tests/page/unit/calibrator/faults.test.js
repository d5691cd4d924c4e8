import assert from "node:assert/strict";
import { test } from "node:test";
import { fieldOf, placeToConfirm } from "../../../../calibrate/browser/page/source/faults.js";

/** @param {string} where */
const fault = (where, remedy = "") => ({ where, what: "is wrong", remedy });

test("a fault is shown at the field that its place is about", () => {
  const fields = {
    "--mould": "mould",
    mould: "mould",
    "apparatus.preset": "mould",
    "--density": "density",
    density: "density",
    "material.bulk_density_kg_m3": "density",
    grains: "grains",
    "grains.smallest_mm": "grains",
    "--law foo": "law",
    "--for foo": "for",
    "yield stress": "yield-stress",
    "reading slump": "slump",
    "reading height-after": "height-after",
    "--slump": "slump",
    readings: "slump",
    "sd slump": "sd.slump",
    "sd height-after": "sd.height-after",
    "measurements.step1.spread_mm.value": "spread",
    "measurements.step1.spread_mm.standard_deviation": "sd.spread",
    "measurements.step2.height_mm": "height2",
    "measurements.after_drops.spread_mm.repeats[1]": "flow",
    "--drops": "drops",
    "apparatus.drop_plate.drops": "drops",
    seed: "seed",
    "search.budget_simulations": "budget",
  };
  for (const [where, field] of Object.entries(fields)) assert.equal(fieldOf(fault(where), {}), field, where);
});

test("a height that was typed as a slump is shown at the slump", () => {
  const where = "measurements.step1.height_mm.value";
  assert.equal(fieldOf(fault(where), { slump: "180" }), "slump");
  assert.equal(fieldOf(fault(where), { height: "120" }), "height");
  assert.equal(fieldOf(fault("measurements.step1.slump_mm"), { height: "120" }), "height");
});

test("a fault of no field has none", () => {
  for (const where of ["", "parameters.strength_pa", "sd nothing", "reading nothing"])
    assert.equal(fieldOf(fault(where), {}), null, where);
});

test("a value that only looks wrong can be confirmed by its place", () => {
  assert.equal(placeToConfirm(fault("mould", "if it stands upside down, say --confirm mould")), "mould");
  const remedy = 'leave it out; if it is right, say "confirmed": ["measurements.step1.slump_mm"]';
  assert.equal(placeToConfirm(fault("measurements.step1.slump_mm", remedy)), "measurements.step1.slump_mm");
  assert.equal(placeToConfirm(fault("density", "one number")), null);
});
