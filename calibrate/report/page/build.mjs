// Builds the page: node build.mjs FOLDER
//
// FOLDER/page.html is shell.html with style/ and source/ in it, and a place for the content of a calibration
// (calibrate/report/page.cpp); FOLDER/licences.txt has the licences of all that was bundled. The same sources and
// packages (package-lock.json) give the same bytes.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { bundled, filled, licencesOf, packagesOf } from "./bundle.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? join(here, "built"));

const program = await bundled(here, "source/main.js");
const style = await bundled(here, "style/main.css");
const shell = readFileSync(join(here, "shell.html"), "utf8");
const page = filled(shell, { "/*style*/": style.text, "/*program*/": program.text });
const packages = packagesOf(program.files);
const licences = licencesOf(here, packages);

mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "page.html"), page);
writeFileSync(join(folder, "licences.txt"), `What the page contains of others, with its licences.\n\n${licences}`);
console.log(`${join(folder, "page.html")}: ${Math.round(page.length / 1000)} kB, parts of ${packages.length} packages`);
