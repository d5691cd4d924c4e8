// The page that calibrates in a browser, with a module that only waits: node --test calibrator.test.js, with
//   PASTEFIT_CALIBRATOR  the page, built with fake.js
//   PASTEFIT_SHOTS       a folder for pictures of the page, to be looked at by a person
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { openBrowser } from "../browser.js";
import { calibrate, onPageOf, saved, verdict } from "./on_page.js";

/** @typedef {import("../browser.js").OpenedPage} OpenedPage */

const { PASTEFIT_CALIBRATOR: file = "", PASTEFIT_SHOTS: shots = "" } = process.env;
const hostile = `</script><img src=x onerror=alert(1)>"'&lt;\u202egnp`;

/** @type {import("playwright-core").Browser} */
let browser;
before(async () => {
  browser = await openBrowser();
});
after(async () => browser.close());

/** @type {(use: (page: OpenedPage) => Promise<void>, options?: object) => Promise<void>} */
const onPage = (use, options) => onPageOf(browser, file, use, options);

test("a sheet becomes a card, with two workers", () =>
  onPage(async (page) => {
    await calibrate(page, { title: "slow mix" });
    await page.locator("#run").waitFor();
    assert.match(await page.locator("#run").innerText(), /Slump \[mm\]\s+181\.7\s+180/);
    await page.locator(".latest svg").waitFor();
    if (shots) await page.screenshot({ path: join(shots, "calibrator-run.png"), fullPage: true });
    assert.equal(await verdict(page), "The material is confirmed");
    const focused = () => document.activeElement?.id;
    assert.equal(await page.evaluate(focused), "verdict-heading");
    assert.equal(await page.frameLocator("iframe.report").locator("body").innerText(), "slow mix\ndrawn");
    if (shots) await page.screenshot({ path: join(shots, "calibrator-result.png"), fullPage: true });
  }));

test("the report opens in a tab of its own, too", () =>
  onPage(async (page) => {
    await calibrate(page);
    await verdict(page);
    const [tab] = await Promise.all([
      page.context().waitForEvent("page"),
      page.getByRole("button", { name: "Open the report in a tab of its own" }).click(),
    ]);
    assert.equal(await tab.locator("body").innerText(), "mix 7\ndrawn");
  }));

test("every file can be saved, and all of them as one archive", () =>
  onPage(async (page) => {
    await calibrate(page);
    assert.equal(await verdict(page), "The material is confirmed");
    const card = await saved(page, "result/card.json");
    assert.equal(card.name, "card.json");
    assert.match(card.content.toString(), /"pastefit-card-6"/);
    await page.getByText("LAMMPS deck").click();
    assert.equal((await saved(page, "in.lammps")).content.toString(), "# lammps\n");
    assert.deepEqual(Object.keys(unzipSync((await saved(page, "LAMMPS deck, as .zip")).content)), [
      "mix-7-lammps/in.lammps",
      "mix-7-lammps/README.txt",
    ]);
    await page.getByText("Yade scripts").click();
    await page.getByText("has no such law").waitFor();
    const all = unzipSync((await saved(page, "Everything as one .zip")).content);
    const names = Object.keys(all);
    for (const name of ["lab.json", "study.json", "result/card.json", "result/summary.txt", "result/report.html"])
      assert.ok(names.includes(`mix-7/${name}`), name);
    assert.ok(names.includes("mix-7/edem-notes/in.edem-notes"));
    assert.ok(!names.some((name) => name.includes("yade")));
    assert.match(strFromU8(all["mix-7/lab.json"]), /"slump": "180, 175, 190"/);
  }));

test("each fault stands at its field, and a value that is right can be confirmed", () =>
  onPage(async (page) => {
    await calibrate(page, { density: "2.35", slump: "18x" });
    const list = page.locator("#faults");
    await list.waitFor();
    assert.equal(await list.locator("h3").textContent(), "2 to correct");
    assert.match((await page.locator("#field-slump-fault").textContent()) ?? "", /not a number/);
    assert.equal(await page.locator("#field-slump").getAttribute("aria-invalid"), "true");
    await list.getByRole("link").nth(1).click();
    const focused = () => document.activeElement?.id;
    assert.equal(await page.evaluate(focused), "field-slump");
    await page.locator("#field-slump").fill("180");
    await page.getByRole("button", { name: "This value is correct" }).click();
    assert.equal(await verdict(page), "The material is confirmed");
  }));

test("a number that the page reads itself is checked like the others", () =>
  onPage(async (page) => {
    await page.locator("details summary").first().click();
    await calibrate(page, { seed: "1.5" });
    await page.getByText("seed: is not a whole number of 1 or more").waitFor();
    assert.ok(await page.locator("#field-seed-fault").isVisible());
  }));

test("after Stop the best so far is the result, and Resume goes on from there", () =>
  onPage(async (page) => {
    await calibrate(page, { title: "slow mix" });
    await page.getByText(/[3-9] of at most 12/).waitFor();
    await page.getByRole("button", { name: "Stop" }).click();
    assert.equal(await verdict(page), "Stopped: the best material so far");
    await page.getByRole("button", { name: "Resume" }).click();
    await page.getByText(/(?:[3-9]|1\d) of at most 12/).waitFor();
    assert.equal(await verdict(page), "The material is confirmed");
  }));

