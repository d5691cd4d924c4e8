// Simulations side by side: each worker has an instance of its own. A worker that dies is replaced, and its task asked
// again of another.
import { Refusal, WorkerDied } from "./module_worker.js";

/** @typedef {import("./module_worker.js").Caller} Caller */

const attempts = 3; // a task that three workers in turn do not survive is itself at fault

export class Pool {
  /**
   * @param {number} size workers at most
   * @param {() => Caller} open makes a worker
   */
  constructor(size, open) {
    this.size = size;
    this.open = open;
    /** @type {Caller[]} */
    this.idle = [];
    /** @type {Set<Caller>} */
    this.busy = new Set();
    this.deaths = 0;
    this.closed = false;
  }

  /** How many tasks can be begun now. */
  get free() {
    return Math.max(0, this.size - this.busy.size);
  }

  /**
   * Runs a task; the caller keeps to `free`. Rejects with the Refusal of the module, with the WorkerDied of the last
   * attempt, or after `close`.
   * @param {unknown} task
   */
  async run(task) {
    for (let attempt = 1; ; ++attempt) {
      if (this.closed) throw new WorkerDied("the pool was closed");
      const worker = this.idle.pop() ?? this.open();
      this.busy.add(worker);
      try {
        const answer = await worker.call("simulate", { task });
        this.release(worker);
        return answer;
      } catch (error) {
        this.busy.delete(worker);
        if (error instanceof Refusal) this.release(worker);
        else worker.end();
        if (!(error instanceof WorkerDied) || this.closed) throw error;
        this.deaths += 1;
        if (attempt === attempts) throw error;
      }
    }
  }

  /** @param {Caller} worker */
  release(worker) {
    this.busy.delete(worker);
    if (this.closed || this.busy.size + this.idle.length >= this.size) worker.end();
    else this.idle.push(worker);
  }

  /** @param {number} size workers at most; those that are too many end with their task */
  resize(size) {
    this.size = size;
    while (this.idle.length > 0 && this.busy.size + this.idle.length > size) this.idle.pop()?.end();
  }

  /** Ends all workers, also those that simulate. */
  close() {
    this.closed = true;
    for (const worker of [...this.idle, ...this.busy]) worker.end();
    this.idle = [];
  }
}
