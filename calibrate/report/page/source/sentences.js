// The program's sentences with the names of readings and parameters as people read them. In its messages they are the
// keys of files.
import { fullName, wordsAndUnit } from "./names.js";

/** @typedef {import("./content.js").Content} Content */

/**
 * Those that are no words of their own: "friction" is what it is called.
 * @param {Content} content
 */
function keysIn({ parameters = [], tests = [], search }) {
  const readings = tests.flatMap((test) => test.readings.flatMap(({ name }) => [fullName(test.name, name), name]));
  const names = [...parameters.map(({ name }) => name), ...readings, ...Object.keys(search.measured)];
  const keys = [...new Set(names)].filter((name) => /[._]/.test(name));
  return keys.sort((one, other) => other.length - one.length);
}

/**
 * A sentence with words for keys. Numbers behind them may lack a unit, so each has its own.
 * @param {string[]} keys the longest first
 * @returns {(text: string) => string}
 */
export function sayer(keys) {
  if (keys.length === 0) return (text) => text;
  const any = keys.map((key) => key.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")).join("|");
  const pattern = new RegExp(`(?<![\\w./-])(${any})(?![\\w/-]|\\.\\w)`, "g");
  return (text) => text.replace(pattern, wordsAndUnit);
}

/**
 * @template {Content} One
 * @param {One} content
 * @returns {One}
 */
export function inWords(content) {
  const said = sayer(keysIn(content));
  const { verdict, inference, search, parameters, tests, missing } = content;
  /** @type {<Some extends string | undefined>(text: Some) => Some} */
  const known = (text) => /** @type {typeof text} */ (text && said(text));
  return {
    ...content,
    missing: missing.map(said),
    verdict: verdict && {
      ...verdict,
      words: said(verdict.words),
      reservations: verdict.reservations.map(said),
      unconfirmed: known(verdict.unconfirmed),
    },
    parameters: parameters?.map((one) => ({ ...one, not_identified: known(one.not_identified) })),
    tests: tests?.map((test) => ({ ...test, remarks: said(test.remarks) })),
    inference: inference && { ...inference, words: said(inference.words) },
    search: { ...search, reason: known(search.reason) },
  };
}
