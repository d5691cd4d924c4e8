// The page that calibrates with its real module: node --test module.test.js, with
//   PASTEFIT_CALIBRATOR  the page
//   PASTEFIT_TOY         the folder with a study that is quick to simulate, coarse-lab.json and coarse-study.json
//   PASTEFIT_SHOTS       a folder for pictures of the page, to be looked at by a person
import assert from "node:assert/strict";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { textsOf } from "../../../calibrate/browser/page/source/language.js";
import { openBrowser } from "../browser.js";
import { calibrate, onPageOf, saved, verdict } from "./on_page.js";

/** @typedef {import("../browser.js").OpenedPage} OpenedPage */

const { PASTEFIT_CALIBRATOR: file = "", PASTEFIT_TOY: toy = "", PASTEFIT_SHOTS: shots = "" } = process.env;
const minutes = 60_000;
const hostile = `</script><img src=x onerror=alert(1)>"'\u202egnp`;

/** @type {import("playwright-core").Browser} */
let browser;
before(async () => {
  browser = await openBrowser();
});
after(async () => browser.close());

/** @type {(use: (page: OpenedPage) => Promise<void>, options?: object) => Promise<void>} */
const onPage = (use, options) => onPageOf(browser, file, use, options);

/**
 * Opens the toy's files under another title, and begins.
 * @param {OpenedPage} page
 * @param {string} title
 */
async function calibrateToy(page, title) {
  await page.locator("#field-workers").fill("2");
  const files = ["lab", "study"].map((kind) => {
    const content = JSON.parse(readFileSync(join(toy, `coarse-${kind}.json`), "utf8"));
    const text = JSON.stringify({ ...content, title });
    return { name: `${kind}.json`, mimeType: "application/json", buffer: Buffer.from(text) };
  });
  await page.locator("#files").setInputFiles(files);
}

/**
 * Until so many simulations are done.
 * @param {OpenedPage} page
 * @param {number} count
 */
const simulated = (page, count) =>
  page.waitForFunction(
    (least) => Number(document.querySelector("progress")?.getAttribute("value") ?? 0) >= least,
    count,
    { timeout: 10 * minutes },
  );

/**
 * All files of a result, by their names in the archive's folder.
 * @param {OpenedPage} page
 * @param {string} button
 */
async function archive(page, button) {
  const all = unzipSync((await saved(page, button, 10 * minutes)).content);
  return Object.fromEntries(Object.entries(all).map(([name, one]) => [name.replace(/^[^/]*\//, ""), strFromU8(one)]));
}

test("the program's checks reach the form", () =>
  onPage(async (page) => {
    await calibrate(page, { density: "2.35", slump: "180, 175, 190" });
    await page.locator("#faults").waitFor();
    assert.match((await page.locator("#field-density-fault").textContent()) ?? "", /2\.35 kg\/l are 2350 kg\/m3/);
    await page.locator("#field-density").fill("2350");
    await page.locator("#field-slump").fill("180, 140, 260");
    await page.locator("form button.main").click();
    await page.locator("#field-slump-fault").filter({ hasText: "repeatability" }).waitFor();
  }));

test("a folder of the program becomes a card, with all its files", () =>
  onPage(async (page) => {
    await calibrateToy(page, "toy");
    const said = await verdict(page, 15 * minutes);
    await page.frameLocator("iframe.report").locator("h1").waitFor({ timeout: minutes });
    if (shots) await page.screenshot({ path: join(shots, "module-result.png"), fullPage: true });
    const files = await archive(page, "Everything as one .zip");
    const card = JSON.parse(files["result/card.json"]);
    assert.equal(card.title, "toy");
    assert.equal(said, textsOf("en").statuses[/** @type {"confirmed"} */ (card.search.status)]);
    assert.equal(card.confirmation.meets_laboratory, card.search.status === "confirmed");
    const names = Object.keys(files);
    for (const start of ["lab.json", "study.json", "result/report.html", "result/summary.txt", "lammps/in.", "yade/"])
      assert.ok(
        names.some((name) => name.startsWith(start)),
        `${start} of ${names.join(" ")}`,
      );
  }));

test("a hostile title survives a reload and a stop in the middle of a calibration, in German on a phone", () =>
  onPage(
    async (page) => {
      await calibrateToy(page, hostile);
      await simulated(page, 3);
      await page.reload();
      await page.getByText("unterbrochen nach").waitFor();
      await page.locator("#saved button").first().click();
      await simulated(page, 5);
      await page.locator("#run button.main").click();
      assert.equal(await verdict(page, 5 * minutes), "Angehalten: das beste bisherige Material");
      assert.equal(await page.locator("#page img").count(), 0);
      assert.match((await page.locator("h1").textContent()) ?? "", /^<\/script><img src=x onerror=alert\(1\)>"'/);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
      if (shots) await page.screenshot({ path: join(shots, "module-stopped.png"), fullPage: true });
    },
    { viewport: { width: 360, height: 740 }, locale: "de-DE" },
  ));

test("the commonest sheet becomes a confirmed card with two workers", () =>
  onPage(async (page) => {
    const begun = performance.now();
    await calibrate(page, { title: "Abrams" });
    assert.equal(await verdict(page, 60 * minutes), "The material is confirmed");
    const size = (statSync(file).size / 1e6).toFixed(1);
    console.log(`form to card: ${((performance.now() - begun) / 1000).toFixed(0)} s; the page has ${size} MB`);
    assert.equal(JSON.parse((await saved(page, "result/card.json")).content.toString()).search.status, "confirmed");
  }));
