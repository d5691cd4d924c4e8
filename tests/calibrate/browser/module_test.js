// Tests of the module of the browser in Node.
//
// usage: node module_test.js FOLDER_OF_MODULE PROGRAM
const assert = require("assert");
const childProcess = require("child_process");
const fs = require("fs");
const os = require("os");
const path = require("path");
const test = require("node:test");
const { load, calibrate, ok } = require("./module.js");

const [folder, program] = process.argv.slice(2);

const lab = {
  format: "pastefit-lab-1",
  title: "Coarse grains",
  provenance: { source: "made up", licence: "Apache-2.0", notes: "", twin: false },
  apparatus: { preset: "abrams", lift_velocity_mm_s: 100 },
  material: { bulk_density_kg_m3: 2300 },
  grains: { distribution: "mono", radius_mm: 18 },
  measurements: { "step1.height_mm": { value: 150, standard_deviation: 7.5 } },
};
const study = {
  format: "pastefit-study-1",
  title: "Coarse grains, strength alone",
  lab: "lab.json",
  contact: { formation: "film", rolling_model: "spring_dashpot", friction_basis: "total" },
  parameters: {
    strength_pa: { free: [300, 40000], scale: "log" },
    friction: { value: 0.15 },
    rolling_friction: { value: 0.02 },
  },
  search: {
    screening: 3, budget_simulations: 16, packings: 1, confirmation_packings: 2, examination_simulations: 2,
    tolerance_mm: 40, rejected_share: 1, seed: 1,
  },
};
const texts = { lab: JSON.stringify(lab), study: JSON.stringify(study) };

function run(...words) {
  return childProcess.spawnSync(program, words, { encoding: "utf8" });
}

/** With the kernels of four lanes, if this type of processor has a choice. */
function runInFourLanes(...words) {
  const env = { ...process.env, ...(process.arch === "x64" ? { PASTEFIT_KERNELS: "sse2" } : {}) };
  return childProcess.spawnSync(program, words, { encoding: "utf8", env });
}

/** A folder with these files. */
function desk(files) {
  const at = fs.mkdtempSync(path.join(os.tmpdir(), "pastefit-browser-"));
  for (const [name, text] of Object.entries(files)) fs.writeFileSync(path.join(at, name), text);
  return at;
}

test("it says which engine it is", async () => {
  const call = await load(folder);
  const version = ok(call("version"));
  assert.strictEqual(version.kernels, "SIMD128");
  assert.match(version.engine, /^pastefit .* engine [0-9a-f]{16}$/);
});

test("a sheet becomes the files that the program writes", async () => {
  const call = await load(folder);
  const files = ok(call("new", { title: "C25", mould: "abrams", density: "2350", slump: "180, 175, 190", spread: 330 }));
  const at = desk({});
  const made = run("new", at, "--title", "C25", "--mould", "abrams", "--density", "2350", "--slump", "180, 175, 190",
    "--spread", "330");
  assert.strictEqual(made.status, 0, made.stderr);
  assert.strictEqual(files.lab, fs.readFileSync(path.join(at, "lab.json"), "utf8"));
  assert.strictEqual(files.study, fs.readFileSync(path.join(at, "study.json"), "utf8"));
});

test("a faulty sheet gives the faults of the program", async () => {
  const call = await load(folder);
  const { faults } = call("new", { mould: "abrams", density: "23", slump: "1800", spread: "wide" });
  const said = run("new", desk({}), "--mould", "abrams", "--density", "23", "--slump", "1800", "--spread", "wide").stderr;
  assert.ok(faults.length >= 1);
  const flat = said.replace(/\s+/g, " ");
  for (const fault of faults) assert.ok(flat.includes(`${fault.where}: ${fault.what}; ${fault.remedy}`), JSON.stringify(fault) + said);
});

test("faults of a study name the file and the place", async () => {
  const call = await load(folder);
  const bad = { ...lab, material: { bulk_density_kg_m3: "heavy" } };
  const { faults } = call("open", { ...texts, lab: JSON.stringify(bad) });
  assert.match(faults[0].where, /^lab.json: material.bulk_density_kg_m3$/);
  assert.ok(call("suggest", { count: 1 }).faults);
});

test("a calibration gives a card that the program simulates with the same bits, and resumes from its records", async () => {
  const call = await load(folder);
  const opened = ok(call("open", texts));
  assert.strictEqual(opened.budget, 16);
  const records = calibrate(call);
  const progress = ok(call("progress"));
  assert.ok(progress.finished && progress.simulations <= 16);
  assert.ok(Math.abs(progress.readings[0].simulated - 150) < 40);
  const result = ok(call("result"));
  assert.strictEqual(result.status, "confirmed", result.reason);
  assert.ok(result.report.includes("</html>"));

  const at = desk({ "card.json": result.card });
  const shown = run("show", path.join(at, "card.json"));
  assert.strictEqual(shown.status, 0, shown.stderr);
  const checked = runInFourLanes("check", path.join(at, "card.json"));
  assert.strictEqual(checked.status, 0, checked.stdout + checked.stderr);
  assert.match(checked.stdout, /bits: same/);

  const again = await load(folder);
  ok(again("open", { ...texts, stored: records }));
  let simulated = 0;
  calibrate(again, 3, () => ++simulated);
  assert.strictEqual(simulated, 0);
  assert.deepStrictEqual(JSON.parse(ok(again("result")).card).material, JSON.parse(result.card).material);

  const deck = ok(call("export", { card: result.card, target: "lammps" }));
  const names = deck.files.map((file) => file.name);
  assert.ok(names.includes("in.slump") && names.includes("style/core/laws/contact.h"), names.join(" "));
  const exported = runInFourLanes("export", path.join(at, "card.json"), "--to", "lammps", "--out", path.join(at, "deck"));
  assert.strictEqual(exported.status, 0, exported.stderr);
  const ofAnyBuild = (text) => text.replace(/engine [0-9a-f]{16}/g, "engine");
  for (const { name, text } of deck.files.filter((file) => file.name !== "NOTES.txt"))  // they name the card's folder
    assert.strictEqual(ofAnyBuild(text), ofAnyBuild(fs.readFileSync(path.join(at, "deck", name), "utf8")), name);
});

test("a calibration that is stopped reports the best so far", async () => {
  const call = await load(folder);
  ok(call("open", texts));
  for (const one of ok(call("suggest", { count: 2 })))
    ok(call("ingest", [{ id: one.id, answer: ok(call("simulate", { task: one.task })).answer }]));
  ok(call("stop"));
  const result = ok(call("result"));
  assert.strictEqual(result.status, "stopped");
  assert.ok(result.card);
});
