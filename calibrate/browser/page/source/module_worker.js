// One instance of the module in a worker of its own, asked by name as calibrate/browser answers.

/** @typedef {{where: string, what: string, remedy: string}} Fault as the program prints it */

/** What the module refuses; nothing was changed. */
export class Refusal extends Error {
  /** @param {Fault[]} faults */
  constructor(faults) {
    super(faults.map(({ where, what, remedy }) => `${where}: ${what}; ${remedy}`).join("\n"));
    this.faults = faults;
  }
}

/** The worker ended, or its module trapped: every call that waits for it fails. */
export class WorkerDied extends Error {}

/**
 * @typedef {object} Caller
 * @property {(name: string, request: unknown) => Promise<any>} call
 * @property {() => void} end
 */

/**
 * @typedef {object} Thread what of a Worker is used
 * @property {(message: unknown) => void} postMessage
 * @property {(name: string, listener: (event: any) => void) => void} addEventListener
 * @property {() => void} terminate
 */

/** @implements {Caller} */
export class ModuleWorker {
  /**
   * @param {Thread} thread
   * @param {WebAssembly.Module} compiled
   */
  constructor(thread, compiled) {
    this.thread = thread;
    /** @type {Map<number, {resolve: (answer: any) => void, reject: (error: Error) => void}>} */
    this.waiting = new Map();
    this.calls = 0;
    /** @type {WorkerDied | null} */
    this.death = null;
    thread.addEventListener("message", ({ data }) => this.take(data));
    thread.addEventListener("error", (event) => this.die(event.message || "the worker ended"));
    thread.addEventListener("messageerror", () => this.die("an answer could not be read"));
    thread.postMessage({ module: compiled });
  }

  /**
   * @param {string} name
   * @param {unknown} request
   * @returns {Promise<any>} the answer; rejects with a Refusal, or with WorkerDied
   */
  call(name, request) {
    if (this.death) return Promise.reject(this.death);
    const id = ++this.calls;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.thread.postMessage({ id, name, request });
    });
  }

  /** @param {{id: number, answer?: {ok?: unknown, faults?: Fault[]}, died?: string}} message */
  take({ id, answer, died }) {
    if (died !== undefined) return this.die(died);
    const asked = this.waiting.get(id);
    if (!asked) return;
    if (answer?.faults) asked.reject(new Refusal(answer.faults));
    else if (answer && "ok" in answer) asked.resolve(answer.ok);
    else return this.die("an answer is neither a result nor a list of faults");
    this.waiting.delete(id);
  }

  /** @param {string} why */
  die(why) {
    if (this.death) return;
    this.death = new WorkerDied(why);
    this.thread.terminate();
    for (const { reject } of this.waiting.values()) reject(this.death);
    this.waiting.clear();
  }

  /** Ends the worker, also in the middle of a call. */
  end() {
    this.die("the worker was ended");
  }
}
