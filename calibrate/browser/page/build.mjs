// Builds the page that calibrates: node build.mjs PASTEFIT.js PASTEFIT.wasm OUT.html [LICENCES.txt]
//
// PASTEFIT.js and PASTEFIT.wasm are the module of the preset `browser`; LICENCES.txt has the licences of what was
// linked into it. OUT.html is shell.html with style/, source/ and the module in it; the workers' program and the module
// as gzip in base64. The same sources, packages (../../report/page/package-lock.json) and module give the same bytes.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { bundled, filled, licencesOf, packagesOf } from "../../report/page/bundle.mjs";

const most = 6e6; // bytes: what mail programs and file shares still take

const here = dirname(fileURLToPath(import.meta.url));
const [glueFile, moduleFile, out, licenceFile] = process.argv.slice(2);
if (!out) throw new Error("usage: node build.mjs PASTEFIT.js PASTEFIT.wasm OUT.html [LICENCES.txt]");

/** @param {string | Uint8Array} content */
const packed = (content) => gzipSync(content, { level: 9 }).toString("base64");

const program = await bundled(here, "source/main.js");
const worker = await bundled(here, "source/worker.js");
const style = await bundled(here, "style/main.css");
const packages = packagesOf([...program.files, ...worker.files]);
const ofModule = licenceFile ? `\n${"-".repeat(100)}\n\n${readFileSync(licenceFile, "utf8")}` : "";
const page = filled(readFileSync(join(here, "shell.html"), "utf8"), {
  "/*style*/": style.text,
  "/*licences*/": packed(licencesOf(here, packages) + ofModule),
  "/*worker*/": packed(`${readFileSync(glueFile, "utf8")}\n${worker.text}`),
  "/*module*/": packed(readFileSync(moduleFile)),
  "/*program*/": program.text,
});
if (page.length > most) throw new Error(`the page has ${page.length} bytes; at most ${most} are allowed`);
writeFileSync(out, page);
console.log(`${out}: ${Math.round(page.length / 1000)} kB, parts of ${packages.length} packages`);
