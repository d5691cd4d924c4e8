// Names of readings and parameters as people read them. A unit stands at the end of a name.

const units = new Map([
  ["_pa_s", "Pa s"],
  ["_mm", "mm"],
  ["_pa", "Pa"],
  ["_kg", "kg"],
  ["_g", "g"],
  ["_rad_s", "rad/s"],
  ["_s", "s"],
  ["_n", "N"],
  ["_deg", "\u00b0"],
]);

/** @type {[key: RegExp, words: string][]} keys that lack what their words have */
const spelled = [
  [/\byoungs_/, "Young's_"],
  [/\bpoissons_/, "Poisson's_"],
  [/\bpull_off\b/, "pull-off"],
];

/** @param {string} name */
const unitEnd = (name) => [...units.keys()].find((end) => name.endsWith(end)) ?? "";

/**
 * The unit of a name: "step1.height_mm" -> "mm".
 * @param {string} name
 */
export function unitOf(name) {
  return units.get(unitEnd(name)) ?? "";
}

/**
 * The name of a reading among those of all tests, as in a study: "plate/step1.height_mm".
 * @param {string | undefined} test
 * @param {string} reading
 */
export function fullName(test, reading) {
  return test ? `${test}/${reading}` : reading;
}

/**
 * The name without its unit: "plate/step1.height_mm" -> "plate: step 1, height".
 * @param {string} name
 */
export function words(name) {
  const bare = name.slice(0, name.length - unitEnd(name).length);
  return spelled
    .reduce((text, [key, own]) => text.replace(key, own), bare)
    .replace("/", ": ")
    .replace(/([a-z])(\d+)\./, "$1 $2, ")
    .replace(/\./g, ", ")
    .replace(/_/g, " ");
}

/**
 * A value with the unit of its name behind it.
 * @param {string} value
 * @param {string} name
 */
export function withUnit(value, name) {
  return `${value} ${unitOf(name)}`.trimEnd();
}

/**
 * With its unit: "step1.height_mm" -> "step 1, height [mm]".
 * @param {string} name
 */
export function wordsAndUnit(name) {
  const unit = unitOf(name);
  return unit ? `${words(name)} [${unit}]` : words(name);
}
