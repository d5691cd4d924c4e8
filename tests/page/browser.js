// A page in Debian's Chromium, drawn by software, as the tests look at it.
import { existsSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

/** @typedef {import("playwright-core").Browser} Browser */
/** @typedef {import("playwright-core").Page} Page */
/** @typedef {Page & {faults: string[], requests: string[], own: string}} OpenedPage what failed, what it asked for */

const chromiumPath = ["/usr/bin/chromium-headless-shell", "/usr/bin/chromium"].find(existsSync);

export async function openBrowser() {
  return chromium.launch({
    executablePath: chromiumPath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
}

/**
 * Opens a file; what goes wrong there is kept in `faults`, what it asks of a network in `requests`.
 * @param {Browser} browser
 * @param {string} file
 * @param {import("playwright-core").BrowserContextOptions} options
 * @param {(page: Page) => Promise<unknown>} prepare is given the page before it is opened
 * @returns {Promise<OpenedPage>}
 */
export async function openPage(browser, file, options = {}, prepare = async () => {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const own = pathToFileURL(file).href;
  const page = await context.newPage();
  /** @type {string[]} */
  const faults = [];
  /** @type {string[]} */
  const requests = [];
  page.on("console", (message) => {
    const ofDriver = /GPU stall|GL Driver/.test(message.text());
    if (["error", "warning"].includes(message.type()) && !ofDriver) faults.push(message.text());
  });
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("request", (request) => requests.push(request.url()));
  page.on("dialog", (dialog) => {
    faults.push(`a dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  await prepare(page);
  await page.goto(own);
  return Object.assign(page, { faults, requests, own });
}

/**
 * Until the film of a page is there; in milliseconds since the page was asked for.
 * @param {Page} page
 */
export async function filmIsThere(page) {
  const isDrawn = () => document.getElementsByClassName("player")[0]?.player?.scene.pictures > 0;
  await page.waitForFunction(isDrawn, null, { timeout: 60_000 });
  return page.evaluate(() => performance.now());
}

/**
 * Two pictures later, so that what was asked for is drawn.
 * @param {Page} page
 */
export async function drawn(page) {
  await page.evaluate(async () => {
    for (let k = 0; k < 3; ++k) await new Promise(requestAnimationFrame);
  });
}

/**
 * What the canvas shows: how many different colours, and a number that another picture hardly has too.
 * @param {Page} page
 */
export async function pixels(page) {
  return page.evaluate(() => {
    const { canvas } = document.getElementsByClassName("player")[0].player;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext("2d"));
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    /** @type {Map<number, number>} */
    const colours = new Map();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colours.set(colour, (colours.get(colour) ?? 0) + 1);
      sum = (sum * 31 + colour) % 2147483647;
    }
    const ground = Math.max(...colours.values());
    return { colours: colours.size, drawn: 1 - ground / (data.length / 4), sum };
  });
}

/**
 * What the program wrote into a page.
 * @param {OpenedPage} page
 * @returns {Promise<import("../../calibrate/report/page/source/content.js").CardContent>}
 */
export async function contentOf(page) {
  return JSON.parse((await page.locator("#content").textContent()) ?? "");
}

/**
 * Takes WebGL from a page that is not opened yet.
 * @param {Page} page
 */
export const withoutWebGL = (page) =>
  page.addInitScript(() => {
    const contextOf = HTMLCanvasElement.prototype.getContext;
    Object.assign(HTMLCanvasElement.prototype, {
      /** @param {string} kind */
      getContext(kind) {
        return kind.startsWith("webgl") ? null : Reflect.apply(contextOf, this, arguments);
      },
    });
  });
