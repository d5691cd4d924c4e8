import assert from "node:assert/strict";
import { test } from "node:test";
import { faultsOfNumbers, presetsOf, requestOf, withUnit } from "../../../../calibrate/browser/page/source/sheet.js";
import { sheetOf } from "../../../../calibrate/browser/page/source/saved_sheet.js";
import { typedMould } from "../../../../calibrate/browser/page/source/mould.js";

const mould = { base_diameter_mm: 200, top_diameter_mm: 100, height_mm: 300 };
/** @typedef {import("../../../../calibrate/browser/page/source/sheet.js").Preset} Preset */

/** @type {(name: string, drops?: number, flank?: boolean) => Preset} */
const preset = (name, drops = 0, flank = false) => ({ name, title: "", mould, drops, flank, caution: "" });
const presets = [
  preset("abrams"),
  preset("hinged-plate", 1),
  preset("astm-c1437", 25),
  preset("lifted-cylinder", 0, true),
];
const usual = { mould: "abrams", density: "2350", densityUnit: "kg/m3", lengthUnit: "mm", for: "lammps" };

test("a sheet is asked for as it was typed", () => {
  const values = { ...usual, title: " a mix ", slump: "180, 175, 190", spread: "330", grains: "6, 10", law: "" };
  assert.deepEqual(requestOf(values, presets, []), {
    mould: "abrams",
    density: "2350",
    title: "a mix",
    for: "lammps",
    grains: "6, 10",
    slump: "180, 175, 190",
    spread: "330",
    sd: {},
    confirm: [],
  });
});

test("a chosen unit is added to lengths and density, and not where a unit was typed", () => {
  assert.equal(withUnit("7 1/4, 7", "in", "mm"), "7 1/4, 7 in");
  assert.equal(withUnit("36 cm", "in", "mm"), "36 cm");
  assert.equal(withUnit("110 %", "in", "mm"), "110 %");
  assert.equal(withUnit("330", "mm", "mm"), "330");
  assert.equal(withUnit("  ", "in", "mm"), "");
  const request = requestOf(
    { ...usual, densityUnit: "lb/ft3", density: "145", lengthUnit: "in", slump: "7" },
    presets,
    [],
  );
  assert.deepEqual([request.density, request.slump], ["145 lb/ft3", "7 in"]);
});

test("only moulds that a sheet may name are offered", () => {
  const known = { title: "", sheet: true, drops: 1, caution: "mind", apparatus: { mould, reading: { flank: {} } } };
  const offered = presetsOf([
    { ...known, name: "a" },
    { ...known, name: "b", sheet: false },
  ]);
  assert.deepEqual(offered, [{ name: "a", title: "a", mould, drops: 1, flank: true, caution: "mind" }]);
});

test("only the readings of the mould are asked for", () => {
  const all = { ...usual, slump: "1", height2: "2", flow: "3", "height-after": "4", angle: "5", drops: "15" };
  const readings = (/** @type {string} */ name) =>
    Object.keys(requestOf({ ...all, mould: name }, presets, [])).filter((key) => key in all && !(key in usual));
  assert.deepEqual(readings("abrams"), ["slump"]);
  assert.deepEqual(readings("hinged-plate"), ["drops", "slump", "height2"]);
  assert.deepEqual(readings("astm-c1437"), ["drops", "slump", "flow", "height-after"]);
  assert.deepEqual(readings("lifted-cylinder"), ["angle"]);
});

test("standard deviations and confirmed places go with their readings", () => {
  const values = { ...usual, lengthUnit: "cm", slump: "18", "sd.slump": "1", "sd.height2": "9" };
  const { sd, confirm } = requestOf(values, presets, ["material.bulk_density_kg_m3"]);
  assert.deepEqual(sd, { slump: "1 cm" });
  assert.deepEqual(confirm, ["material.bulk_density_kg_m3"]);
});

test("a mould of one's own is three lengths in the unit of all", () => {
  const values = { ...usual, mould: "own", base: "8", top: "4", moulded: "12", lengthUnit: "in" };
  assert.equal(requestOf(values, presets, []).mould, "8/4/12 in");
  assert.deepEqual(typedMould(values), { base_diameter_mm: 203.2, top_diameter_mm: 101.6, height_mm: 12 * 25.4 });
  assert.equal(typedMould({ ...values, top: "" }), null);
});

test("a law that the program has not is not asked for", () => {
  assert.equal(requestOf({ ...usual, for: "yade", law: "epa" }, presets, []).law, undefined);
  assert.equal(requestOf({ ...usual, for: "edem", law: "epa" }, presets, []).law, "epa");
});

test("what is no whole number is a fault at its field", () => {
  const texts = { wholeNumber: "is none", wholeNumberRemedy: "e.g. {example}" };
  const faults = faultsOfNumbers({ seed: "1.5", budget: "", drops: "-3" }, texts);
  assert.deepEqual(faults, [
    { where: "drops", what: "is none", remedy: "e.g. 15" },
    { where: "seed", what: "is none", remedy: "e.g. 1" },
  ]);
  assert.deepEqual(faultsOfNumbers({ seed: " 7 ", budget: "150" }, texts), []);
});

test("a folder's files are told apart by their format, in any order", () => {
  const lab = '// a comment\n{"format": "pastefit-lab-1"}';
  const study = '{"format" : "pastefit-study-1"}';
  assert.deepEqual(sheetOf([study, lab]), { lab, study });
  assert.equal(sheetOf([lab]), "filesMissing");
  assert.equal(sheetOf([lab, lab, study]), "filesTwice");
  assert.equal(sheetOf([]), "filesMissing");
});
