// Builds the page: node build.mjs FOLDER
//
// FOLDER/page.html is shell.html with style.css and the program in it, and a place for the content of a calibration
// (calibrate/report/page.cpp); FOLDER/licences.txt has the licences of all that was bundled. The same sources and
// packages (package-lock.json) give the same bytes.
import { build } from "esbuild";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? join(here, "built"));

const result = await build({
  entryPoints: [join(here, "source/main.js")],
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
const program = result.outputFiles[0].text.trimEnd();
if (/<\/script|<!--/i.test(program)) throw new Error("the program would end its own element");

const shell = readFileSync(join(here, "shell.html"), "utf8");
const style = readFileSync(join(here, "style.css"), "utf8");
// Functions, because "$&" in what is put in would mean something.
const page = shell.replace("/*style*/", () => style.trimEnd()).replace("/*program*/", () => program);

// The packages of which something was bundled, each with its licence.
const packages = [
  ...new Set(
    Object.keys(result.metafile.inputs)
      .map((file) => file.match(/^(.*node_modules\/((?:@[^/]+\/)?[^/]+))\//)?.[1])
      .filter(Boolean),
  ),
].sort((one, other) => (relative(here, one) < relative(here, other) ? -1 : 1));
const licences = packages.map((place) => {
  const about = JSON.parse(readFileSync(join(here, place, "package.json"), "utf8"));
  const file = readdirSync(join(here, place)).find((name) => /^licen[cs]e/i.test(name));
  const text = file
    ? readFileSync(join(here, place, file), "utf8")
        .replace(/\r/g, "")
        .trim()
    : "(no text in the package)";
  return `${about.name} ${about.version}, ${about.license}\n\n${text}\n`;
});

mkdirSync(folder, { recursive: true });
writeFileSync(join(folder, "page.html"), page);
writeFileSync(
  join(folder, "licences.txt"),
  `What the page contains of others, with its licences.\n\n${licences.join(`\n${"-".repeat(100)}\n\n`)}`,
);
console.log(`${join(folder, "page.html")}: ${Math.round(page.length / 1000)} kB, parts of ${packages.length} packages`);
