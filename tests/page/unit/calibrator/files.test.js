import assert from "node:assert/strict";
import { gzipSync } from "node:zlib";
import { test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { archiveOf, filesOf, folderName } from "../../../../calibrate/browser/page/source/files.js";
import { ModuleWorker, Refusal, WorkerDied } from "../../../../calibrate/browser/page/source/module_worker.js";
import { unpacked } from "../../../../calibrate/browser/page/source/packed.js";
import { remainingSeconds } from "../../../../calibrate/browser/page/source/live.js";

test("an archive has every file, to the last letter", () => {
  const files = [
    { name: "lab.json", text: '{"title": "Mörtel"}\n' },
    { name: "lammps/in.slump", text: "" },
  ];
  const read = unzipSync(archiveOf("a-mix", files));
  assert.deepEqual(
    Object.entries(read).map(([name, content]) => [name, strFromU8(content)]),
    files.map(({ name, text }) => [`a-mix/${name}`, text]),
  );
});

test("a folder is named after its title, by letters that every system takes", () => {
  assert.equal(folderName("Mörtel Nr. 7"), "mortel-nr-7");
  assert.equal(folderName("../../<script>"), "script");
  assert.equal(folderName("\u202e"), "pastefit");
  assert.ok(folderName("long ".repeat(100)).length <= 40);
});

test("a result without a card has no file of one", () => {
  const result = { status: "failed", reason: "", card: null, summary: null, report: "<p>why" };
  const names = filesOf({ lab: "{}", study: "{}" }, result).map(({ name }) => name);
  assert.deepEqual(names, ["lab.json", "study.json", "result/report.html"]);
});

test("what the build packed is unpacked to the same bytes", async () => {
  const bytes = Uint8Array.from({ length: 1000 }, (_, k) => (k * k) % 256);
  const text = gzipSync(bytes).toString("base64");
  assert.deepEqual(new Uint8Array(await unpacked(`\n${text}\n`)), bytes);
});

test("the rest of the budget takes as long as what was simulated in this session", () => {
  const progress = { phase: "search", simulations: 50, budget: 150, best_error: 1, readings: [] };
  assert.equal(remainingSeconds(10, 20, progress), 200);
  assert.equal(remainingSeconds(0, 20, progress), null);
});

/** A thread that answers when it is asked to by the test. */
class FakeThread extends EventTarget {
  ended = false;
  /** @type {any[]} */
  sent = [];
  postMessage(/** @type {any} */ message) {
    this.sent.push(message);
  }
  terminate() {
    this.ended = true;
  }
  /** @param {any} data */
  answer(data) {
    this.dispatchEvent(Object.assign(new Event("message"), { data }));
  }
}

const compiled = /** @type {WebAssembly.Module} */ ({});

test("answers reach the calls that asked, in any order", async () => {
  const thread = new FakeThread();
  const worker = new ModuleWorker(thread, compiled);
  const [first, second] = [worker.call("version", {}), worker.call("new", {})];
  thread.answer({ id: 2, answer: { faults: [{ where: "mould", what: "is missing", remedy: "give one" }] } });
  thread.answer({ id: 1, answer: { ok: 7 } });
  assert.equal(await first, 7);
  await assert.rejects(second, Refusal);
  assert.deepEqual(
    thread.sent.map(({ module, name }) => name ?? Boolean(module)),
    [true, "version", "new"],
  );
});

test("all calls of a worker that died fail, those to come too", async () => {
  const thread = new FakeThread();
  const worker = new ModuleWorker(thread, compiled);
  const waiting = worker.call("simulate", {});
  thread.answer({ id: 1, died: "memory access out of bounds" });
  await assert.rejects(waiting, /out of bounds/);
  await assert.rejects(worker.call("simulate", {}), WorkerDied);
  assert.ok(thread.ended);
});

test("an answer that is neither a result nor faults ends the worker", async () => {
  const thread = new FakeThread();
  const waiting = new ModuleWorker(thread, compiled).call("simulate", {});
  thread.answer({ id: 1, answer: {} });
  await assert.rejects(waiting, WorkerDied);
});
