// The program of each worker, which the module's own loader stands before: an instance of the module, which answers one
// call after the other.

/**
 * @typedef {object} Instance what the loader makes (calibrate/browser)
 * @property {(text: string) => number} stringToNewUTF8
 * @property {(place: number) => string} UTF8ToString
 * @property {(place: number) => void} _free
 * @property {(name: number, request: number) => number} _pastefit_call
 */

/** @typedef {(imports: WebAssembly.Imports, made: (one: WebAssembly.Instance) => void) => object} Instantiate */
/** @typedef {(options: {instantiateWasm: Instantiate}) => Promise<Instance>} Loader */

const scope = /** @type {any} */ (self);

/** @param {WebAssembly.Module} compiled */
function instanceOf(compiled) {
  const load = /** @type {Loader} */ (scope.createPastefit);
  return new Promise((resolve, reject) => {
    /** @type {Instantiate} */
    const instantiateWasm = (imports, made) => {
      WebAssembly.instantiate(compiled, imports).then((one) => made(one), reject);
      return {};
    };
    load({ instantiateWasm }).then(resolve, reject);
  });
}

/**
 * @param {Instance} instance
 * @param {string} name
 * @param {unknown} request
 */
function answerOf(instance, name, request) {
  const places = [name, JSON.stringify(request)].map((text) => instance.stringToNewUTF8(text));
  try {
    return JSON.parse(instance.UTF8ToString(instance._pastefit_call(places[0], places[1])));
  } finally {
    places.forEach((place) => instance._free(place));
  }
}

/** @type {Promise<Instance>} */
let instance;

/** @param {MessageEvent} event */
async function take({ data }) {
  if (data.module) {
    instance = instanceOf(data.module);
    return;
  }
  try {
    scope.postMessage({ id: data.id, answer: answerOf(await instance, data.name, data.request) });
  } catch (error) {
    // A module that has trapped or run out of memory is not used again.
    scope.postMessage({ id: data.id, died: error instanceof Error ? error.message : String(error) });
  }
}

scope.addEventListener("message", take);
