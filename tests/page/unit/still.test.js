import assert from "node:assert/strict";
import { test } from "node:test";
import { grainsInOrder } from "../../../calibrate/report/page/source/still.js";

test("a still picture draws grains from the back to the front, higher ones further up", () => {
  // Three grains of the last frame: behind, in front, and above the one in front.
  const frame = {
    places: [
      [0, 0, 0],
      [100, 0, 0],
      [10, 10, 90],
    ].map((steps) => Uint16Array.from(steps)),
  };
  const part = { count: 3, radii: Float32Array.from([1, 2, 3]), frames: [{ places: [] }, frame] };
  const film = /** @type {any} */ ({ parts: [part], low: [0, 0, 0], quantum: 1e-3 });
  const grains = grainsInOrder(film);
  assert.deepEqual(
    grains.map(({ radius }) => radius),
    [1, 2, 3],
  );
  assert.ok(grains[2].y > grains[1].y);
  assert.equal(grains[2].share, 1);
});
