// Builds the page from its content. A part that cannot be drawn says so; the others are there all the same.
import { certificatePart } from "./certificate.js";
import { element } from "./dom.js";
import { lawPart } from "./law.js";
import { openPart } from "./map.js";
import { parametersPart } from "./parameters.js";
import { provenancePart } from "./provenance.js";
import { readingsPart } from "./readings.js";
import { searchPart } from "./search.js";
import { testsPart } from "./tests.js";
import { typeInPart } from "./type_in.js";
import { missingPart, verdictPart } from "./verdict.js";

const always = () => true,
  withCard = (content) => content.tests !== undefined;
const parts = [
  ["", certificatePart, withCard],
  ["", verdictPart, always],
  ["", missingPart, always],
  ["Numbers to type in", typeInPart, withCard],
  ["Material", parametersPart, withCard],
  ["Readings", readingsPart, withCard],
  ["Test", testsPart, withCard],
  ["Contact law", lawPart, withCard],
  ["Search", searchPart, always],
  ["What is open", openPart, always],
  ["Origin", provenancePart, always],
];

function build(content) {
  const page = document.getElementById("page");
  const links = [];
  page.replaceChildren();
  for (const [name, part, applies] of parts) {
    if (!applies(content)) continue;
    let made = null;
    try {
      made = part(content);
    } catch (error) {
      console.error(error);
      made = element(
        "p",
        { class: "notice" },
        `A part of the page could not be drawn (${name || "top"}): ${error.message}`,
      );
    }
    if (!made) continue;
    page.append(made);
    if (name && made.id) links.push(element("a", { href: `#${made.id}` }, name));
  }
  document
    .getElementById("verdict")
    ?.after(
      element(
        "nav",
        { "aria-label": "Parts of the page" },
        ...links,
        element("button", { type: "button", onclick: () => print() }, "Print"),
      ),
    );
  if (content.under_way) setTimeout(() => location.reload(), 10_000);
  document.title = `${content.title ?? "calibration"} \u2013 pastefit`;
}

const source = document.getElementById("content");
try {
  build(JSON.parse(source.textContent));
} catch (error) {
  console.error(error);
  document
    .getElementById("page")
    .replaceChildren(element("p", { class: "notice" }, `The content of this page cannot be read: ${error.message}`));
}
