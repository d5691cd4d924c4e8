// The questions of `pastefit new` as a form.
import { element } from "../../../report/page/source/dom.js";
import { fieldOf, placeToConfirm, sentenceOf } from "./faults.js";
import { choiceField, english, group, idOf, row, textField } from "./fields.js";
import { fill } from "./language.js";
import { mouldDrawing, typedMould } from "./mould.js";
import { chosenPreset, densityUnits, lawsOf, lengthUnits, otherReadings, ownMould, readingFields } from "./sheet.js";

/** @typedef {import("./module_worker.js").Fault} Fault */
/** @typedef {import("./fields.js").FormState} FormState */
/** @typedef {import("./language.js").Texts} Texts */
/** @typedef {import("./sheet.js").Preset} Preset */
/** @typedef {import("./sheet.js").Values} Values */
/** @typedef {keyof Texts & string} TextName */

/**
 * @typedef {object} SheetState
 * @property {Values} values
 * @property {Fault[]} faults of the latest attempt
 * @property {string[]} confirmed places
 * @property {boolean} busy
 */

/**
 * @typedef {object} SheetActions
 * @property {() => void} submit
 * @property {(place: string) => void} confirm
 * @property {() => void} redraw
 */

/** @param {number} cores */
export const startingValues = (cores) => ({
  mould: "abrams",
  densityUnit: "kg/m3",
  lengthUnit: "mm",
  for: "lammps",
  workers: String(cores),
});

/** @type {(names: string[]) => [string, string][]} */
const options = (names) => names.map((name) => [name, name]);

/**
 * @param {FormState} state
 * @param {Preset[]} presets
 * @param {Texts} texts
 */
function mouldPart(state, presets, texts) {
  const preset = chosenPreset(state.values, presets);
  const shape = preset?.mould ?? typedMould(state.values);
  /** @type {[string, string][]} */
  const choices = [...presets.map(({ name, title }) => /** @type {[string, string]} */ ([name, title]))];
  const own = state.values.mould === ownMould;
  return group(
    texts.material,
    textField(state, "title", texts.title, texts.titleHint),
    choiceField(state, "mould", texts.mould, [...choices, [ownMould, texts.own]], {
      hint: preset?.caution,
      redraws: true,
    }),
    own
      ? row(
          textField(state, "base", texts.base, null, { required: true, inputmode: "decimal" }),
          textField(state, "top", texts.top, null, { required: true, inputmode: "decimal" }),
          textField(state, "moulded", texts.moulded, null, { required: true, inputmode: "decimal" }),
        )
      : null,
    shape ? element("figure", {}, mouldDrawing(shape, preset?.drops ?? 0, texts)) : null,
    row(
      textField(state, "density", `${texts.density} (${texts.required})`, texts.densityHint, {
        required: true,
        inputmode: "decimal",
      }),
      choiceField(state, "densityUnit", texts.densityUnit, options(densityUnits)),
    ),
  );
}

/**
 * @param {FormState} state
 * @param {string} name
 * @param {Texts} texts
 */
const readingField = (state, name, texts) =>
  textField(state, name, texts[/** @type {"slump"} */ (name)], texts[/** @type {"slumpHint"} */ (`${name}Hint`)]);

/**
 * @param {FormState} state
 * @param {Preset | undefined} preset
 * @param {Texts} texts
 */
function readingsPart(state, preset, texts) {
  const shown = readingFields.filter(({ applies }) => applies(preset));
  const drops = preset?.drops ?? 0;
  return group(
    texts.readings,
    element("p", { class: "note" }, texts.readingsHint),
    row(choiceField(state, "lengthUnit", texts.lengthUnit, options(lengthUnits), { redraws: true })),
    row(...shown.map(({ name }) => readingField(state, name, texts))),
    drops > 0 ? row(textField(state, "drops", texts.drops, fill(texts.dropsHint, { drops }))) : null,
  );
}

/**
 * @param {FormState} state
 * @param {Preset | undefined} preset
 * @param {Texts} texts
 */
