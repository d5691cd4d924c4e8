// A page in Debian's Chromium, drawn by software, as the tests look at it.
import { existsSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const chromiumPath = ["/usr/bin/chromium-headless-shell", "/usr/bin/chromium"].find(existsSync);

export async function openBrowser() {
  return chromium.launch({
    executablePath: chromiumPath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
}

/// Opens a file; what goes wrong there is kept in `page.faults`, what it asks of a network in `page.requests`. `prepare` is
/// given the page before it is opened.
export async function openPage(browser, file, options = {}, prepare = async () => {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  page.faults = [];
  page.requests = [];
  page.on(
    "console",
    (message) =>
      ["error", "warning"].includes(message.type()) &&
      !/GPU stall|GL Driver/.test(message.text()) &&
      page.faults.push(message.text()),
  );
  page.on("pageerror", (error) => page.faults.push(String(error)));
  page.on("request", (request) => page.requests.push(request.url()));
  page.on("dialog", (dialog) => {
    page.faults.push(`a dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  await prepare(page);
  const url = pathToFileURL(file).href;
  await page.goto(url);
  page.own = url;
  return page;
}

/// Until the film of a page is there; in milliseconds since the page was asked for.
export async function filmIsThere(page) {
  await page.waitForFunction(() => document.querySelector(".player")?.player?.scene.pictures > 0, null, {
    timeout: 60_000,
  });
  return page.evaluate(() => performance.now());
}

/// Two pictures later, so that what was asked for is drawn.
export async function drawn(page) {
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))),
  );
}

/// What the canvas shows: how many different colours, and a number that another picture hardly has too.
export async function pixels(page) {
  return page.evaluate(() => {
    const canvas = document.querySelector("canvas.stage"),
      copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
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
