// The language of the page: the browser's, until another is chosen.
import { de } from "./texts/de.js";
import { en } from "./texts/en.js";

/** @typedef {typeof en} Texts */
/** @typedef {"en" | "de"} Language */

/** @type {Record<Language, Texts>} */
const texts = { en, de };

/** @type {[value: string, text: string][]} */
export const languages = [
  ["en", "English"],
  ["de", "Deutsch"],
];

/**
 * The first of the reader's languages that the page has.
 * @param {readonly string[]} preferred as "de-AT"
 * @returns {Language}
 */
export function languageOf(preferred) {
  const known = preferred.map((one) => one.slice(0, 2).toLowerCase()).find((one) => one in texts);
  return /** @type {Language} */ (known ?? "en");
}

/** @param {Language} language */
export const textsOf = (language) => texts[language];

/**
 * Puts values into a text: fill("{done} of {budget}", { done: 3, budget: 150 }). What is put in is never read again.
 * @param {string} text
 * @param {Record<string, string | number>} values
 */
export function fill(text, values) {
  return text.replace(/\{(\w+)\}/g, (place, name) => (name in values ? String(values[name]) : place));
}

/**
 * A word of a table, or what the program calls it where the table has none.
 * @param {Record<string, string>} table
 * @param {string} name
 */
export const wordOf = (table, name) => (Object.hasOwn(table, name) ? table[name] : name.replace(/_/g, " "));
