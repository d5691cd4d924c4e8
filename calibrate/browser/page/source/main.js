// Starts the page: unpacks the module, and shows the form.
import { element } from "../../../report/page/source/dom.js";
import { App } from "./app.js";
import { languageOf, textsOf } from "./language.js";
import { ModuleWorker } from "./module_worker.js";
import { embeddedModule } from "./packed.js";
import { presetsOf } from "./sheet.js";
import { Storage } from "./storage.js";

const place = document.getElementById("page") ?? document.body;
const texts = textsOf(languageOf(navigator.languages));

/** @param {string} words @param {string} kind */
const say = (words, kind) =>
  place.replaceChildren(element("main", {}, element("p", { class: kind, role: "status" }, words)));

async function start() {
  say(texts.loading, "lead");
  const { address, compiled } = await embeddedModule();
  const openWorker = () => new ModuleWorker(new Worker(address), compiled);
  const first = openWorker();
  const [storage, presets] = await Promise.all([Storage.open(), first.call("presets", {})]);
  first.end();
  await new App(place, openWorker, storage, presetsOf(presets)).home();
}

start().catch((error) => {
  console.error(error);
  const why = error instanceof Error ? error.message : String(error);
  say(
    texts.cannotStart.replace("{why}", () => why),
    "notice",
  );
});
