// A measuring sheet as it is typed, and what the module is asked with it: the options of `pastefit new`
// (calibrate/manual/options.md), each as the text that stands in its field.

/** @typedef {import("./module_worker.js").Fault} Fault */

/**
 * @typedef {object} Mould
 * @property {number} base_diameter_mm
 * @property {number} top_diameter_mm
 * @property {number} height_mm
 */

/**
 * @typedef {object} Preset
 * @property {string} name
 * @property {string} title
 * @property {Mould} mould
 * @property {number} drops of its plate or table; 0: it has neither
 * @property {boolean} flank an angle of repose is read
 * @property {string} caution empty, or what to mind with it
 */

/**
 * A preset as the module gives it.
 * @typedef {object} KnownPreset
 * @property {string} name
 * @property {string} title
 * @property {boolean} sheet whether a sheet may name it
 * @property {number} drops
 * @property {string} caution
 * @property {{mould: Mould, reading?: {flank?: object}}} apparatus
 */

/**
 * The moulds that a sheet may name.
 * @param {KnownPreset[]} known
 * @returns {Preset[]}
 */
export function presetsOf(known) {
  return known
    .filter(({ sheet }) => sheet)
    .map(({ name, title, drops, caution, apparatus: { mould, reading } }) => {
      return { name, title: title || name, mould, drops, flank: Boolean(reading?.flank), caution };
    });
}

/** @typedef {Record<string, string>} Values texts by the name of their field */

/**
 * @typedef {object} ReadingField
 * @property {string} name
 * @property {string} key in a laboratory file
 * @property {boolean} isLength
 * @property {(preset: Preset | undefined) => boolean} applies to a mould
 */

export const ownMould = "own";
export const lengthUnits = ["mm", "cm", "in"];
export const densityUnits = ["kg/m3", "g/cm3", "kg/l", "lb/ft3"];

/** Laws that each program has, its default first (calibrate/study/target_laws.h). */
export const lawsOf = {
  lammps: ["bridge", "epa", "jkr", "sjkr"],
  liggghts: ["sjkr", "epa"],
  yade: ["bridge"],
  edem: ["jkr", "epa"],
};

const always = () => true;
/** @type {ReadingField["applies"]} */
const withPlate = (preset) => preset?.drops === 1;
/** @type {ReadingField["applies"]} */
const withTable = (preset) => (preset?.drops ?? 0) > 1;

/** @type {ReadingField[]} */
export const readingFields = [
  { name: "slump", key: "step1.slump_mm", isLength: true, applies: (preset) => !preset?.flank },
  { name: "height", key: "step1.height_mm", isLength: true, applies: always },
  { name: "spread", key: "step1.spread_mm", isLength: true, applies: always },
  { name: "angle", key: "step1.angle_of_repose_deg", isLength: false, applies: (preset) => Boolean(preset?.flank) },
  { name: "height2", key: "step2.height_mm", isLength: true, applies: withPlate },
  { name: "spread2", key: "step2.spread_mm", isLength: true, applies: withPlate },
  { name: "sag", key: "step2.plateau_sag_mm", isLength: true, applies: withPlate },
  { name: "flow", key: "after_drops.spread_mm", isLength: true, applies: withTable },
  { name: "height-after", key: "after_drops.height_mm", isLength: true, applies: withTable },
];

/** Not of the heap itself. @type {ReadingField[]} */
export const otherReadings = [
  { name: "shift", key: "step1.lateral_shift_mm", isLength: true, applies: (preset) => !preset?.flank },
  { name: "mass", key: "fill.mass_kg", isLength: false, applies: always },
];

const allReadings = [...readingFields, ...otherReadings];

/** @param {string} text */
const hasUnit = (text) => /[\p{L}%"']/u.test(text);

/**
 * A text with the unit of its field, unless it has one of its own or that is the program's.
 * @param {string | undefined} text
 * @param {string | undefined} unit
 * @param {string} usual
 */
export function withUnit(text, unit, usual) {
  const typed = (text ?? "").trim();
  return typed === "" || !unit || unit === usual || hasUnit(typed) ? typed : `${typed} ${unit}`;
}

/**
 * The presets' one that is chosen.
 * @param {Values} values
 * @param {Preset[]} presets
 */
export const chosenPreset = (values, presets) => presets.find(({ name }) => name === values.mould);

/** @param {Values} values */
function mouldOf(values) {
  if (values.mould !== ownMould) return values.mould ?? "";
  const lengths = [values.base, values.top, values.moulded].map((one) => (one ?? "").trim());
  return withUnit(lengths.join("/"), values.lengthUnit, "mm");
}

/**
 * The request of `new`.
 * @param {Values} values
 * @param {Preset[]} presets
 * @param {string[]} confirmed places
 * @returns {Record<string, unknown>}
 */
export function requestOf(values, presets, confirmed) {
  const preset = chosenPreset(values, presets);
  /** @type {Record<string, unknown>} */
  const request = { mould: mouldOf(values), density: withUnit(values.density, values.densityUnit, "kg/m3") };
  const laws = lawsOf[/** @type {keyof typeof lawsOf} */ (values.for)] ?? [];
  const law = laws.includes(values.law) ? values.law : "";
  const plain = [
    ["law", law],
    ["yield_stress", values["yield-stress"]],
    ...["title", "for"].map((name) => [name, values[name]]),
  ];
  for (const [name, text] of [...plain, ["grains", withUnit(values.grains, values.lengthUnit, "mm")]])
    if (text?.trim()) request[name] = text.trim();
  if ((preset?.drops ?? 0) > 0 && values.drops?.trim()) request.drops = Number(values.drops);
  /** @type {Record<string, string>} */
  const deviations = {};
  for (const { name, isLength, applies } of allReadings) {
    if (!applies(preset)) continue;
    const unit = isLength ? values.lengthUnit : undefined;
    const [reading, deviation] = [values[name], values[`sd.${name}`]].map((text) => withUnit(text, unit, "mm"));
    if (reading) request[name] = reading;
    if (deviation) deviations[name] = deviation;
  }
  return { ...request, sd: deviations, confirm: confirmed };
}

/** Fields that the page reads as whole numbers itself, with an example of each. */
const wholeNumbers = { drops: "15", seed: "1", budget: "150" };

/**
 * Faults of what is no text of the program's own.
 * @param {Values} values
 * @param {{wholeNumber: string, wholeNumberRemedy: string}} texts
 * @returns {Fault[]}
 */
export function faultsOfNumbers(values, texts) {
  return Object.entries(wholeNumbers)
    .filter(([name]) => values[name]?.trim() && !/^[1-9]\d{0,8}$/.test(values[name].trim()))
    .map(([name, example]) => ({
      where: name,
      what: texts.wholeNumber,
      remedy: texts.wholeNumberRemedy.replace("{example}", () => example),
    }));
}

/**
 * A number of the request of `open`; undefined: the study's.
 * @param {string | undefined} text
 */
export const wholeNumber = (text) => (text?.trim() ? Number(text) : undefined);

/**
 * The reading whose key, or whose short name, this is.
 * @param {string} name
 */
export const readingOf = (name) => allReadings.find((one) => one.key === name || one.name === name);
