// The files of a result: each by itself, and all of them as one archive.
import { strToU8, zipSync } from "fflate";

/** @typedef {{name: string, text: string}} TextFile */

/**
 * @typedef {object} Result what the module gives; without a material neither card nor summary
 * @property {string} status
 * @property {string} reason
 * @property {string | null} card
 * @property {string | null} summary
 * @property {string} report
 */

/** Targets of an export (calibrate/exports). */
export const targets = ["lammps", "liggghts", "yade", "edem-notes", "mercurydpm", "csv"];

/**
 * The folder that the program continues, and what was found.
 * @param {{lab: string, study: string}} sheet
 * @param {Result} result
 * @returns {TextFile[]}
 */
export function filesOf({ lab, study }, { card, summary, report }) {
  /** @type {{name: string, text: string | null}[]} */
  const files = [
    { name: "lab.json", text: lab },
    { name: "study.json", text: study },
    { name: "result/card.json", text: card },
    { name: "result/summary.txt", text: summary },
    { name: "result/report.html", text: report },
  ];
  return files.flatMap(({ name, text }) => (text ? [{ name, text }] : []));
}

/**
 * A name for a folder that every system takes.
 * @param {string} title
 */
export function folderName(title) {
  const plain = title.normalize("NFKD").replace(/[\u0300-\u036f]/g, "");
  const words = plain.toLowerCase().match(/[a-z0-9]+/g) ?? [];
  return words.join("-").slice(0, 40).replace(/-$/, "") || "pastefit";
}

/**
 * An archive with all files in one folder.
 * @param {string} folder
 * @param {TextFile[]} files
 */
export function archiveOf(folder, files) {
  const content = Object.fromEntries(files.map(({ name, text }) => [`${folder}/${name}`, strToU8(text)]));
  return zipSync(content, { level: 6 });
}

/** @param {string} name */
const typeOf = (name) =>
  name.endsWith(".json") ? "application/json" : name.endsWith(".html") ? "text/html" : "text/plain";

/**
 * Has the browser save a file.
 * @param {string} name
 * @param {string | Uint8Array<ArrayBuffer>} content
 */
export function save(name, content) {
  const type = typeof content === "string" ? `${typeOf(name)};charset=utf-8` : "application/zip";
  const address = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name.split("/").pop() ?? name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
