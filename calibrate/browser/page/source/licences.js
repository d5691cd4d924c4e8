// The licences of what the page contains of others.
import { element } from "../../../report/page/source/dom.js";
import { embeddedText } from "./packed.js";

/** @param {import("./language.js").Texts} texts */
export function licencesPart(texts) {
  const text = element("pre", { class: "words", lang: "en", tabindex: "0" });
  const details = element(
    "details",
    {},
    element("summary", {}, texts.licences),
    element("p", { class: "note" }, texts.licencesLead),
    text,
  );
  details.addEventListener("toggle", async () => {
    if (details.open && !text.textContent) text.textContent = await embeddedText("licences");
  });
  return details;
}
