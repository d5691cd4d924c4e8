// The page that calibrates with its real module: node --test module.test.js, with
//   PASTEFIT_CALIBRATOR  the page
//   PASTEFIT_SHOTS       a folder for pictures of the page, to be looked at by a person
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { openBrowser } from "../browser.js";
import { calibrate, onPageOf, saved, verdict } from "./on_page.js";

/** @typedef {import("../browser.js").OpenedPage} OpenedPage */

const { PASTEFIT_CALIBRATOR: file = "", PASTEFIT_SHOTS: shots = "" } = process.env;
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
 * Until so many simulations are done.
 * @param {OpenedPage} page
 * @param {number} count
 */
const simulated = (page, count) =>
  page.waitForFunction(
    (least) => Number(/(\d+) of at most/.exec(document.querySelector("#run")?.textContent ?? "")?.[1] ?? 0) >= least,
    count,
    { timeout: 3 * minutes },
  );

test("a measured concrete becomes a confirmed card with two workers, and its files are whole", () =>
  onPage(async (page) => {
    const begun = performance.now();
    await calibrate(page, { title: "Abrams" });
    assert.equal(await verdict(page, 10 * minutes), "The material is confirmed");
    const size = (statSync(file).size / 1e6).toFixed(1);
    console.log(`form to card: ${((performance.now() - begun) / 1000).toFixed(0)} s; the page has ${size} MB`);
    await page.frameLocator("iframe.report").locator("h1").waitFor();
    if (shots) await page.screenshot({ path: join(shots, "module-result.png"), fullPage: true });
    const all = unzipSync((await saved(page, "Everything as one .zip", 3 * minutes)).content);
    const card = JSON.parse(strFromU8(all["abrams/result/card.json"]));
    assert.equal(card.search.status, "confirmed");
    assert.ok(card.confirmation.meets_laboratory);
    const names = Object.keys(all);
    for (const part of ["lab.json", "study.json", "result/report.html", "lammps/in.slump", "edem-notes/"])
      assert.ok(
        names.some((name) => name.startsWith(`abrams/${part}`)),
        `${part} of ${names.join(" ")}`,
      );
  }));

test("the program's checks reach the form", () =>
  onPage(async (page) => {
    await calibrate(page, { density: "2.35", slump: "180, 140, 260" });
    await page.locator("#faults").waitFor();
    assert.match((await page.locator("#field-density-fault").textContent()) ?? "", /2\.35 kg\/l are 2350 kg\/m3/);
    await page.locator("#field-density").fill("2350");
    await page.locator("form button.main").click();
    await page.locator("#field-slump-fault").filter({ hasText: "repeatability" }).waitFor();
  }));

test("a hostile title survives a reload and a stop in the middle of a calibration", () =>
  onPage(
    async (page) => {
      await calibrate(page, { title: hostile, seed: "2" });
      await simulated(page, 3);
      await page.reload();
      await page.locator("#saved button").first().click();
      await simulated(page, 4);
      await page.locator("#run button.main").click();
      assert.equal(await verdict(page, minutes), "Stopped: the best material so far");
      assert.equal(await page.locator("h1").textContent(), hostile);
      assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 360);
      const study = JSON.parse((await saved(page, "lab.json")).content.toString().replace(/^\/\/.*$/gm, ""));
      assert.equal(study.title, hostile);
      if (shots) await page.screenshot({ path: join(shots, "module-stopped.png"), fullPage: true });
    },
    { viewport: { width: 360, height: 740 } },
  ));
