// Loads the module of the browser (calibrate/browser) in Node as the page does: the bytes are given, and `call` takes
// and gives JSON.
const fs = require("fs");
const path = require("path");

/** A function call(name, request) that returns {ok} or {faults}. */
exports.load = async function load(folder) {
  const factory = require(path.join(path.resolve(folder), "pastefit.js"));
  const module = await factory({ wasmBinary: fs.readFileSync(path.join(folder, "pastefit.wasm")) });
  return (name, request = {}) => {
    const texts = [name, JSON.stringify(request)].map((text) => module.stringToNewUTF8(text));
    try {
      return JSON.parse(module.UTF8ToString(module._pastefit_call(...texts)));
    } finally {
      texts.forEach((place) => module._free(place));
    }
  };
};

/** Simulates every task until the calibration has finished; returns all records. */
exports.calibrate = function calibrate(call, atOnce = 4, onTask = () => {}) {
  const records = [];
  for (;;) {
    const tasks = exports.ok(call("suggest", { count: atOnce }));
    if (tasks.length === 0) break;
    const answers = tasks.map((one) => {
      onTask(one);
      return { id: one.id, answer: exports.ok(call("simulate", { task: one.task })).answer };
    });
    records.push(...exports.ok(call("ingest", answers)).records);
  }
  return records;
};

exports.ok = function ok(answer) {
  if (!("ok" in answer)) throw new Error(JSON.stringify(answer.faults));
  return answer.ok;
};
