// What the builds of both pages share: esbuild with the packages of this folder, and the licences of what it bundled.
import { build } from "esbuild";
import { readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const packagesHere = dirname(fileURLToPath(import.meta.url));

/**
 * A file with all that it imports: its text, and the paths of the files in it, relative to `folder`.
 * @param {string} folder
 * @param {string} entry
 */
export async function bundled(folder, entry) {
  const { outputFiles, metafile } = await build({
    entryPoints: [join(folder, entry)],
    absWorkingDir: folder,
    nodePaths: [join(packagesHere, "node_modules")],
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
export function packagesOf(files) {
  const folders = files.flatMap((file) => file.match(/^.*node_modules\/(?:@[^/]+\/)?[^/]+(?=\/)/) ?? []);
  return [...new Set(folders)].sort();
}

/**
 * @param {string} folder that `place` is relative to
 * @param {string} place of a package
 */
function licenceOf(folder, place) {
  const about = JSON.parse(readFileSync(join(folder, place, "package.json"), "utf8"));
  const file = readdirSync(join(folder, place)).find((name) => /^licen[cs]e/i.test(name));
  const text = file
    ? readFileSync(join(folder, place, file), "utf8")
        .replace(/\r/g, "")
        .trim()
    : "";
  return `${about.name} ${about.version}, ${about.license}\n\n${text || "(no text in the package)"}\n`;
}

/**
 * The licences of packages, one after the other.
 * @param {string} folder
 * @param {string[]} packages
 */
export function licencesOf(folder, packages) {
  return packages.map((place) => licenceOf(folder, place)).join(`\n${"-".repeat(100)}\n\n`);
}

/**
 * Puts texts into the places of a shell: { "/*style*\/": text }. A text must not end the element that it is put in.
 * @param {string} shell
 * @param {Record<string, string>} texts
 */
export function filled(shell, texts) {
  let page = shell;
  for (const [place, text] of Object.entries(texts)) {
    if (/<\/(?:script|style)|<!--/i.test(text)) throw new Error(`the text for ${place} would end its own element`);
    if (!page.includes(place)) throw new Error(`the shell has no place ${place}`);
    page = page.replace(place, () => text); // a function, because "$&" in the text would mean something
  }
  return page;
}
