import assert from "node:assert/strict";
import { test } from "node:test";
import { Cover } from "../../../calibrate/report/page/source/cover.js";

// A camera in the origin that looks down -z, with a right angle across and upwards; matrices column by column.
const camera = {
  matrixWorldInverse: { elements: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
  projectionMatrix: { elements: [1, 0, 0, 0, 0, 1] },
};

/**
 * The numbers of the grains that are drawn, the nearest first.
 * @param {[x: number, y: number, z: number, radius: number][]} grains
 * @param {import("../../../calibrate/report/page/source/cover.js").Plane | null} slice
 */
function drawn(grains, slice = null) {
  const cover = new Cover(grains.length);
  const positions = grains.flatMap(([x, y, z]) => [x, y, z]);
  const radii = grains.map(([, , , radius]) => radius);
  const count = cover.look(camera, { count: grains.length, positions, radii }, slice);
  return [...cover.seen.subarray(0, count)];
}

test("grains are drawn from the nearest to the farthest", () => {
  const grains = /** @type {[number, number, number, number][]} */ ([-9, -5, -7].map((z, k) => [k - 1, 0, z, 0.1]));
  assert.deepEqual(drawn(grains), [1, 2, 0]);
});

test("what lies wholly behind a larger grain is not drawn", () => {
  assert.deepEqual(
    drawn([
      [0, 0, -10, 0.5],
      [0, 0, -5, 1],
    ]),
    [1],
  );
});

test("what stands out beside a nearer grain is drawn", () => {
  assert.deepEqual(
    drawn([
      [1.6, 0, -10, 0.5],
      [0, 0, -5, 1],
    ]),
    [1, 0],
  );
});

test("what lies behind the camera is not drawn", () => {
  assert.deepEqual(
    drawn([
      [0, 0, 3, 0.5],
      [0, 0, -3, 0.5],
    ]),
    [1],
  );
});

test("what a slice has cut away hides nothing", () => {
  const behind = { x: 0, y: 0, z: -1, w: -7 }; // keeps what is farther than 7
  assert.deepEqual(
    drawn(
      [
        [0, 0, -10, 0.5],
        [0, 0, -5, 1],
      ],
      behind,
    ),
    [0],
  );
});

test("a grain that a slice cuts is drawn, and hides nothing", () => {
  const through = { x: 0, y: 0, z: -1, w: -5 };
  assert.deepEqual(
    drawn(
      [
        [0, 0, -10, 0.5],
        [0, 0, -5, 1],
      ],
      through,
    ),
    [1, 0],
  );
});

test("of a wall of grains no more than the first layers are drawn", () => {
  const side = 12;
  /** @type {[number, number, number, number][]} */
  const grains = [];
  for (let z = 0; z < side; ++z)
    for (let y = 0; y < side; ++y)
      for (let x = 0; x < side; ++x) grains.push([x - side / 2, y - side / 2, -30 - z, 0.75]); // no gaps
  const seen = drawn(grains);
  const front = seen.filter((one) => one < side * side);
  assert.equal(front.length, side * side, "the first layer is drawn");
  assert.ok(seen.length < grains.length / 3, `${seen.length} of ${grains.length} are drawn`);
});

test("an empty picture is drawn", () => {
  assert.deepEqual(drawn([]), []);
});
