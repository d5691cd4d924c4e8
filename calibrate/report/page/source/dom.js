// Elements of the page. Texts become text nodes, never markup.

/** @typedef {Node | string | null | undefined} Child */
/** @typedef {string | number | boolean | null | undefined | (() => void)} Attribute */

/**
 * element("p", { class: "note" }, "text", child, ...): children that are null are left out; "on..." are listeners.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, Attribute>} attributes
 * @param {...(Child | Child[])} children
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? "" : String(value));
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
}

/**
 * A part of the page with a heading and, below it, a sentence that says what is to be seen.
 * @param {string} id
 * @param {string} heading
 * @param {string | null} lead
 * @param {...(Child | Child[])} children
 */
export function section(id, heading, lead, ...children) {
  return element(
    "section",
    { id, "aria-labelledby": `${id}-heading` },
    element("h2", { id: `${id}-heading` }, heading),
    lead ? element("p", { class: "lead" }, lead) : null,
    ...children,
  );
}

/**
 * A list of names and what belongs to each.
 * @param {[name: Child | Child[], value: Child | Child[]][]} entries
 */
export function pairs(entries, kind = "pairs") {
  const rows = entries.flatMap(([name, value]) => [
    element("dt", {}, ...[name].flat()),
    element("dd", {}, ...[value].flat()),
  ]);
  return element("dl", { class: kind }, ...rows);
}

/**
 * @param {Element} heads a row
 * @param {Element[]} rows
 * @param {Record<string, Attribute>} attributes
 */
export function table(heads, rows, attributes = {}, caption = "") {
  return element(
    "table",
    attributes,
    caption ? element("caption", {}, caption) : null,
    element("thead", {}, heads),
    element("tbody", {}, ...rows),
  );
}

/**
 * A labelled choice; `changed` is called with the value.
 * @param {string} label
 * @param {[value: string, text: string][]} options
 * @param {string} value
 * @param {(value: string) => void} changed
 */
export function choice(label, options, value, changed) {
  const select = element(
    "select",
    {},
    ...options.map(([key, text]) => element("option", { value: key, selected: key === value }, text)),
  );
  select.addEventListener("change", () => changed(select.value));
  return element("label", { class: "choice" }, element("span", {}, label), select);
}

/**
 * @param {string} label
 * @param {(on: boolean) => void} changed
 */
export function toggle(label, changed) {
  const box = element("input", { type: "checkbox" });
  box.addEventListener("change", () => changed(box.checked));
  return element("label", { class: "toggle" }, box, element("span", {}, label));
}

const narrowest = 120; // pixels; paper is laid out at less for a moment, which leaves no room between the margins

/**
 * Draws into a figure at its width, and again when that changes or `redraw` is called.
 * @param {Record<string, Attribute>} attributes
 * @param {(width: number) => Element} draw
 * @param {...Child} after
 */
export function figure(attributes, draw, ...after) {
  const place = element("div", { class: "drawing" });
  let width = 0;
  const redraw = () => {
    if (width > 0) place.replaceChildren(draw(width));
  };
  new ResizeObserver(([entry]) => {
    const now = Math.round(entry.contentRect.width);
    if (now === width || now < narrowest) return;
    width = now;
    redraw();
  }).observe(place);
  return Object.assign(element("figure", attributes, place, ...after), { redraw });
}
