// Builds the page from its content. A part that cannot be drawn says so; the others are there all the same.
import { certificatePart } from "./certificate.js";
import { element } from "./dom.js";
import { lawPart } from "./law.js";
import { openPart } from "./open.js";
import { parametersPart } from "./parameters.js";
import { provenancePart } from "./provenance.js";
import { readingsPart } from "./readings.js";
import { searchPart } from "./search.js";
import { inWords } from "./sentences.js";
import { testsPart } from "./tests.js";
import { typeInPart } from "./type_in.js";
import { missingPart, verdictPart } from "./verdict.js";

/** @typedef {import("./content.js").Content} Content */
/** @typedef {import("./content.js").CardContent} CardContent */
/** @typedef {(content: Content) => HTMLElement | null} Part */

/** @type {(content: Content) => content is CardContent} */
const hasCard = (content) => content.tests !== undefined;

/**
 * A part that there is only with a card.
 * @param {(content: CardContent) => HTMLElement} part
 * @returns {Part}
 */
const ofCard = (part) => (content) => (hasCard(content) ? part(content) : null);

/** @type {[name: string, part: Part][]} */
const parts = [
  ["", ofCard(certificatePart)],
  ["", verdictPart],
  ["", missingPart],
  ["Numbers to type in", ofCard(typeInPart)],
  ["Material", ofCard(parametersPart)],
  ["Readings", ofCard(readingsPart)],
  ["Test", ofCard(testsPart)],
  ["Contact law", ofCard(lawPart)],
  ["Search", searchPart],
  ["What is open", openPart],
  ["Origin", provenancePart],
];

/** @param {unknown} error */
const saidBy = (error) => (error instanceof Error ? error.message : String(error));

/**
 * @param {string} name
 * @param {Part} part
 * @param {Content} content
 */
function made(name, part, content) {
  try {
    return part(content);
  } catch (error) {
    console.error(error);
    const said = `A part of the page could not be drawn (${name || "top"}): ${saidBy(error)}`;
    return element("p", { class: "notice" }, said);
  }
}

/**
 * @param {HTMLElement} page
 * @param {Content} content
 */
function build(page, content) {
  const links = [];
  page.replaceChildren();
  for (const [name, part] of parts) {
    const one = made(name, part, content);
    if (!one) continue;
    page.append(one);
    if (name && one.id) links.push(element("a", { href: `#${one.id}` }, name));
  }
  const button = element("button", { type: "button", onclick: () => print() }, "Print");
  const navigation = element("nav", { "aria-label": "Parts of the page" }, ...links, button);
  document.getElementById("verdict")?.after(navigation);
  if (content.under_way) setTimeout(() => location.reload(), 10_000);
  document.title = `${content.title ?? "calibration"} \u2013 pastefit`;
}

const page = document.getElementById("page") ?? document.body;
try {
  build(page, inWords(JSON.parse(document.getElementById("content")?.textContent ?? "")));
} catch (error) {
  console.error(error);
  page.replaceChildren(element("p", { class: "notice" }, `The content of this page cannot be read: ${saidBy(error)}`));
}
