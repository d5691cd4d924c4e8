// The program of each worker, which the module's own loader stands before: an instance of the module, which answers one
// call after the other.

/**
 * @typedef {object} Instance what the loader makes (calibrate/browser)
 * @property {(name: string, result: string, kinds: string[], values: string[]) => string} ccall
 * @property {(text: string) => number} [stringToNewUTF8]
 * @property {(place: number) => string} UTF8ToString
 * @property {(place: number) => void} _free
 * @property {(name: number, request: number) => number} _pastefit_call
 */

/** @typedef {(imports: WebAssembly.Imports, made: (one: WebAssembly.Instance) => void) => object} Instantiate */
/** @typedef {(options: {instantiateWasm: Instantiate}) => Promise<Instance>} Loader */

const scope = /** @type {any} */ (self);

/** @param {WebAssembly.Module} compiled */
function instanceOf(compiled) {
  const load = /** @type {Loader} */ (scope.pastefit);
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
 * The answer of the module as a text. A request goes through the heap where the loader can do that: `ccall` puts it on
 * the stack, which the records of a long search would overflow.
 * @param {Instance} instance
 * @param {string[]} texts name and request
 */
function answerText(instance, texts) {
  if (!instance.stringToNewUTF8) return instance.ccall("pastefit_call", "string", ["string", "string"], texts);
  const [name, request] = texts.map(instance.stringToNewUTF8);
  try {
    return instance.UTF8ToString(instance._pastefit_call(name, request));
  } finally {
    [name, request].forEach(instance._free);
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
    const answer = JSON.parse(answerText(await instance, [data.name, JSON.stringify(data.request)]));
    scope.postMessage({ id: data.id, answer });
  } catch (error) {
    // A module that has trapped or run out of memory is not used again.
    scope.postMessage({ id: data.id, died: error instanceof Error ? error.message : String(error) });
  }
}

scope.addEventListener("message", take);
