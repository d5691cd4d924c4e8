import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { Film, speedOf } from "../../../calibrate/report/page/source/film.js";

/** @typedef {import("../../../calibrate/report/page/source/content.js").FilmIndex} FilmIndex */
/** @typedef {import("../../../calibrate/report/page/source/content.js").Plane} Plane */

/** @param {number} z */
const floor = (z) => /** @type {Plane} */ ({ shape: "plane", name: "floor", point_m: [0, 0, z], normal: [0, 0, 1] });

/** @type {FilmIndex} */
const index = {
  quantum_m: 0.001,
  low_m: [-0.1, -0.2, 0.3],
  most_pull_n: 2,
  reels: [
    {
      grains: 1,
      frames: [
        { time_s: 0, phase: "fill.pour", walls: [floor(0)] },
        { time_s: 1, phase: "fill.rest" },
      ],
    },
    {
      grains: 2,
      frames: [
        { time_s: 1, phase: "step1.lift", walls: [floor(0)] },
        { time_s: 2, phase: "step1.lift" },
        { time_s: 4, phase: "step1.rest", walls: [floor(-1)] },
      ],
    },
  ],
};

/**
 * As `coded` of calibrate/report/run_recording.cpp writes them: low bytes, then high ones.
 * @param {...number} numbers
 */
const words = (...numbers) => [...numbers.map((one) => one & 0xff), ...numbers.map((one) => (one >> 8) & 0xff)];

const bytes = [
  // One grain of 12 mm that falls from a height of 1000 to one of 2 quanta, the difference modulo 2^16.
  ...words(12),
  ...[...words(5), ...words(6), ...words(1000), 10, 0, 0],
  ...[...words(0), ...words(0), ...words(2 - 1000), 256 - 10, 3, 0],
  // Two grains; x, y and z of both, their speeds, what they touch, what pulls on them.
  ...words(12, 300),
  ...[...words(100, 200), ...words(200, 300), ...words(0, 50), 0, 255, 1, 2, 255, 0],
  ...[...words(0, 0), ...words(0, 0), ...words(10, 0xffff), 0, 1, 0, 0, 1, 0],
  ...[...words(0, 100), ...words(0, 0), ...words(0, 0), 4, 0, 0, 3, 0, 0],
];

/** @param {number[]} some */
const coded = (some) => deflateSync(Uint8Array.from(some)).toString("base64");

const read = () => Film.read(index, coded(bytes));

test("a film has the places that its bytes say, each frame as a difference from the one before", async () => {
  const { parts } = await read();
  assert.deepEqual(
    parts[0].frames.map(({ places }) => places.map(([one]) => one)),
    [
      [5, 6, 1000],
      [5, 6, 2],
    ],
  );
  assert.deepEqual(
    parts[1].frames.map(({ places }) => [...places[2]]),
    [
      [0, 50],
      [10, 49],
      [10, 49],
    ],
  );
  assert.deepEqual([...parts[1].frames[2].places[0]], [100, 300]);
});

test("speeds, contacts and pulls are differences modulo 256", async () => {
  const { parts } = await read();
  const [first, second] = parts[0].frames;
  assert.deepEqual([first.speeds[0], second.speeds[0]], [10, 0]);
  assert.deepEqual([first.touching[0], second.touching[0]], [0, 3]);
  const test1 = parts[1].frames;
  assert.deepEqual([...test1[1].speeds], [0, 0]);
  assert.deepEqual([...test1[2].touching], [1, 5]);
  assert.deepEqual([...test1[1].pulls], [0, 0]);
});

test("radii are in quanta, of 16 bits", async () => {
  const { parts } = await read();
  assert.deepEqual([...parts[1].radii], [Math.fround(0.012), Math.fround(0.3)]);
});

test("walls that are left out stand as in the frame before", async () => {
  const { parts } = await read();
  assert.deepEqual(
    parts[1].frames.map(({ walls }) => walls),
    [[floor(0)], [floor(0)], [floor(-1)]],
  );
});

test("a film that ends too early is refused", async () => {
  await assert.rejects(Film.read(index, coded(bytes.slice(0, -1))), /ends too early/);
});

test("a film with bytes to spare is refused", async () => {
  await assert.rejects(Film.read(index, coded([...bytes, 0])), /goes on/);
});

test("a film whose bytes are damaged says so, and what to do", async () => {
  const text = coded(bytes);
  await assert.rejects(Film.read(index, `${text.slice(0, 8)}AAAA${text.slice(12)}`), /damaged; pastefit report/);
  await assert.rejects(Film.read(index, "%%%"), /damaged; pastefit report/);
});

test("phases stand in their order, each from its first frame to its last", async () => {
  const film = await read();
  assert.deepEqual(film.phases(), [
    { name: "fill.pour", begin: 0, end: 0 },
    { name: "fill.rest", begin: 1, end: 1 },
    { name: "step1.lift", begin: 1, end: 2 },
    { name: "step1.rest", begin: 4, end: 4 },
  ]);
  assert.deepEqual([film.begin, film.end, film.most], [0, 4, 2]);
  assert.equal(film.firstOfTest()?.time, 1);
});

test("a time lies between two frames of one part", async () => {
  const film = await read();
  const { part, one, other, share } = film.at(2.5);
  assert.equal(part, film.parts[1]);
  assert.deepEqual([one.time, other.time, share], [2, 4, 0.25]);
});

test("where one part ends and the next begins, the next is shown", async () => {
  const film = await read();
  assert.equal(film.at(1).part, film.parts[1]);
  assert.equal(film.at(0.999).part, film.parts[0]);
});

test("a time before the film is its first frame, one behind it its last", async () => {
  const film = await read();
  assert.deepEqual([film.at(-1).one.time, film.at(-1).share], [0, 0]);
  assert.deepEqual([film.at(9).one.time, film.at(9).other.time, film.at(9).share], [4, 4, 0]);
});

test("the scale of heights leaves out what is poured from above", async () => {
  const { height, touching, pull } = (await read()).extremes();
  assert.ok(Math.abs(height - 0.35) < 1e-12, `${height} m`);
  assert.equal(touching, 5);
  assert.equal(pull, 2);
});

test("a scale of heights ends at the highest grain of the test, not of the filling", async () => {
  const film = await read();
  const filling = film.frames()[0];
  filling.phase = "fill.settle"; // its grain stands at 1000 quanta
  assert.ok(Math.abs(film.extremes().height - 0.35) < 1e-12);
});

test("the box of the grains is that with which the test begins", async () => {
  const { centre, across } = (await read()).box();
  const near = (/** @type {number} */ one, /** @type {number} */ other) => assert.ok(Math.abs(one - other) < 1e-12);
  near(centre[0], 0.05);
  near(centre[1], 0.05);
  near(across, 0.1 * Math.SQRT2);
});

test("what is nearly about the axis is about the axis", async () => {
  const film = await read();
  film.low = [-0.149, -0.2, 0];
  assert.equal(film.box().centre[0], 0);
});

test("grains reach as far in the end as the farthest of them lies, along x or y", async () => {
  const reach = (await read()).reach([0, 0]);
  assert.ok(Math.abs(reach - 0.2) < 1e-12, `${reach} m`);
});

test("the code of a speed has 51 steps in each power of ten, from 0.1 mm/s", () => {
  assert.ok(Math.abs(speedOf(0) - 1e-4) < 1e-18);
  assert.ok(Math.abs(speedOf(51) - 1e-3) < 1e-15);
  assert.ok(Math.abs(speedOf(204) - 1) < 1e-12);
});
