// Fields of the form: each with its label, a hint, and what is wrong with it.
import { element } from "../../../report/page/source/dom.js";
import { sentenceOf } from "./faults.js";

/** @typedef {import("./module_worker.js").Fault} Fault */
/** @typedef {import("../../../report/page/source/dom.js").Child} Child */

/**
 * @typedef {object} FormState what all fields of a form share
 * @property {import("./sheet.js").Values} values
 * @property {Map<string, Fault[]>} faults by the name of their field
 * @property {() => void} redraw after a choice that other fields depend on
 */

/** @param {string} name */
export const idOf = (name) => `field-${name}`;

/** The program's own words are in English, whatever the language of the page. */
export const english = { lang: "en", dir: "auto" };

/**
 * @param {string} name
 * @param {string} label
 * @param {string | null} hint
 * @param {Fault[]} faults
 * @param {(describedBy: string | null) => HTMLElement} control
 */
function field(name, label, hint, faults, control) {
  const id = idOf(name);
  const described = [hint ? `${id}-hint` : "", faults.length > 0 ? `${id}-fault` : ""].filter(Boolean).join(" ");
  return element(
    "div",
    { class: faults.length > 0 ? "field wrong" : "field" },
    element("label", { for: id }, label),
    control(described || null),
    hint ? element("small", { id: `${id}-hint` }, hint) : null,
    faults.length > 0
      ? element("div", { id: `${id}-fault`, class: "fault", ...english }, ...faults.map(faultLine))
      : null,
  );
}

/** @param {Fault} fault */
const faultLine = (fault) => element("p", {}, sentenceOf(fault));

/**
 * @param {FormState} state
 * @param {string} name
 * @param {string} label
 * @param {string | null} hint
 * @param {{required?: boolean, inputmode?: string}} more
 */
export function textField({ values, faults }, name, label, hint = null, { required, inputmode } = {}) {
  const wrong = faults.get(name) ?? [];
  return field(name, label, hint, wrong, (described) => {
    const input = element("input", {
      id: idOf(name),
      name,
      type: "text",
      value: values[name] ?? "",
      inputmode,
      autocomplete: "off",
      spellcheck: "false",
      dir: "auto",
      "aria-required": required ? "true" : null,
      "aria-describedby": described,
      "aria-invalid": wrong.length > 0 ? "true" : null,
    });
    input.addEventListener("input", () => (values[name] = input.value));
    return input;
  });
}

/**
 * @param {FormState} state
 * @param {string} name
 * @param {string} label
 * @param {[value: string, text: string][]} options
 * @param {{hint?: string, redraws?: boolean}} more
 */
export function choiceField({ values, faults, redraw }, name, label, options, { hint, redraws } = {}) {
  const wrong = faults.get(name) ?? [];
  return field(name, label, hint ?? null, wrong, (described) => {
    const chosen = (/** @type {string} */ value) => value === (values[name] ?? options[0][0]);
    const select = element(
      "select",
      { id: idOf(name), name, "aria-describedby": described, "aria-invalid": wrong.length > 0 ? "true" : null },
      ...options.map(([value, text]) => element("option", { value, selected: chosen(value) }, text)),
    );
    select.addEventListener("change", () => {
      values[name] = select.value;
      if (redraws) redraw();
    });
    return select;
  });
}

/**
 * @param {string} legend
 * @param {...(Child | Child[])} children
 */
export function group(legend, ...children) {
  return element("fieldset", {}, element("legend", {}, legend), ...children);
}

/** @param {...(Child | Child[])} fields */
export const row = (...fields) => element("div", { class: "fields" }, ...fields);
