// Calibrations that this browser keeps: to go on with, to look at, or to remove.
import { element, section } from "../../../report/page/source/dom.js";
import { fill, wordOf } from "./language.js";

/** @typedef {import("./language.js").Texts} Texts */
/** @typedef {import("./storage.js").Saved} Saved */

/**
 * @param {Saved[]} all
 * @param {{resume: (one: Saved) => void, show: (one: Saved) => void, remove: (one: Saved) => void}} actions
 * @param {Texts} texts
 */
export function savedList(all, actions, texts) {
  if (all.length === 0) return null;
  const items = all.map((one) => {
    const { title, simulations, status } = one;
    const state = status
      ? fill(texts.savedDone, { status: wordOf(texts.statuses, status), simulations })
      : fill(texts.savedOpen, { simulations });
    /** @type {(words: string, named: string, onclick: () => void) => HTMLElement} */
    const button = (words, named, onclick) =>
      element("button", { type: "button", "aria-label": fill(named, { title }), onclick }, words);
    return element(
      "li",
      {},
      element("div", {}, element("strong", { dir: "auto" }, title), element("small", {}, state)),
      element(
        "div",
        { class: "row" },
        status
          ? button(texts.show, texts.showNamed, () => actions.show(one))
          : button(texts.continue, texts.continueNamed, () => actions.resume(one)),
        button(texts.remove, texts.removeNamed, () => actions.remove(one)),
      ),
    );
  });
  return section("saved", texts.savedHeading, texts.savedLead, element("ul", { class: "saved" }, ...items));
}
