// Builds the page: node build.mjs FOLDER
//
// FOLDER/page.html is shell.html with style/ and source/ in it, and a place for the content of a calibration
// (calibrate/report/page.cpp); FOLDER/licences.txt has the licences of all that was bundled. The same sources and
// packages (package-lock.json) give the same bytes.
import { build } from "esbuild";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? join(here, "built"));

/**
 * A file with all that it imports: its text, and the paths of the files in it.
 * @param {string} entry
 */
async function bundled(entry) {
  const { outputFiles, metafile } = await build({
    entryPoints: [join(here, entry)],
    absWorkingDir: here,
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    legalComments: "none",
    charset: "ascii",
    write: false,
    metafile: true,
  });
  return { text: outputFiles[0].text.trimEnd(), files: Object.keys(metafile.inputs) };
}

/**
 * The folders of packages of which there is a file.
 * @param {string[]} files
 */
function packagesOf(files) {
  const folders = files.flatMap((file) => file.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+(?=\/)/) ?? []);
  return [...new Set(folders)].sort();
}

/** @param {string} place of a package */
function licenceOf(place) {
  const about = JSON.parse(readFileSync(join(here, place, "package.json"), "utf8"));
  const file = readdirSync(join(here, place)).find((name) => /^licen[cs]e/i.test(name));
  const text = file
    ? readFileSync(join(here, place, file), "utf8")
        .replace(/\r/g, "")
        .trim()
    : "";
  return `${about.name} ${about.version}, ${about.license}\n\n${text || "(no text in the package)"}\n`;
}

const program = await bundled("source/main.js");
const style = await bundled("style/main.css");
if (/<\/script|<!--/i.test(program.text)) throw new Error("the program would end its own element");
if (/<\/style/i.test(style.text)) throw new Error("the style would end its own element");

// Functions, because "$&" in what is put in would mean something.
const page = readFileSync(join(here, "shell.html"), "utf8")
  .replace("/*style*/", () => style.text)
  .replace("/*program*/", () => program.text);
const packages = packagesOf(program.files);
const licences = packages.map(licenceOf).join(`\n${"-".repeat(100)}\n\n`);

mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "page.html"), page);
writeFileSync(join(folder, "licences.txt"), `What the page contains of others, with its licences.\n\n${licences}`);
console.log(`${join(folder, "page.html")}: ${Math.round(page.length / 1000)} kB, parts of ${packages.length} packages`);
