// Which field of the form a fault of the program is about, by the place that it names.
import { readingOf } from "./sheet.js";

/** @typedef {import("./module_worker.js").Fault} Fault */
/** @typedef {import("./sheet.js").Values} Values */

/** @type {[RegExp, string][]} */
const places = [
  [/^(?:--)?title/, "title"],
  [/^--drops|^drops$|drop_plate/, "drops"],
  [/^(?:--)?mould|^apparatus/, "mould"],
  [/density/, "density"],
  [/^(?:--)?grains/, "grains"],
  [/^--law|^law/, "law"],
  [/^--for|^for/, "for"],
  [/yield[ _-]stress/, "yield-stress"],
  [/seed$/, "seed"],
  [/budget/, "budget"],
  [/^readings$|^measurements$/, "slump"],
];

/** Readings that are typed in place of each other. */
const siblings = new Map([
  ["slump", "height"],
  ["height", "slump"],
]);

/**
 * @param {string} name of a reading
 * @param {Values} values
 */
function fieldOfReading(name, values) {
  const field = readingOf(name)?.name;
  if (!field) return null;
  const sibling = siblings.get(field);
  return sibling && !values[field]?.trim() && values[sibling]?.trim() ? sibling : field;
}

/**
 * The name of the field; null: the fault is of none of them.
 * @param {Fault} fault
 * @param {Values} values
 */
export function fieldOf({ where }, values) {
  const ofDeviation = where.match(/^sd ([\w.-]+)$/);
  if (ofDeviation) return readingOf(ofDeviation[1]) ? `sd.${readingOf(ofDeviation[1])?.name}` : null;
  const ofKey = where.match(/^measurements\.([a-z_]+\d*\.[a-z_]+)(\.standard_deviation)?/);
  if (ofKey) {
    const field = fieldOfReading(ofKey[1], values);
    return field && ofKey[2] ? `sd.${field}` : field;
  }
  const named = where.match(/^(?:reading |--)([\w.-]+)$/);
  const field = named ? fieldOfReading(named[1], values) : null;
  return field ?? places.find(([pattern]) => pattern.test(where))?.[1] ?? null;
}

/**
 * The place that the program asks to confirm if the value is right; null: it cannot be confirmed.
 * @param {Fault} fault
 */
export function placeToConfirm({ remedy }) {
  return remedy.match(/--confirm ([\w.]+)/)?.[1] ?? remedy.match(/"confirmed": \["([^"]+)"\]/)?.[1] ?? null;
}

/** @param {Fault} fault */
export const sentenceOf = ({ what, remedy }) => (remedy ? `${what}; ${remedy}` : what);