function optionalPart(state, preset, texts) {
  const read = [...readingFields, ...otherReadings].filter(({ applies }) => applies(preset));
  const deviations = read.map(({ name }) =>
    textField(state, `sd.${name}`, fill(texts.deviation, { reading: texts[/** @type {"slump"} */ (name)] })),
  );
  const laws = lawsOf[/** @type {keyof typeof lawsOf} */ (state.values.for)] ?? [];
  const others = otherReadings.filter(({ applies }) => applies(preset));
  const names = ["grains", "seed", "budget", "law", "yield-stress", ...read.map(({ name }) => `sd.${name}`), "mass"];
  const isOpen = names.some((name) => state.values[name]?.trim() || state.faults.has(name));
  return element(
    "details",
    { open: isOpen },
    element("summary", {}, texts.optional),
    row(
      choiceField(state, "law", texts.law, [["", texts.lawDefault], ...options(laws)]),
      textField(state, "grains", texts.grains, texts.grainsHint),
      textField(state, "seed", texts.seed, texts.seedHint, { inputmode: "numeric" }),
      textField(state, "budget", texts.budget, texts.budgetHint, { inputmode: "numeric" }),
    ),
    row(...others.map(({ name }) => readingField(state, name, texts)), readingField(state, "yield-stress", texts)),
    element("p", { class: "note" }, texts.deviationHint),
    row(...deviations),
  );
}

/**
 * All faults, each with a link to its field.
 * @param {SheetState} state
 * @param {SheetActions} actions
 * @param {Texts} texts
 */
export function faultList({ faults, values }, actions, texts) {
  if (faults.length === 0) return null;
  const heading = faults.length === 1 ? texts.faultsHeadingOne : fill(texts.faultsHeading, { count: faults.length });
  const items = faults.map((fault) => {
    const name = fieldOf(fault, values);
    const place = placeToConfirm(fault);
    const words = `${fault.where}: ${sentenceOf(fault)}`;
    return element(
      "li",
      {},
      name ? element("a", { href: `#${idOf(name)}`, ...english }, words) : element("span", english, words),
      place ? " " : null,
      place ? element("button", { type: "button", onclick: () => actions.confirm(place) }, texts.confirm) : null,
    );
  });
  const list = element("div", { class: "notice", id: "faults", role: "alert", tabindex: "-1" });
  list.append(element("h3", {}, heading), element("ul", {}, ...items));
  list.addEventListener("click", goToField);
  return list;
}

/** A link to a field moves the focus into it. @param {MouseEvent} event */
function goToField(event) {
  const link = /** @type {Element} */ (event.target).closest("a");
  if (!link) return;
  event.preventDefault();
  const target = document.getElementById(link.getAttribute("href")?.slice(1) ?? "");
  for (let part = target?.closest("details"); part; part = part.parentElement?.closest("details")) part.open = true;
  target?.focus();
  target?.scrollIntoView({ block: "center" });
}

/**
 * @param {SheetState} sheet
 * @param {Preset[]} presets
 * @param {SheetActions} actions
 * @param {Texts} texts
 */
export function sheetForm(sheet, presets, actions, texts) {
  /** @type {Map<string, Fault[]>} */
  const faults = new Map();
  for (const fault of sheet.faults) {
    const name = fieldOf(fault, sheet.values);
    if (name) faults.set(name, [...(faults.get(name) ?? []), fault]);
  }
  const state = { values: sheet.values, faults, redraw: actions.redraw };
  const preset = chosenPreset(sheet.values, presets);
  const programs = options(Object.keys(lawsOf));
  const form = element(
    "form",
    { novalidate: true },
    faultList(sheet, actions, texts),
    mouldPart(state, presets, texts),
    readingsPart(state, preset, texts),
    row(choiceField(state, "for", texts.for, programs, { redraws: true }), workersField(state, texts)),
    optionalPart(state, preset, texts),
    element("button", { class: "main", disabled: sheet.busy }, sheet.busy ? texts.checking : texts.calibrate),
  );
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    actions.submit();
  });
  return form;
}

/**
 * @param {FormState} state
 * @param {Texts} texts
 */
export function workersField(state, texts) {
  const hint = fill(texts.workersHint, { count: navigator.hardwareConcurrency || 1 });
  return textField(state, "workers", texts.workers, hint, { inputmode: "numeric" });
}
