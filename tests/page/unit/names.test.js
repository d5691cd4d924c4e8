import assert from "node:assert/strict";
import { test } from "node:test";
import { fullName, unitOf, withUnit, words, wordsAndUnit } from "../../../calibrate/report/page/source/names.js";

test("the unit of a name is what it ends with", () => {
  assert.equal(unitOf("step1.height_mm"), "mm");
  assert.equal(unitOf("shear.stress_pa"), "Pa");
  assert.equal(unitOf("fill.mass_kg"), "kg");
  assert.equal(unitOf("tilted.spin_rad_s"), "rad/s");
  assert.equal(unitOf("viscosity_pa_s"), "Pa s");
  assert.equal(unitOf("step1.angle_of_repose_deg"), "\u00b0");
  assert.equal(unitOf("friction"), "");
});

test("a name of a share or a ratio has no unit", () => {
  for (const name of ["step1.spilled_share", "fill.solid_fraction", "rupture_gap_ratio"])
    assert.equal(unitOf(name), "", name);
});

test("words of a name have no unit, underscore or dot", () => {
  assert.equal(words("plate/step1.height_mm"), "plate: step 1, height");
  assert.equal(words("tilted.rebound_height_mm"), "tilted, rebound height");
  assert.equal(words("pellet.dynamic_yield_strength_pa"), "pellet, dynamic yield strength");
  assert.equal(words("step12.height_mm"), "step 12, height");
});

test("a parameter is called what people call it", () => {
  const names = ["strength_pa", "youngs_modulus_pa", "poissons_ratio", "pull_off_pa", "mould_rolling_friction"];
  assert.deepEqual(names.map(wordsAndUnit), [
    "strength [Pa]",
    "Young's modulus [Pa]",
    "Poisson's ratio",
    "pull-off [Pa]",
    "mould rolling friction",
  ]);
  assert.equal(withUnit("3.2", "viscosity_pa_s"), "3.2 Pa s");
  assert.equal(withUnit("0.3", "friction"), "0.3");
});

test("a unit stands in brackets behind the words, where there is one", () => {
  assert.equal(wordsAndUnit("step1.height_mm"), "step 1, height [mm]");
  assert.equal(wordsAndUnit("fill.solid_fraction"), "fill, solid fraction");
});

test("the name of a reading begins with its test where there are several", () => {
  assert.equal(fullName("plate", "step1.height_mm"), "plate/step1.height_mm");
  assert.equal(fullName("", "step1.height_mm"), "step1.height_mm");
  assert.equal(fullName(undefined, "step1.height_mm"), "step1.height_mm");
});
