// The tables of a page and its still pictures, in a browser: node --test tables.test.js, with
//   PASTEFIT_PAGE   the page of a calibration that ended
//   PASTEFIT_DROP   the page of a drop test
//   PASTEFIT_SHOTS  a folder for pictures, to be looked at by a person
//   PASTEFIT_PARTS  folders of calibrations with report.html of all; sheared.html: one with a heap that sheared off
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { contentOf, openBrowser, openPage, withoutWebGL } from "./browser.js";

const {
  PASTEFIT_PAGE: file = "",
  PASTEFIT_DROP: dropped = "",
  PASTEFIT_PARTS: parts = "",
  PASTEFIT_SHOTS: shots = "",
} = process.env;
const card = JSON.parse(readFileSync(join(file, "../card.json"), "utf8"));
/** @type {import("playwright-core").Browser} */
let browser;
/** @type {import("./browser.js").OpenedPage} */
let page;

before(async () => {
  browser = await openBrowser();
  page = await openPage(browser, file);
  await page.locator("h1").waitFor();
});
after(async () => browser.close());

test("the numbers to type in are copied, and saved as CSV, as the table shows them", async () => {
  const { type_in: groups } = await contentOf(page);
  const values = groups.flatMap(({ rows }) => rows.map(({ quantity, value }) => `${quantity} ${value}`));
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.getByRole("button", { name: "Copy the table" }).press("Enter");
  await page.locator("#type-in [role=status]").filter({ hasText: "Copied" }).waitFor();
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  const rows = copied.trimEnd().split("\n").slice(1);
  assert.deepEqual(
    rows.map((row) => row.split("\t").slice(1, 3).join(" ")),
    values,
  );
  const saved = page.waitForEvent("download");
  await page.getByRole("link", { name: "Save as CSV" }).click();
  const csv = await saved;
  assert.equal(csv.suggestedFilename(), "numbers-to-type-in.csv");
  const lines = readFileSync(await csv.path(), "utf8")
    .trimEnd()
    .split("\r\n");
  assert.equal(lines.length, 1 + values.length);
});

test("without a clipboard the table to type in is selected, to be copied by hand", async () => {
  const other = await openPage(browser, file, {}, (one) =>
    one.addInitScript(() => Object.defineProperty(navigator, "clipboard", { value: undefined })),
  );
  await other.getByRole("button", { name: "Copy the table" }).click();
  assert.match(await other.evaluate(() => String(getSelection())), /sliding friction\t/);
  await other.context().close();
});

test("no part of the page but commands, files and the terminal's words names a parameter by its key", async () => {
  const { parameters } = await contentOf(page);
  const keys = parameters.map(({ name }) => name).filter((name) => name.includes("_"));
  const named = await page.evaluate((names) => {
    const shown = /** @type {HTMLElement} */ (document.getElementById("page")?.cloneNode(true));
    for (const one of shown.querySelectorAll("code, #provenance")) one.remove();
    return names.filter((name) => shown.textContent?.includes(name));
  }, keys);
  assert.deepEqual(named, []);
  const heads = await page.locator("#parameters tbody th").allInnerTexts();
  assert.match(heads[0], /^strength \[Pa\]\n.*\nin files: strength_pa$/);
  assert.match(await page.locator("#verdict").innerText(), /strength [\d.e]+ Pa/);
});

test("a fifth more of each parameter has its effect on each measured reading beside it, with an error", async () => {
  const { inference } = await contentOf(page);
  const told = inference?.sensitivities ?? [];
  assert.ok(told.length > 0);
  const rows = page.locator(".sensitivities tbody tr");
  assert.equal(await rows.count(), told.length);
  const known = told.findIndex(({ changes }) => Object.keys(changes).length > 0);
  const text = await rows.nth(known).innerText();
  assert.match(text, /^strength \+20 %\t[\d.e]+ to [\d.e]+ Pa\t[+\u2212]?[\d.]+ \u00b1 [\d.]+ mm$/);
});

