// Calibrations in the browser's own storage, so that a closed tab loses nothing: what was asked, and each record.

/**
 * @typedef {object} Saved a calibration
 * @property {number} id
 * @property {string} title
 * @property {string} lab text of its laboratory file
 * @property {string} study
 * @property {number} [seed]
 * @property {number} [budget]
 * @property {string} begun ISO 8601
 * @property {number} seconds that it has run
 * @property {number} simulations
 * @property {string} [status] of its result; absent while there is none
 */

const kept = 20; // calibrations; older ones are removed when another begins

/**
 * @template Value
 * @param {IDBRequest<Value>} request
 * @returns {Promise<Value>}
 */
const answered = (request) =>
  new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });

/**
 * Once everything of a transaction is on disk.
 * @param {IDBTransaction} transaction
 */
const written = (transaction) =>
  new Promise((resolve, reject) => {
    transaction.oncomplete = () => resolve(undefined);
    transaction.onerror = transaction.onabort = () => reject(transaction.error);
  });

/** @returns {Promise<IDBDatabase>} */
function openDatabase() {
  const request = indexedDB.open("pastefit", 1);
  request.onupgradeneeded = () => {
    request.result.createObjectStore("calibrations", { keyPath: "id", autoIncrement: true });
    request.result.createObjectStore("records", { autoIncrement: true }).createIndex("of", "of");
    request.result.createObjectStore("results");
  };
  return answered(request);
}

export class Storage {
  /** @param {IDBDatabase} database */
  constructor(database) {
    this.database = database;
  }

  /** Nothing where the browser keeps nothing, e.g. in a private window. */
  static async open() {
    try {
      return new Storage(await openDatabase());
    } catch (error) {
      console.warn(error);
      return null;
    }
  }

  /** @returns {Promise<Saved[]>} the latest first */
  async all() {
    const store = this.database.transaction("calibrations").objectStore("calibrations");
    return (await answered(store.getAll())).reverse();
  }

  /**
   * @param {Omit<Saved, "id">} calibration
   * @returns {Promise<Saved>}
   */
  async add(calibration) {
    for (const old of (await this.all()).slice(kept - 1)) await this.remove(old.id);
    const transaction = this.database.transaction("calibrations", "readwrite");
    const id = Number(await answered(transaction.objectStore("calibrations").add(calibration)));
    await written(transaction);
    return { ...calibration, id };
  }

  /**
   * Appends records and updates their calibration, both or neither.
   * @param {Saved} calibration
   * @param {unknown[]} records
   */
  async append(calibration, records) {
    const transaction = this.database.transaction(["calibrations", "records"], "readwrite");
    for (const record of records) transaction.objectStore("records").add({ of: calibration.id, record });
    transaction.objectStore("calibrations").put(calibration);
    await written(transaction);
  }

  /**
   * Keeps the result of a calibration, and its status.
   * @param {Saved} calibration
   * @param {import("./files.js").Result} result
   */
  async finish(calibration, result) {
    const transaction = this.database.transaction(["calibrations", "results"], "readwrite");
    transaction.objectStore("calibrations").put(calibration);
    transaction.objectStore("results").put(result, calibration.id);
    await written(transaction);
  }

  /**
   * @param {number} id
   * @returns {Promise<import("./files.js").Result | undefined>}
   */
  async result(id) {
    return answered(this.database.transaction("results").objectStore("results").get(id));
  }

  /** @param {number} id */
  async records(id) {
    const index = this.database.transaction("records").objectStore("records").index("of");
    return (await answered(index.getAll(id))).map(({ record }) => record);
  }

  /** @param {number} id */
  async remove(id) {
    const transaction = this.database.transaction(["calibrations", "records", "results"], "readwrite");
    transaction.objectStore("calibrations").delete(id);
    transaction.objectStore("results").delete(id);
    const records = transaction.objectStore("records");
    const request = records.index("of").openKeyCursor(id);
    request.onsuccess = () => {
      const cursor = request.result;
      if (!cursor) return;
      records.delete(cursor.primaryKey);
      cursor.continue();
    };
    await written(transaction);
  }
}
