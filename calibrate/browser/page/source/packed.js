// What the build put into the page: the workers' program and the module, as gzip in base64.

/** @param {string} text of base64 */
function bytesOf(text) {
  const letters = atob(text.trim());
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

/**
 * @param {string} text of base64
 * @returns {Promise<ArrayBuffer>}
 */
export async function unpacked(text) {
  const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** @param {string} id of an element of the shell */
const embedded = (id) => unpacked(document.getElementById(id)?.textContent ?? "");

/** @param {string} id */
export async function embeddedText(id) {
  return new TextDecoder().decode(await embedded(id));
}

/** The address of the workers' program, and the module, compiled once for all workers. */
export async function embeddedModule() {
  const [program, module] = await Promise.all([embedded("worker"), embedded("module")]);
  const address = URL.createObjectURL(new Blob([program], { type: "text/javascript" }));
  return { address, compiled: await WebAssembly.compile(module) };
}
