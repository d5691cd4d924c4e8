import assert from "node:assert/strict";
import { test } from "node:test";
import { WorkerDied } from "../../../../calibrate/browser/page/source/module_worker.js";
import { Pool } from "../../../../calibrate/browser/page/source/pool.js";
import { SearchLoop } from "../../../../calibrate/browser/page/source/search.js";

/**
 * A search that asks for rounds of tasks: each has to be answered before the next begins.
 * @param {number[]} rounds tasks of each
 * @param {(task: any) => Promise<unknown>} simulate
 */
function loopOf(rounds, simulate, workers = 3) {
  const seen = { asked: 0, answers: /** @type {string[]} */ ([]), kept: /** @type {unknown[]} */ ([]), stopped: false };
  const bounds = rounds.map((_, k) => rounds.slice(0, k + 1).reduce((sum, one) => sum + one, 0));
  const total = bounds[bounds.length - 1];
  /** @type {Record<string, (request: any) => unknown>} */
  const calls = {
    suggest: ({ count }) => {
      const open = bounds.find((end) => seen.answers.length < end) ?? total;
      const tasks = Array.from({ length: Math.min(count, open - seen.asked) }, (_, k) => seen.asked + k);
      seen.asked += tasks.length;
      return tasks.map((id) => ({ id, task: String(id) }));
    },
    ingest: (answers) => {
      seen.answers.push(...answers.map((/** @type {{answer: string}} */ { answer }) => answer));
      return { finished: seen.answers.length === total, records: answers };
    },
    progress: () => ({ phase: "search", simulations: seen.answers.length, budget: 9, best_error: 1, readings: [] }),
    stop: () => (seen.stopped = true),
  };
  const search = {
    call: async (/** @type {string} */ name, /** @type {any} */ request) => calls[name](request),
    end() {},
  };
  const pool = new Pool(workers, () => ({
    call: async (_, request) => simulate(/** @type {any} */ (request).task),
    end() {},
  }));
  const keep = async (/** @type {unknown[]} */ records) => void seen.kept.push(...records);
  return { seen, loop: new SearchLoop(search, pool, { keep, show() {} }), search };
}

/** @param {string} task */
const echo = async (task) => ({ answer: `of ${task}` });

test("every answer reaches the search, and every record is kept", async () => {
  const { loop, seen } = loopOf([4, 1, 5], echo);
  assert.equal(await loop.run(), "finished");
  assert.deepEqual(
    [...seen.answers].sort(),
    Array.from({ length: 10 }, (_, k) => `of ${k}`),
  );
  assert.equal(seen.kept.length, 10);
});

test("never more simulations run than there are workers", async () => {
  let [running, most] = [0, 0];
  const { loop } = loopOf([9], async (task) => {
    running += 1;
    most = Math.max(most, running);
    await new Promise((resolve) => setTimeout(resolve, 2));
    running -= 1;
    return echo(task);
  });
  await loop.run();
  assert.equal(most, 3);
});

test("a search that has finished with what it was opened with asks for nothing", async () => {
  const { loop, seen } = loopOf([0], echo);
  assert.equal(await loop.run(), "finished");
  assert.equal(seen.asked, 0);
});

test("a stop ends it at once, also while simulations run", async () => {
  const { loop, seen } = loopOf([5], () => new Promise(() => {}));
  const ended = loop.run();
  setTimeout(() => loop.stop(), 5);
  assert.equal(await ended, "stopped");
  assert.ok(seen.stopped);
});

test("a candidate that no worker survives has failed, and the search goes on", async () => {
  const { loop, seen } = loopOf([2, 3], async (task) => {
    if (task === "3") throw new WorkerDied("out of memory");
    return echo(task);
  });
  assert.equal(await loop.run(), "finished");
  assert.equal(seen.answers.filter((one) => one === undefined).length, 1);
});

test("where no simulation can be run at all, it ends with the reason", async () => {
  const { loop } = loopOf([5], async () => {
    throw new WorkerDied("out of memory");
  });
  await assert.rejects(loop.run(), /out of memory/);
});

test("a search that dies ends it with the reason", async () => {
  const { loop, search } = loopOf([5], echo);
  const { call } = search;
  search.call = async (name, request) => {
    if (name === "progress") throw new WorkerDied("the search trapped");
    return call(name, request);
  };
  await assert.rejects(loop.run(), /the search trapped/);
});

test("a search that neither asks nor finishes is a fault, not a wait without end", async () => {
  const { loop, search } = loopOf([5], echo);
  const { call } = search;
  search.call = async (name, request) => (name === "suggest" ? [] : call(name, request));
  await assert.rejects(loop.run(), /neither asks nor has finished/);
});
