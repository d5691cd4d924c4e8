// The loop of a calibration: asks the search for tasks, gives them to the pool, and hands it the answers, until it has
// finished or is stopped. Every record is kept before the next task is asked for.
import { WorkerDied } from "./module_worker.js";

/** @typedef {import("./module_worker.js").Caller} Caller */
/** @typedef {import("./pool.js").Pool} Pool */
/** @typedef {{id: number, answer: string} | {id: number, error: string}} Answer an error: it could not be run */

/**
 * @typedef {object} Progress
 * @property {string} phase
 * @property {number} simulations
 * @property {number} budget
 * @property {number | null} best_error null: none yet
 * @property {{name: string, measured: number, simulated?: number | null, tolerance: number}[]} readings
 * @property {string} [why] it goes on
 * @property {[number, number]} [sheared] heaps of how many
 */

/** @typedef {[number, number][]} Outline */

/**
 * @typedef {object} Watcher
 * @property {(records: unknown[], progress: Progress) => Promise<void>} keep stores records
 * @property {(progress: Progress, outline: Outline | null) => void} show
 */

export class SearchLoop {
  /**
   * @param {Caller} search a worker that has opened a study
   * @param {Pool} pool
   * @param {Watcher} watcher
   */
  constructor(search, pool, watcher) {
    this.search = search;
    this.pool = pool;
    this.watcher = watcher;
    /** @type {Answer[]} */
    this.arrived = [];
    this.running = 0;
    this.stopping = false;
    this.succeeded = false;
    /** @type {Error | null} */
    this.fault = null;
    /** @type {Outline | null} */
    this.outline = null;
    this.wake = () => {};
  }

  /** Until the search has finished: "finished", or "stopped". Rejects with the first fault. */
  async run() {
    let finished = await this.ingest();
    while (!finished && !this.stopping) {
      const asked = await this.begin();
      if (this.arrived.length === 0 && !this.stopping && !this.fault) {
        if (this.running > 0) await new Promise((resolve) => (this.wake = () => resolve(null)));
        else if (asked === 0 && !(await this.ingest())) throw new Error("the search neither asks nor has finished");
        else if (asked === 0) break;
      }
      if (this.fault) throw this.fault;
      if (this.arrived.length > 0) finished = await this.ingest();
    }
    if (!this.stopping) return "finished";
    await this.search.call("stop", {});
    return "stopped";
  }

  /** Hands over what has arrived. */
  async ingest() {
    const { finished, records } = await this.search.call("ingest", this.arrived.splice(0));
    const progress = await this.search.call("progress", {});
    if (records.length > 0) await this.watcher.keep(records, progress);
    this.watcher.show(progress, this.outline);
    return Boolean(finished);
  }

  /** Begins as many tasks as workers are free and the search has; how many. */
  async begin() {
    if (this.pool.free === 0) return 0;
    const tasks = await this.search.call("suggest", { count: this.pool.free });
    if (this.stopping) return 0;
    for (const { id, task } of tasks) this.simulate(id, task);
    return tasks.length;
  }

  /**
   * @param {number} id
   * @param {string} task
   */
  async simulate(id, task) {
    this.running += 1;
    try {
      const { answer, outline } = await this.pool.run(task);
      if (outline?.heap && outline.points.length > 0) this.outline = outline.points;
      this.arrived.push({ id, answer });
      this.succeeded = true;
    } catch (error) {
      if (!this.stopping) this.miss(id, error instanceof Error ? error : new WorkerDied(String(error)));
    }
    this.running -= 1;
    this.wake();
  }

  /**
   * A candidate that no worker survives has failed. Where none was simulated at all, it is the computer that cannot.
   * @param {number} id
   * @param {Error} error
   */
  miss(id, error) {
    if (error instanceof WorkerDied && this.succeeded) this.arrived.push({ id, error: error.message });
    else this.fault ??= error;
  }

  /** Ends the simulations that run; the best so far becomes the result. */
  stop() {
    this.stopping = true;
    this.pool.close();
    this.wake();
  }
}
