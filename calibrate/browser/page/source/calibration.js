// One calibration from its sheet to its result: a search in one worker, simulations in others, every record kept.
import { Pool } from "./pool.js";
import { SearchLoop } from "./search.js";
import { remainingSeconds } from "./live.js";

/** @typedef {import("./files.js").Result} Result */
/** @typedef {import("./module_worker.js").Caller} Caller */
/** @typedef {import("./search.js").Outline} Outline */
/** @typedef {import("./search.js").Progress} Progress */
/** @typedef {import("./storage.js").Saved} Saved */

/**
 * @typedef {object} Keeper where records go; storage.js
 * @property {(saved: Saved, records: unknown[]) => Promise<void>} append
 */

/** @typedef {{title: string, budget: number}} Opened */

export class Calibration {
  /**
   * @param {Saved} saved
   * @param {unknown[]} records of earlier sessions
   * @param {() => Caller} openWorker
   * @param {Keeper | null} keeper none: the records are in memory only
   * @param {number} workers that simulate
   */
  constructor(saved, records, openWorker, keeper, workers) {
    this.saved = saved;
    this.records = records;
    this.keeper = keeper;
    this.search = openWorker();
    this.pool = new Pool(workers, openWorker);
    /** @type {Progress | null} */
    this.progress = null;
    /** @type {Outline | null} */
    this.outline = null;
    /** @type {string | null} why the latest records could not be kept */
    this.lost = null;
    this.begun = performance.now();
    this.before = { seconds: saved.seconds, simulations: -1 };
    this.stopping = false;
    this.changed = () => {};
    this.loop = new SearchLoop(this.search, this.pool, {
      keep: (added, progress) => this.keep(added, progress),
      show: (progress, outline) => this.show(progress, outline),
    });
  }

  /**
   * Opens the study with what is known of it. Rejects with the Refusal of a faulty one.
   * @returns {Promise<Opened>}
   */
  open() {
    const { lab, study, seed, budget } = this.saved;
    return this.search.call("open", { lab, study, seed, budget, stored: this.records });
  }

  /** Seconds of this session. */
  get session() {
    return (performance.now() - this.begun) / 1000;
  }

  /** Seconds at most until the budget is used up. */
  get remaining() {
    const done = (this.progress?.simulations ?? 0) - this.before.simulations;
    return this.progress ? remainingSeconds(done, this.session, this.progress) : null;
  }

  /**
   * @param {Progress} progress
   * @param {Outline | null} outline
   */
  show(progress, outline) {
    if (this.before.simulations < 0) this.before.simulations = progress.simulations;
    this.progress = progress;
    this.outline = outline;
    this.changed();
  }

  /**
   * @param {unknown[]} added
   * @param {Progress} progress
   */
  async keep(added, progress) {
    this.records.push(...added);
    this.saved.simulations = progress.simulations;
    this.saved.seconds = this.before.seconds + this.session;
    try {
      await this.keeper?.append(this.saved, added);
      this.lost = null;
    } catch (error) {
      this.lost = error instanceof Error ? error.message : String(error); // a full disk ends no calibration
    }
  }

  /**
   * Until it has finished or was stopped. Rejects if the search or a simulation cannot go on; then the records are
   * kept, and another calibration with them can.
   * @returns {Promise<Result>}
   */
  async run() {
    try {
      await this.loop.run();
      const result = await this.search.call("result", {});
      this.saved.seconds = this.before.seconds + this.session;
      this.saved.status = result.status;
      return result;
    } finally {
      this.end();
    }
  }

  stop() {
    this.stopping = true;
    this.loop.stop();
    this.changed();
  }

  /** Ends all workers. */
  end() {
    this.pool.close();
    this.search.end();
  }
}
