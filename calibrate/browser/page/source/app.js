// What the page does: from the form to a run to its result, in the language that is chosen.
import { choice, element, section } from "../../../report/page/source/dom.js";
import { Calibration } from "./calibration.js";
import { english } from "./fields.js";
import { sheetForm, startingValues } from "./form.js";
import { languageOf, languages, textsOf } from "./language.js";
import { licencesPart } from "./licences.js";
import { liveView } from "./live.js";
import { withLock } from "./lock.js";
import { Refusal } from "./module_worker.js";
import { resultView } from "./result.js";
import { savedList } from "./saved_list.js";
import { sheetOf } from "./saved_sheet.js";
import { faultsOfNumbers, requestOf, wholeNumber } from "./sheet.js";

/** @typedef {import("./files.js").Result} Result */
/** @typedef {import("./files.js").TextFile} TextFile */
/** @typedef {import("./form.js").SheetState} SheetState */
/** @typedef {import("./module_worker.js").Caller} Caller */
/** @typedef {import("./sheet.js").Preset} Preset */
/** @typedef {import("./storage.js").Saved} Saved */
/** @typedef {import("./storage.js").Storage} Storage */
/** @typedef {{lab: string, study: string, notes?: string[]}} Sheet */

const most = 256; // workers

/** @param {unknown} error */
const saidBy = (error) => (error instanceof Error ? error.message : String(error));

export class App {
  /**
   * @param {HTMLElement} place
   * @param {() => Caller} openWorker
   * @param {Storage | null} storage
   * @param {Preset[]} presets
   */
  constructor(place, openWorker, storage, presets) {
    this.place = place;
    this.openWorker = openWorker;
    this.storage = storage;
    this.presets = presets;
    this.desk = openWorker(); // checks sheets, and writes exports
    this.language = languageOf(navigator.languages ?? [navigator.language]);
    /** @type {SheetState} */
    this.sheet = { values: startingValues(navigator.hardwareConcurrency || 1), faults: [], confirmed: [], busy: false };
    /** @type {Saved[]} */
    this.saved = [];
    this.notice = "";
    /** @type {Calibration | null} */
    this.calibration = null;
    /** @type {string[]} */
    this.notes = [];
    /** @type {() => Node[]} what is shown below the head */
    this.view = () => this.start();
  }

  get texts() {
    return textsOf(this.language);
  }

  /** @param {string} name @param {unknown} request */
  async ask(name, request) {
    try {
      return await this.desk.call(name, request);
    } catch (error) {
      if (error instanceof Refusal) throw error;
      this.desk = this.openWorker(); // once more in a new one: the old one may have run out of memory
      return this.desk.call(name, request);
    }
  }

  /**
   * Does what a button asks for; what goes wrong is said on the first view.
   * @param {() => Promise<void>} work
   */
  async attempt(work) {
    try {
      await work();
    } catch (error) {
      console.warn(error);
      this.notice = saidBy(error);
      this.show(() => this.start());
    }
  }

  async home() {
    this.calibration = null;
    this.saved = (await this.storage?.all()) ?? [];
    this.show(() => this.start());
  }

  /**
   * Shows another view, and moves the focus to its heading.
   * @param {() => Node[]} view
   */
  show(view) {
    this.view = view;
    this.draw();
    /** @type {HTMLElement | null} */ (this.place.querySelector("main h1[tabindex]"))?.focus();
    scrollTo(0, 0);
  }

  /** Draws the view anew; the focus stays on the field that has it. */
  draw() {
    const { id } = document.activeElement ?? { id: "" };
    document.documentElement.lang = this.language;
    const texts = this.texts;
    const main = element("main", { id: "content" }, ...this.view());
    this.place.replaceChildren(
      element("a", { class: "skip", href: "#content" }, texts.skip),
      element(
        "header",
        {},
        element("p", { class: "brand" }, "pastefit"),
        choice(texts.language, languages, this.language, (value) => this.speak(value)),
      ),
      main,
      element("footer", {}, licencesPart(texts)),
    );
    if (id) document.getElementById(id)?.focus({ preventScroll: true });
  }