test("a reload in the middle of a calibration loses nothing", () =>
  onPage(async (page) => {
    await calibrate(page, { title: "slow mix" });
    await page.getByText(/[4-9] of at most 12/).waitFor();
    await page.reload();
    await page.getByText(/interrupted after [4-9] simulations/).waitFor();
    await page.getByRole("button", { name: "Continue slow mix" }).click();
    await page.getByText(/(?:[4-9]|1\d) of at most 12/).waitFor();
    assert.equal(await verdict(page), "The material is confirmed");
    await page.reload();
    await page.getByRole("button", { name: "Show slow mix" }).click();
    assert.equal(await verdict(page), "The material is confirmed");
    await page.getByRole("button", { name: "New sheet" }).click();
    await page.getByRole("button", { name: "Remove slow mix" }).click();
    await page.locator("#saved").waitFor({ state: "detached" });
  }));

test("a worker that dies is replaced, and its task asked again", () =>
  onPage(async (page) => {
    await calibrate(page, { title: "killer mix" });
    await page.getByText(/[2-9] workers ended and were replaced\./).waitFor(); // more while the page looks
    assert.equal(await verdict(page), "The material is confirmed");
  }));

test("a saved folder is opened, and a study that is refused says why", () =>
  onPage(async (page) => {
    const files = (/** @type {string} */ title) =>
      ["lab", "study"].map((kind) => ({
        name: `${kind}.json`,
        mimeType: "application/json",
        buffer: Buffer.from(`// ${kind}\n{"format": "pastefit-${kind}-1", "title": "${title}"}`),
      }));
    await page.locator("#files").setInputFiles(files("refused")[0]);
    await page.getByText("Choose both files").waitFor();
    await page.locator("#files").setInputFiles(files("refused"));
    await page.getByText("lab.json: title: is refused; another title").waitFor();
    await page.locator("#files").setInputFiles(files("of a folder"));
    assert.equal(await verdict(page), "The material is confirmed");
    assert.equal(await page.locator("h1").textContent(), "of a folder");
  }));

test("a hostile title is text everywhere", () =>
  onPage(async (page) => {
    await calibrate(page, { title: hostile });
    assert.equal(await verdict(page), "The material is confirmed");
    assert.equal(await page.locator("h1").textContent(), hostile);
    assert.equal(await page.locator("#page img").count(), 0);
    assert.equal((await saved(page, "Everything as one .zip")).name, "script-img-src-x-onerror-alert-1-lt-gnp.zip");
    await page.reload();
    assert.equal(await page.locator(".saved strong").textContent(), hostile);
  }));

test("the page speaks German to who reads German, and either language when it is chosen", () =>
  onPage(
    async (page) => {
      assert.equal(await page.locator("#sheet-heading").textContent(), "Messblatt");
      assert.equal(await page.locator("html").getAttribute("lang"), "de");
      await page.locator("#field-density").fill("2350");
      await page.locator("header select").selectOption("en");
      assert.equal(await page.locator("#sheet-heading").textContent(), "Measuring sheet");
      assert.equal(await page.locator("#field-density").inputValue(), "2350");
      await page.locator("header select").selectOption("de");
      await calibrate(page);
      assert.equal(await verdict(page), "Das Material ist bestätigt");
    },
    { locale: "de-AT" },
  ));

test("each mould has its own questions", () =>
  onPage(async (page) => {
    assert.equal(await page.locator("#field-height2").count(), 0);
    await page.locator("#field-mould").selectOption("hinged-plate");
    assert.equal(await page.locator("#field-height2").count(), 1);
    await page.locator("#field-mould").selectOption("astm-c1437");
    assert.equal(await page.locator("#field-flow").count(), 1);
    await page.locator("#field-mould").selectOption("own");
    for (const [name, value] of Object.entries({ base: "8", top: "4", moulded: "12" }))
      await page.locator(`#field-${name}`).fill(value);
    await page.locator("#field-lengthUnit").selectOption("in");
    assert.match((await page.locator(".mould-drawing").textContent()) ?? "", /203\.2 mm/);
    await calibrate(page, { slump: "7 1/4, 7" });
    assert.equal(await verdict(page), "The material is confirmed");
    const lab = (await saved(page, "lab.json")).content.toString();
    assert.match(lab, /"mould": "8\/4\/12 in"/);
    assert.match(lab, /"slump": "7 1\/4, 7 in"/);
  }));

test("the page fits a phone of 360 pixels", () =>
  onPage(
    async (page) => {
      const wide = () => document.documentElement.scrollWidth;
      assert.ok((await page.evaluate(wide)) <= 360);
      if (shots) await page.screenshot({ path: join(shots, "calibrator-phone.png"), fullPage: true });
      await calibrate(page, { title: "slow mix" });
      await page.getByText(/[2-9] of at most 12/).waitFor();
      assert.ok((await page.evaluate(wide)) <= 360);
      if (shots) await page.screenshot({ path: join(shots, "calibrator-phone-run.png"), fullPage: true });
      assert.equal(await verdict(page), "The material is confirmed");
      assert.ok((await page.evaluate(wide)) <= 360);
    },
    { viewport: { width: 360, height: 740 } },
  ));

test("the form is filled in and sent by the keyboard alone", () =>
  onPage(async (page) => {
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter"); // to the content
    await page.locator("#field-title").focus();
    await page.keyboard.type("typed");
    for (let k = 0; k < 2; ++k) await page.keyboard.press("Tab");
    await page.keyboard.type("2350");
    for (let k = 0; k < 3; ++k) await page.keyboard.press("Tab");
    await page.keyboard.type("180");
    await page.keyboard.press("Enter");
    assert.equal(await verdict(page), "The material is confirmed");
    assert.equal(await page.locator("h1").textContent(), "typed");
  }));
