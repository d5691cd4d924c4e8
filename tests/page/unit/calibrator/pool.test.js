import assert from "node:assert/strict";
import { test } from "node:test";
import { Refusal, WorkerDied } from "../../../../calibrate/browser/page/source/module_worker.js";
import { Pool } from "../../../../calibrate/browser/page/source/pool.js";

/**
 * A pool of workers that answer with `simulate`; all that were opened, and whether each has ended.
 * @param {number} size
 * @param {(task: any, worker: number) => unknown} simulate
 */
function poolOf(size, simulate) {
  /** @type {{ended: boolean}[]} */
  const opened = [];
  const pool = new Pool(size, () => {
    const number = opened.length;
    const state = { ended: false };
    opened.push(state);
    return {
      call: async (_, request) => simulate(/** @type {any} */ (request).task, number),
      end: () => (state.ended = true),
    };
  });
  return { pool, opened };
}

test("a worker that has answered takes the next task", async () => {
  const { pool, opened } = poolOf(2, (task) => task + 1);
  assert.equal(await pool.run(1), 2);
  assert.equal(await pool.run(2), 3);
  assert.equal(opened.length, 1);
});

test("as many tasks are free as workers have none", async () => {
  const { pool } = poolOf(2, (task) => task);
  assert.equal(pool.free, 2);
  const running = pool.run(1);
  assert.equal(pool.free, 1);
  await running;
  assert.equal(pool.free, 2);
});

test("a task of a worker that dies is asked of another", async () => {
  const { pool, opened } = poolOf(1, (task, worker) => {
    if (worker === 0) throw new WorkerDied("out of memory");
    return task;
  });
  assert.equal(await pool.run("task"), "task");
  assert.equal(pool.deaths, 1);
  assert.deepEqual(
    opened.map(({ ended }) => ended),
    [true, false],
  );
});

test("a task that no worker survives is given up after three", async () => {
  const { pool, opened } = poolOf(1, () => {
    throw new WorkerDied("out of memory");
  });
  await assert.rejects(pool.run("task"), /out of memory/);
  assert.equal(opened.length, 3);
  assert.equal(pool.free, 1);
});

test("a task that the module refuses costs no worker", async () => {
  const { pool, opened } = poolOf(1, () => {
    throw new Refusal([{ where: "task", what: "is none", remedy: "another" }]);
  });
  await assert.rejects(pool.run("task"), /task: is none; another/);
  assert.deepEqual(opened, [{ ended: false }]);
});

test("a smaller pool ends the workers that are too many", async () => {
  const { pool, opened } = poolOf(3, (task) => task);
  await Promise.all([1, 2, 3].map((task) => pool.run(task)));
  pool.resize(1);
  assert.equal(opened.filter(({ ended }) => ended).length, 2);
  assert.equal(pool.free, 1);
});

test("a pool that was closed runs nothing, and ends the workers that simulate", async () => {
  const { pool, opened } = poolOf(1, () => new Promise(() => {}));
  pool.run("task");
  pool.close();
  assert.deepEqual(opened, [{ ended: true }]);
  await assert.rejects(pool.run("task"), WorkerDied);
});