  /** @param {string} language */
  speak(language) {
    this.language = /** @type {import("./language.js").Language} */ (language);
    this.draw();
    /** @type {HTMLElement | null} */ (this.place.querySelector("header select"))?.focus();
  }

  /** @returns {Node[]} */
  start() {
    const texts = this.texts;
    const kept = {
      resume: (/** @type {Saved} */ one) => this.attempt(() => this.resume(one)),
      show: (/** @type {Saved} */ one) => this.attempt(() => this.showSaved(one)),
      remove: (/** @type {Saved} */ one) => this.attempt(() => this.remove(one)),
    };
    const actions = {
      submit: () => this.submit(),
      confirm: (/** @type {string} */ place) => {
        this.sheet.confirmed.push(place);
        this.submit();
      },
      redraw: () => this.draw(),
    };
    const parts = [
      element("h1", { tabindex: "-1" }, "pastefit"),
      element("p", { class: "lead" }, texts.lead),
      this.notice ? element("p", { class: "notice", role: "alert", ...english }, this.notice) : null,
      this.storage ? null : element("p", { class: "notice" }, texts.notKept),
      savedList(this.saved, kept, texts),
      section("sheet", texts.sheetHeading, texts.sheetLead, sheetForm(this.sheet, this.presets, actions, texts)),
      this.filesPart(),
    ];
    return parts.filter((one) => one !== null);
  }

  filesPart() {
    const texts = this.texts;
    const said = element("p", { role: "status" });
    const input = element("input", { id: "files", type: "file", accept: ".json,application/json", multiple: true });
    input.addEventListener("change", async () => {
      const contents = await Promise.all([...(input.files ?? [])].map((file) => file.text()));
      input.value = "";
      const sheet = sheetOf(contents);
      if (typeof sheet === "string") said.textContent = texts[sheet];
      else await this.attempt(() => this.begin(sheet, (faults) => (said.textContent = new Refusal(faults).message)));
    });
    const label = element("label", { for: "files" }, texts.files);
    return section(
      "saved-sheet",
      texts.filesHeading,
      texts.filesLead,
      element("div", { class: "field" }, label, input),
      said,
    );
  }

  get workers() {
    const typed = Math.round(Number(this.sheet.values.workers));
    return Math.min(most, Math.max(1, typed || navigator.hardwareConcurrency || 1));
  }

  async submit() {
    const { sheet } = this;
    if (sheet.busy) return;
    sheet.faults = faultsOfNumbers(sheet.values, this.texts);
    if (sheet.faults.length > 0) return this.showFaults();
    sheet.busy = true;
    this.notice = "";
    this.draw();
    try {
      const made = await this.ask("new", requestOf(sheet.values, this.presets, sheet.confirmed));
      await this.begin(made, (faults) => (sheet.faults = faults));
    } catch (error) {
      if (error instanceof Refusal) sheet.faults = error.faults;
      else this.notice = saidBy(error);
    }
    sheet.busy = false;
    if (!this.calibration) this.showFaults();
  }

  showFaults() {
    this.draw();
    document.getElementById("faults")?.focus();
  }

  /**
   * Begins a calibration, or says what is wrong with its files.
   * @param {Sheet} sheet
   * @param {(faults: import("./module_worker.js").Fault[]) => void} refused
   */
  async begin({ lab, study, notes = [] }, refused) {
    const { seed, budget } = this.sheet.values;
    const begun = new Date().toISOString();
    /** @type {Omit<Saved, "id">} */
    const wanted = { title: "", lab, study, begun, seconds: 0, simulations: 0 };
    Object.assign(wanted, { seed: wholeNumber(seed), budget: wholeNumber(budget) });
    const calibration = new Calibration({ ...wanted, id: 0 }, [], this.openWorker, this.storage, this.workers);
    try {
      calibration.saved.title = (await calibration.open()).title;
      if (this.storage)
        calibration.saved.id = (await this.storage.add({ ...wanted, title: calibration.saved.title })).id;
    } catch (error) {
      calibration.end();
      if (!(error instanceof Refusal)) throw error;
      return refused(error.faults);
    }
    this.notes = notes;
    this.run(calibration);
  }

