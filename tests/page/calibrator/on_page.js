// How tests use the page that calibrates.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { openPage } from "../browser.js";

/** @typedef {import("../browser.js").OpenedPage} OpenedPage */

/**
 * The page with its form; it is closed after `use`, and has to be without a fault and without a request.
 * @param {import("playwright-core").Browser} browser
 * @param {string} file
 * @param {(page: OpenedPage) => Promise<void>} use
 * @param {import("playwright-core").BrowserContextOptions} options
 */
export async function onPageOf(browser, file, use, options = {}) {
  const page = await openPage(browser, file, { locale: "en-GB", ...options });
  await page.locator("form").waitFor();
  await use(page);
  assert.deepEqual(page.faults, []);
  const asked = page.requests.filter((url) => !/^(?:data|blob|about):/.test(url) && url !== page.own);
  assert.deepEqual(asked, []);
  await page.context().close();
}

/**
 * Fills the form in and begins.
 * @param {OpenedPage} page
 * @param {Record<string, string>} values
 */
export async function calibrate(page, values = {}) {
  const sheet = { title: "mix 7", density: "2350", slump: "180, 175, 190", spread: "330", workers: "2", ...values };
  for (const [name, value] of Object.entries(sheet)) await page.locator(`#field-${name}`).fill(value);
  await page.locator("form button.main").click();
}

/** @param {OpenedPage} page */
export const verdict = (page, timeout = 20_000) => page.locator("#verdict strong").textContent({ timeout });

/**
 * What a click has the browser save.
 * @param {OpenedPage} page
 * @param {string} name of the button
 */
export async function saved(page, name, timeout = 30_000) {
  const [download] = await Promise.all([
    page.waitForEvent("download", { timeout }),
    page.getByRole("button", { name, exact: true }).click(),
  ]);
  return { name: download.suggestedFilename(), content: readFileSync(await download.path()) };
}
