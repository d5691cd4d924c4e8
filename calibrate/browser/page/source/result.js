// What came out: the verdict first, then the files, the summary and the report.
import { element, section } from "../../../report/page/source/dom.js";
import { duration } from "../../../report/page/source/numbers.js";
import { english } from "./fields.js";
import { archiveOf, filesOf, folderName, save, targets } from "./files.js";
import { fill, wordOf } from "./language.js";
import { Refusal } from "./module_worker.js";
import { wholeNumber } from "./sheet.js";

/** @typedef {import("./files.js").Result} Result */
/** @typedef {import("./files.js").TextFile} TextFile */
/** @typedef {import("./language.js").Texts} Texts */
/** @typedef {import("./storage.js").Saved} Saved */

/**
 * @typedef {object} ResultActions
 * @property {(target: string) => Promise<TextFile[]>} exported its files; a Refusal where the target lacks the law
 * @property {(budget?: number) => void} resume with as many simulations at most
 * @property {() => void} restart
 */

/** @type {Record<string, string>} */
const kinds = { confirmed: "meets", failed: "fails", out_of_reach: "fails" };

/**
 * @param {Saved} saved
 * @param {Result} result
 * @param {ResultActions} actions
 * @param {Texts} texts
 */
function verdictPart(saved, { status, reason, card }, actions, texts) {
  const hint = Object.hasOwn(texts.statusHints, status) ? wordOf(texts.statusHints, status) : null;
  const time = duration(Math.round(saved.seconds));
  const took = fill(texts.took, { simulations: saved.simulations, time, seed: saved.seed ?? seedOf(card) });
  const badge = { confirmed: "\u2713", failed: "\u2715", out_of_reach: "\u2715" }[status] ?? "!";
  return element(
    "section",
    { id: "verdict", class: kinds[status] ?? "reserved", "aria-labelledby": "verdict-heading" },
    element("h1", { id: "verdict-heading", tabindex: "-1", dir: "auto" }, saved.title),
    element(
      "div",
      { class: "answer" },
      element("span", { class: "badge", "aria-hidden": "true" }, badge),
      element(
        "div",
        {},
        element("strong", {}, wordOf(texts.statuses, status)),
        hint ? element("p", {}, hint) : null,
        reason ? element("p", english, reason) : null,
        element("p", { class: "note" }, took),
      ),
    ),
    element(
      "div",
      { class: "row" },
      ...(status === "confirmed" ? [] : resumePart(saved, actions, texts)),
      button(texts.newSheet, actions.restart),
    ),
  );
}

/**
 * A search that has used up its simulations goes on with more.
 * @param {Saved} saved
 * @param {ResultActions} actions
 * @param {Texts} texts
 */
function resumePart({ budget, simulations }, actions, texts) {
  const most = element("input", {
    type: "number",
    min: 1,
    id: "more",
    value: budget ?? Math.max(150, 2 * simulations),
  });
  const resume = () => actions.resume(wholeNumber(most.value));
  return [button(texts.resume, resume, texts.resumeHint), element("label", { class: "choice" }, texts.budget, most)];
}

/**
 * @param {string} words
 * @param {() => void} onclick
 * @param {string | null} title
 */
const button = (words, onclick, title = null) => element("button", { type: "button", onclick, title }, words);

/** @param {string | null} card */
const seedOf = (card) => String(card ? (JSON.parse(card).search?.seed ?? 1) : 1);

/**
 * The files of a target, once they are asked for.
 * @param {string} target
 * @param {string} folder
 * @param {ResultActions} actions
 * @param {Texts} texts
 */
function targetPart(target, folder, actions, texts) {
  const name = wordOf(texts.targets, target);
  const place = element("div", { "aria-live": "polite" }, element("p", { class: "note" }, texts.preparing));
  const details = element("details", { class: "target" }, element("summary", {}, name), place);
  let asked = false;
  details.addEventListener("toggle", async () => {
    if (!details.open || asked) return;
    asked = true;
    try {
      const files = await actions.exported(target);
      const archive = () => save(`${folder}-${target}.zip`, archiveOf(`${folder}-${target}`, files));
      place.replaceChildren(
        button(fill(texts.target, { target: name }), archive),
        element("ul", { class: "files" }, ...files.map((file) => element("li", {}, fileButton(file)))),
      );
    } catch (error) {
      place.replaceChildren(element("p", english, fill(texts.notExported, { target: name, why: saidBy(error) })));
    }
  });
  return details;
}

/** @param {TextFile} file */
const fileButton = (file) => button(file.name, () => save(file.name, file.text));

/** @param {unknown} error */
const saidBy = (error) => (error instanceof Error ? error.message : String(error));

/**
 * All files of all targets; of a target that the card's law does not exist in, none.
 * @param {TextFile[]} files
 * @param {ResultActions} actions
 */
async function everything(files, actions) {
  const all = [...files];
  for (const target of targets) {
    try {
      for (const { name, text } of await actions.exported(target)) all.push({ name: `${target}/${name}`, text });
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
    }
  }
  return all;
}

/**
 * @param {Saved} saved
 * @param {Result} result
 * @param {ResultActions} actions
 * @param {Texts} texts
 */
function downloadsPart(saved, result, actions, texts) {
  const folder = folderName(saved.title);
  const files = filesOf(saved, result);
  const fault = element("p", { class: "notice", role: "alert", hidden: true });
  const all = button(texts.all, async () => {
    all.disabled = true;
    all.textContent = texts.preparing;
    try {
      save(`${folder}.zip`, archiveOf(folder, await everything(files, actions)));
    } catch (error) {
      fault.textContent = saidBy(error);
      fault.hidden = false;
    }
    all.disabled = false;
    all.textContent = texts.all;
  });
  all.className = "main";
  return section(
    "downloads",
    texts.downloads,
    texts.downloadsLead,
    element("p", {}, all),
    fault,
    element("ul", { class: "files" }, ...files.map((file) => element("li", {}, fileButton(file)))),
    ...(result.card ? targets.map((target) => targetPart(target, folder, actions, texts)) : []),
  );
}

/**
 * The report runs scripts of its own, with no access to this page.
 * @param {string} report
 * @param {Texts} texts
 */
function reportPart(report, texts) {
  if (!report) return null;
  const open = () => {
    const address = URL.createObjectURL(new Blob([report], { type: "text/html;charset=utf-8" }));
    window.open(address, "_blank", "noopener");
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
  };
  const frame = element("iframe", {
    title: texts.reportFrame,
    sandbox: "allow-scripts allow-modals",
    srcdoc: report,
    class: "report",
  });
  return section("report", texts.report, null, element("p", {}, button(texts.reportTab, open)), frame);
}

/**
 * @param {Saved} saved
 * @param {Result} result
 * @param {ResultActions} actions
 * @param {Texts} texts
 */
export function resultView(saved, result, actions, texts) {
  return [
    verdictPart(saved, result, actions, texts),
    downloadsPart(saved, result, actions, texts),
    result.summary
      ? section("summary", texts.summary, null, element("pre", { tabindex: "0", ...english }, result.summary))
      : null,
    reportPart(result.report, texts),
  ].filter((one) => one !== null);
}