  /** @param {Saved} saved */
  async resume(saved) {
    const records = (await this.storage?.records(saved.id)) ?? this.calibration?.records ?? [];
    const again = { ...saved, status: undefined };
    const calibration = new Calibration(again, records, this.openWorker, this.storage, this.workers);
    this.notes = [];
    try {
      await calibration.open();
    } catch (error) {
      calibration.end();
      this.notice = saidBy(error);
      return this.home();
    }
    this.run(calibration);
  }

  /** @param {Calibration} calibration */
  async run(calibration) {
    this.calibration = calibration;
    const wasFree = await withLock(`pastefit-${calibration.saved.id || calibration.saved.begun}`, async () => {
      this.show(() => this.running(calibration));
      const ticking = setInterval(() => calibration.changed(), 1000);
      try {
        const result = await calibration.run();
        await this.storage?.finish(calibration.saved, result);
        this.show(() => this.ended(calibration.saved, result));
      } catch (error) {
        console.warn(error);
        this.show(() => this.failed(calibration, saidBy(error)));
      }
      clearInterval(ticking);
    });
    if (wasFree) return;
    calibration.end();
    this.notice = this.texts.inOtherTab;
    await this.home();
  }

  /** @param {Calibration} calibration */
  running(calibration) {
    const texts = this.texts;
    const state = () => ({
      title: calibration.saved.title,
      notes: this.notes,
      progress: calibration.progress,
      outline: calibration.outline,
      seconds: calibration.before.seconds + calibration.session,
      remaining: calibration.remaining,
      deaths: calibration.pool.deaths,
      stopping: calibration.stopping,
    });
    const actions = {
      stop: () => calibration.stop(),
      resize: (/** @type {string} */ text) => {
        this.sheet.values.workers = text;
        calibration.pool.resize(this.workers);
        calibration.loop.wake();
      },
      workers: String(this.workers),
    };
    const lost = element("p", { class: "notice", role: "alert", hidden: true });
    const live = liveView(state(), actions, texts);
    calibration.changed = () => {
      live.update(state());
      lost.hidden = calibration.lost === null;
      lost.textContent = texts.keptFailed.replace("{why}", () => calibration.lost ?? "");
    };
    return [lost, live];
  }

  /**
   * @param {Calibration} calibration
   * @param {string} why
   */
  failed(calibration, why) {
    const texts = this.texts;
    const resume = () => void this.attempt(() => this.resume(calibration.saved));
    const restart = () => void this.attempt(() => this.home());
    return [
      element(
        "section",
        { id: "failed", class: "fails" },
        element("h1", { tabindex: "-1" }, texts.failedHeading),
        element("p", { class: "notice", ...english }, why),
        element("p", {}, texts.failedHint),
        element(
          "div",
          { class: "row" },
          element("button", { class: "main", type: "button", onclick: resume }, texts.resume),
          element("button", { type: "button", onclick: restart }, texts.newSheet),
        ),
      ),
    ];
  }

  /**
   * @param {Saved} saved
   * @param {Result} result
   */
  ended(saved, result) {
    document.title = `${saved.title} \u2013 pastefit`;
    /** @type {Map<string, Promise<TextFile[]>>} */
    const exports = new Map();
    const unconfirmed = result.status !== "confirmed"; // the page has said so on top
    const actions = {
      exported: (/** @type {string} */ target) => {
        const made =
          exports.get(target) ??
          this.ask("export", { card: result.card, target, unconfirmed }).then(({ files }) => files);
        exports.set(target, made);
        return made;
      },
      resume: (/** @type {number | undefined} */ budget) =>
        void this.attempt(() => this.resume({ ...saved, budget: budget ?? saved.budget })),
      restart: () => void this.attempt(() => this.home()),
    };
    return resultView(saved, result, actions, this.texts);
  }

  /** @param {Saved} saved */
  async showSaved(saved) {
    const result = await this.storage?.result(saved.id);
    if (result) this.show(() => this.ended(saved, result));
    else await this.resume(saved);
  }

  /** @param {Saved} saved */
  async remove(saved) {
    await this.storage?.remove(saved.id);
    await this.home();
  }
}
