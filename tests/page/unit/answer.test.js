import assert from "node:assert/strict";
import { test } from "node:test";
import { dateWords } from "../../../calibrate/report/page/source/certificate.js";
import { endsInWords } from "../../../calibrate/report/page/source/parameters.js";
import { phaseWords } from "../../../calibrate/report/page/source/player.js";
import { conditionsOf } from "../../../calibrate/report/page/source/provenance.js";
import { isMeasured, judged } from "../../../calibrate/report/page/source/readings.js";
import { drawingsOf, filmWords, lasts } from "../../../calibrate/report/page/source/tests.js";
import { answerLines, answerOf, facts, verdictKind } from "../../../calibrate/report/page/source/verdict.js";

/** @typedef {import("../../../calibrate/report/page/source/content.js").Content} Content */
/** @typedef {import("../../../calibrate/report/page/source/content.js").FilmIndex} FilmIndex */
/** @typedef {import("../../../calibrate/report/page/source/content.js").MeasuredReading} MeasuredReading */
/** @typedef {import("../../../calibrate/report/page/source/content.js").Test} Test */
/** @typedef {import("../../../calibrate/report/page/source/content.js").Verdict} Verdict */

/** @type {(part?: Partial<Verdict>) => Verdict} */
const verdictWith = (part = {}) => ({
  words: "Not certain: too near to tell",
  reservations: [],
  meets_laboratory: false,
  misfit: 1.5,
  fresh: true,
  packings: [1011, 1012],
  ...part,
});

/** @type {(part?: Partial<MeasuredReading>) => MeasuredReading} */
const reading = (part = {}) => ({
  name: "step1.height_mm",
  simulated: 152,
  simulated_standard_deviation: 3,
  standard_error: 1,
  packings: [],
  measured: 150,
  standard_deviation: 7.5,
  repeats: 3,
  weight: 1,
  tolerance: 5,
  ...part,
});

/** @type {(part?: Partial<Test>) => Test} */
const testWith = (part = {}) => ({
  name: "",
  kind: "",
  hold_out: false,
  source: "",
  notes: "",
  licence: "",
  twin: false,
  lab_file: "lab.json",
  lab_hash: "",
  conditions: "",
  remarks: "",
  readings: [reading()],
  drawings: [],
  ...part,
});

/** @type {(part?: Partial<Content>) => Content} */
const contentWith = (part = {}) => ({
  program: "",
  command: "",
  missing: [],
  under_way: false,
  search: {
    program: "",
    wall_s: 0,
    measured: {},
    laboratory: {},
    history: [],
    map: null,
    error_unit: "mm",
    misfit_asked: 5,
  },
  ...part,
});

test("without a verdict a calibration is under way, or has no answer", () => {
  assert.equal(verdictKind({ under_way: true }), "goes");
  assert.equal(verdictKind({ under_way: false }), "none");
});

test("a material that meets the laboratory does so with reservations, where there are some", () => {
  const meets = { meets_laboratory: true, misfit: 0.5 };
  assert.equal(verdictKind({ under_way: false, verdict: verdictWith(meets) }), "meets");
  const reservations = ["one heap sheared off"];
  assert.equal(verdictKind({ under_way: false, verdict: verdictWith({ ...meets, reservations }) }), "reserved");
});

test("a misfit beyond what is asked for fails only on fresh packings", () => {
  assert.equal(verdictKind({ under_way: false, verdict: verdictWith() }), "fails");
  assert.equal(verdictKind({ under_way: false, verdict: verdictWith({ fresh: false }) }), "open");
  assert.equal(verdictKind({ under_way: false, verdict: verdictWith({ misfit: 0.9 }) }), "open");
  const sheared = verdictWith({ misfit: 0.9, refuted: true });
  assert.equal(verdictKind({ under_way: false, verdict: sheared }), "fails");
});

test("heaps that a laboratory would reject are named in the heading, where every reading is met", () => {
  const unconfirmed = "6 of 8 heaps sheared off, 1 in 5 allowed";
  const verdict = verdictWith({ misfit: 0.4, refuted: true, only_heaps_refute: true, unconfirmed });
  const { kind, sign, heading } = answerOf(contentWith({ verdict }));
  assert.deepEqual(
    [kind, sign, heading],
    ["rejected", "!", `The readings are within their tolerances, but ${unconfirmed}`],
  );
});

test("the sentence of an answer does not repeat its heading", () => {
  const content = contentWith({ verdict: verdictWith({ fresh: false }) });
  assert.deepEqual(answerOf(content), {
    kind: "open",
    sign: "?",
    heading: "Not certain",
    sentence: "too near to tell",
  });
});

test("the facts say the misfit in its unit, and how many packings were random", () => {
  const list = facts(contentWith({ verdict: verdictWith({ packings: [1] }) }));
  assert.deepEqual(list[0], ["7.5 mm", "largest difference from the laboratory; allowed: 5"]);
  assert.deepEqual(list[1], ["1", "random packing that the search had not seen"]);
});

test("while a search goes on the facts say its best whole run", () => {
  const { search } = contentWith();
  const one = { packing: 1, values: {}, readings: {} };
  const history = [
    { ...one, number: 1, misfit: 30 },
    { ...one, number: 2, misfit: 12.34 },
    { ...one, number: 3, misfit: 1, ended_early: true },
    { ...one, number: 4 },
  ];
  const list = facts(contentWith({ search: { ...search, history, wall_s: 30 } }));
  assert.equal(list[0][0], "12.3 mm");
  assert.deepEqual(list[1], ["4", "simulations kept, 30 s from start to end"]);
});