test("a sensitivity is near to what simulations give: a rebound goes with the restitution squared", async () => {
  const other = await openPage(browser, dropped);
  const { inference, tests } = await contentOf(other);
  await other.context().close();
  const { from, to, changes } =
    inference?.sensitivities?.find(({ parameter }) => parameter === "restitution") ?? assert.fail("there is none");
  const height = tests[0].readings.find(({ name }) => name === "level.rebound_height_mm")?.simulated ?? NaN;
  const [change, deviation] = changes["level.rebound_height_mm"];
  const expected = height * ((to / from) ** 2 - 1);
  assert.ok(Math.abs(change - expected) < 3 * deviation, `${change} \u00b1 ${deviation}, ${expected} expected`);
});

test("every heap that confirms stands by itself over the measured one, sheared ones marked", async () => {
  const { verdict } = await contentOf(page);
  const other = await openPage(browser, join(parts, "sheared.html"));
  for (const [shown, mark] of /** @type {const} */ ([
    [page, ""],
    [other, " \u2717 sheared off"],
  ])) {
    const heaps = shown.locator(".heaps").first().locator("li");
    const said = verdict.packings.map((packing, k) => `packing ${packing}${k === 0 ? mark : ""}`);
    assert.deepEqual(await heaps.allInnerTexts(), said);
    assert.equal(await heaps.locator("polyline.own").count(), said.length);
    assert.equal(await shown.locator(".heaps li:not(:has(.read))").count(), 0, "each with what the laboratory read");
  }
  assert.match((await other.locator(".heaps svg").first().getAttribute("aria-label")) ?? "", /sheared off/);
  await other.context().close();
});

test("without WebGL the page says so, shows the heap in a still picture, and the rest", async () => {
  const other = await openPage(browser, file, {}, withoutWebGL);
  await other.locator(".notice").filter({ hasText: "The film cannot be shown here" }).waitFor();
  assert.equal(await other.locator("canvas.stage").count(), 0);
  await other.locator("canvas.still").waitFor();
  const shown = await other.locator("canvas.still").evaluate((canvas) => {
    const { width, height } = /** @type {HTMLCanvasElement} */ (canvas);
    const pen = /** @type {HTMLCanvasElement} */ (canvas).getContext("2d");
    const bytes = pen?.getImageData(0, 0, width, height).data.buffer ?? new ArrayBuffer(0);
    const pixels = [...new Uint32Array(bytes)];
    return { colours: new Set(pixels).size, drawn: pixels.filter((one) => one !== 0).length / pixels.length };
  });
  assert.ok(shown.colours > 50 && shown.drawn > 0.1, JSON.stringify(shown));
  if (shots)
    await other
      .locator(".player")
      .first()
      .screenshot({ path: join(shots, "still.png") });
  assert.ok((await other.locator(".readings tbody tr").count()) > 0);
  await other.context().close();
});

test("the page of a folder has a row for each calibration, with verdict, sheared share and prediction", async () => {
  const other = await openPage(browser, join(parts, "report.html"), { viewport: { width: 390, height: 844 } });
  const heads = await other.locator("thead th").allInnerTexts();
  for (const head of ["verdict", "sheared_share", "prediction"]) assert.ok(heads.includes(head), head);
  const cells = await other
    .locator("tbody tr")
    .evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent ?? "")));
  const rows = new Map(cells.map((texts) => [texts[0], new Map(texts.map((text, k) => [heads[k], text]))]));
  assert.deepEqual([...rows.keys()].sort(), ["1", "2", "3", "4", "5", "6", "7"]);
  assert.equal(rows.get("1")?.get("verdict"), card.search.status);
  assert.equal(rows.get("2")?.get("verdict"), "unfinished", "a store alone");
  assert.equal(rows.get("3")?.get("verdict"), "failed", "a damaged card");
  assert.equal(rows.get("1")?.get("sheared_share"), "0");
  assert.equal(rows.get("7")?.get("sheared_share"), String(1 / card.confirmation.packings.length));
  assert.equal(rows.get("5")?.get("title"), "</script><script>alert(1)</script><img src=x onerror=alert(2)> &lt;b&gt;");
  const [wide, window] = await other.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  assert.ok(wide <= window, `${wide} pixels in a window of ${window}`);
  await other.getByRole("link", { name: "1", exact: true }).click();
  await other.locator("#verdict").waitFor();
  assert.deepEqual(other.faults, []);
  await other.context().close();
});