test("each reading is met, missed or predicted, and parameters are fitted or open", () => {
  const readings = [
    reading(),
    reading({ name: "step1.spread_mm", measured: 300 }),
    reading({ name: "step1.width_mm", weight: 0 }),
  ];
  /** @type {import("../../../calibrate/report/page/source/content.js").Parameter[]} */
  const parameters = [
    { name: "strength_pa", free: true, value: 5329.9, interval: [4000, 7000] },
    { name: "friction", free: true, value: 0.15, not_identified: "any value fits" },
    { name: "restitution", free: false, value: 0.3 },
  ];
  const tests = [testWith({ readings }), testWith({ name: "held", hold_out: true })];
  const content = contentWith({ verdict: verdictWith(), tests, parameters, interval_level: 0.95 });
  assert.deepEqual(answerLines(content), [
    ["Fitted", ["strength 5330 Pa (95 %: 4000 to 7000)"]],
    ["Met", ["step 1, height 152.0 \u00b1 1.0 mm, measured 150.0 \u00b1 7.5"]],
    ["Missed", ["step 1, spread 152.0 \u00b1 1.0 mm, measured 300.0 \u00b1 7.5"]],
    [
      "Predicted",
      [
        "step 1, width 152.0 \u00b1 1.0 mm, measured 150.0 \u00b1 7.5",
        "held: step 1, height 152.0 \u00b1 1.0 mm, measured 150.0 \u00b1 7.5",
      ],
    ],
    ["Open", ["friction 0.15: one choice among many that the readings allow"]],
  ]);
});

test("an end of an interval that the study's bound sets is marked", () => {
  const one = { name: "strength_pa", free: true, value: 50, interval: /** @type {[number, number]} */ ([13.2, 526]) };
  assert.equal(endsInWords(one), "13.2 to 526");
  assert.equal(endsInWords({ ...one, at_bounds: [true, false] }), "13.2 (the study's bound) to 526");
});

test("without intervals nothing is said to be open", () => {
  /** @type {import("../../../calibrate/report/page/source/content.js").Parameter[]} */
  const parameters = [{ name: "friction", free: true, value: 0.15 }];
  const lines = answerLines(contentWith({ verdict: verdictWith(), parameters, interval_level: 0 }));
  assert.deepEqual(lines, [["Fitted", ["friction 0.15"]]]);
});

test("a reading is marginal where its error reaches beyond what is allowed", () => {
  const kind = (/** @type {Partial<MeasuredReading>} */ part) => judged(reading(part), testWith())[0];
  assert.equal(kind({}), "met");
  assert.equal(kind({ simulated: 154.5 }), "marginal");
  assert.equal(kind({ simulated: 155.5 }), "missed");
  assert.equal(kind({ simulated: 144.9 }), "missed");
  assert.equal(kind({ simulated: 154.5, standard_error: undefined }), "met");
  assert.equal(kind({ weight: 0 }), "unfitted");
  assert.deepEqual(judged(reading(), { hold_out: true }), ["unfitted", "predicted"]);
});

test("a reading of zero is measured", () => {
  assert.ok(isMeasured(reading({ measured: 0 })));
  const { name, simulated, simulated_standard_deviation, packings } = reading();
  assert.ok(!isMeasured({ name, simulated, simulated_standard_deviation, packings }));
});

/** @type {(end: number) => FilmIndex} */
const film = (end) => ({
  quantum_m: 1,
  low_m: [0, 0, 0],
  most_pull_n: 0,
  reels: [
    {
      grains: 1,
      frames: [
        { time_s: 1, phase: "" },
        { time_s: end, phase: "" },
      ],
    },
  ],
});

test("a film of two pictures, one after the other, is none", () => {
  assert.ok(!lasts(film(1.02)));
  assert.ok(lasts(film(1.05)));
  assert.match(filmWords(testWith({ film: film(1.01) })), /there is none/);
});

test("it is said whether the film is of the card's own run", () => {
  const shown = { packing: 1011, program: "pastefit 0.1.0", same_as_card: true };
  assert.match(filmWords(testWith({ film: film(3), run_shown: shown })), /packing 1011.*the same run/);
  const other = { ...shown, same_as_card: false };
  assert.match(filmWords(testWith({ film: film(3), run_shown: other })), /not the card's.*by pastefit 0\.1\.0/);
  assert.match(filmWords(testWith({ run_shown: null })), /not simulated/);
});

test("simulated lengths of a drawing have the errors of their readings, the laboratory's keep their deviations", () => {
  /** @type {import("../../../calibrate/report/page/source/content.js").Length} */
  const length = {
    reading: "step1.height_mm",
    by: "laboratory",
    from: [0, 0],
    to: [0, 1],
    first: [0, 0],
    last: [0, 1],
    value: 150,
    deviation: 7.5,
  };
  const lengths = [length, { ...length, by: /** @type {"simulation"} */ ("simulation"), deviation: 0 }];
  const drawing = { name: "", x: "", y: "", to_scale: true, bands: [], lines: [], lengths };
  const [{ lengths: told }] = drawingsOf(testWith({ drawings: [drawing] }));
  assert.deepEqual(
    told.map(({ deviation }) => deviation),
    [7.5, 1],
  );
});

test("phases are told by stage and what happens in it", () => {
  assert.equal(phaseWords("fill.pour"), "filling: pour");
  assert.equal(phaseWords("step1.rest"), "step 1: rest");
  assert.equal(phaseWords("step12.rest"), "step 12: rest");
  assert.equal(phaseWords("press"), "press");
});

test("conditions stand on one line", () => {
  const conditions = "  mould      base 200 mm\n  grains  about 550\n";
  assert.equal(conditionsOf(testWith({ conditions })), "mould base 200 mm; grains about 550");
});

test("a date is that of the place, as ISO 8601 writes it", () => {
  assert.equal(dateWords(new Date(2026, 0, 5, 23, 59)), "2026-01-05");
});
