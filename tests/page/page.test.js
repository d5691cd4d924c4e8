// The page of a calibration in a browser: node --test page.test.js, with
//   PASTEFIT_PAGE   the page of a calibration that ended
//   PASTEFIT_DROP   the page of a drop test
//   PASTEFIT_LIVE   the page of a calibration that goes on
//   PASTEFIT_PARTS  a folder with pages of folders that lack something, each NAME.html
//   PASTEFIT_SHOTS  a folder for pictures of the page, to be looked at by a person
import assert from "node:assert/strict";
import { copyFileSync, existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { contentOf, drawn, filmIsThere, openBrowser, openPage, pixels } from "./browser.js";
import { words } from "../../calibrate/report/page/source/names.js";
import { inWords } from "../../calibrate/report/page/source/sentences.js";
import { drawTest, grow, processorSeconds, shareHidden } from "./grown.js";

/** @typedef {import("./browser.js").OpenedPage} OpenedPage */

const {
  PASTEFIT_PAGE: file = "",
  PASTEFIT_DROP: dropped = "",
  PASTEFIT_LIVE: live = "",
  PASTEFIT_PARTS: parts = "",
  PASTEFIT_SHOTS: shots = "",
} = process.env;
const card = JSON.parse(readFileSync(join(file, "../card.json"), "utf8"));
/** @type {import("playwright-core").Browser} */
let browser;
/** @type {OpenedPage} */
let page;

before(async () => {
  browser = await openBrowser();
  page = await openPage(browser, file);
});
after(async () => browser.close());

test("the page loads without a fault, and asks nothing of a network", async () => {
  const ready = await filmIsThere(page);
  console.log(`film shown after ${Math.round(ready)} ms`);
  assert.deepEqual(page.faults, []);
  assert.deepEqual(
    page.requests.filter((url) => !url.startsWith("data:") && !url.startsWith("blob:")),
    [page.own],
  );
  assert.equal(await page.locator(".notice").filter({ hasText: "could not be drawn" }).count(), 0);
});

test("a request that somebody puts into the page is refused", async () => {
  const refused = await page.evaluate(() =>
    fetch("https://example.org/").then(
      () => false,
      () => true,
    ),
  );
  assert.ok(refused);
  page.faults.length = 0;
});

test("the page says what the card says", async () => {
  const content = await contentOf(page);
  assert.equal(await page.locator("h1").textContent(), card.title);
  for (const { name, value } of content.parameters) assert.equal(value, card.material.parameters[name] ?? value, name);
  assert.match(await page.locator("#type-in").innerText(), /Damping of each pair: force 2 sqrt\(5\/6\) beta .* G\* a/);
  const readings = card.tests[0].readings;
  assert.deepEqual(content.tests[0].readings.map((one) => one.name).sort(), Object.keys(readings).sort());
  for (const reading of content.tests[0].readings) {
    assert.equal(reading.simulated, readings[reading.name].simulated);
    assert.equal(reading.measured ?? null, readings[reading.name].measured);
  }
  assert.deepEqual(content.tests[0].run_shown, {
    packing: card.confirmation.packings[0],
    program: content.program,
    same_as_card: true,
  });
  assert.equal(content.search.history.filter((point) => point.confirmation).length, card.confirmation.packings.length);
  const free = await page.locator("#parameters tbody tr").count();
  assert.equal(free, Object.keys(card.material.free).length);
});

test("the film opens on the heap, and plays from the beginning of the test", async () => {
  const state = () =>
    page.evaluate(() => {
      const { player } = document.getElementsByClassName("player")[0];
      return {
        time: player.time,
        end: player.film.end,
        lift: player.film.phases().find(({ name }) => name === "step1.lift")?.begin ?? 0,
      };
    });
  const opened = await state();
  assert.equal(opened.time, opened.end);
  await page.locator(".play").click();
  await page.locator(".play").click();
  const played = await state();
  assert.ok(played.time >= played.lift && played.time < played.end, `${played.time} s`);
});

test("the scene draws, plays, turns and is sliced", async () => {
  const first = await pixels(page);
  assert.ok(first.colours > 50, `${first.colours} colours`);
  assert.ok(first.drawn > 0.1, `${first.drawn} of the picture is drawn`);
  await page.evaluate(() => {
    const { player } = document.getElementsByClassName("player")[0];
    player.show(player.opening);
  });
  await page.locator(".play").click();
  const state = () =>
    page.evaluate(() => {
      const { player } = document.getElementsByClassName("player")[0];
      return { time: player.time, pictures: player.scene.pictures, now: performance.now() };
    });
  const begun = await state();
  await page.waitForTimeout(1500);
  const goesOn = (/** @type {number} */ time) => document.getElementsByClassName("player")[0].player.time > time;
  await page.waitForFunction(goesOn, begun.time);
  const later = await state();
  console.log(`${(((later.pictures - begun.pictures) * 1e3) / (later.now - begun.now)).toFixed(1)} pictures a second`);
  assert.ok(later.time > begun.time);
  await page.locator(".play").click();
  await drawn(page);
  const played = await pixels(page);
  assert.notEqual(played.sum, first.sum);
  await page.locator(".toggle input").check();
  await drawn(page);
  const sliced = await pixels(page);
  assert.notEqual(sliced.sum, played.sum);
  await page.locator("canvas.stage").focus();
  await page.keyboard.press("ArrowLeft");
  await drawn(page);
  assert.notEqual((await pixels(page)).sum, sliced.sum);
  const seen = new Set();
  const colour = page.locator("label.choice", { hasText: "Colour" }).locator("select");
  const kinds = await colour
    .locator("option")
    .evaluateAll((options) => options.map((option) => option.getAttribute("value")));
  assert.deepEqual(kinds, ["height", "speed", "coordination", "pull"]);
  for (const kind of kinds) {
    await colour.selectOption(kind);
    await drawn(page);
    seen.add((await pixels(page)).sum);
  }
  assert.equal(seen.size, kinds.length, "every colouring is a picture of its own");
  assert.deepEqual(page.faults, []);
});

test("ten thousand grains are drawn ten times in a processor second, those behind others left out unseen", async () => {
  const other = await openPage(browser, file);
  await filmIsThere(other);
  const grains = await grow(other, 10_000);
  await drawn(other);
  for (const { most, ...looked } of [
    { view: "slanted", sliced: false, share: 0, most: 0.5 },
    { view: "slanted", sliced: true, share: 0.4, most: 0.5 },
    { view: "top", sliced: false, share: 1, most: 0.9 },
    { view: "side", sliced: true, share: 1, most: 0.7 },
    { view: "front", sliced: false, share: 0.7, most: 0.7 },
  ]) {
    const { lost, drawn: part } = await shareHidden(other, looked);
    const view = `${looked.view}${looked.sliced ? ", sliced" : ""}`;
    const percent = (100 * part).toFixed(0);
    console.log(`${view}: ${percent} % of the grains drawn, ${(1e6 * lost).toFixed(0)} of a million pixels differ`);
    assert.ok(lost < 1e-3, `${view}: ${lost} of the pixels are not what they are with all grains`);
    assert.ok(part < most, `${view}: ${part} of the grains are drawn`);
  }
  await other.evaluate(() => {
    const { scene } = document.getElementsByClassName("player")[0].player;
    scene.look("slanted");
    scene.slice(false);
  });
  await drawTest(other, 10); // until it is warm
  const begun = processorSeconds();
  const pictures = 40;
  await drawTest(other, pictures);
  const each = (processorSeconds() - begun) / pictures;
  console.log(`${grains} grains: ${(1e3 * each).toFixed(0)} processor ms a picture`);
  assert.ok(each < 0.1, `${each} processor seconds a picture`);
  assert.deepEqual(other.faults, []);
  await other.context().close();
});

test("every phase of the test is in the film", async () => {
  const phases = await page
    .locator(".phases button")
    .evaluateAll((buttons) => buttons.map((button) => button.getAttribute("data-phase")));
  // Of a few coarse grains none may stand out above the rim: then there is nothing to strike off.
  const lasting = phases.filter((phase) => phase !== "fill.strike");
  assert.deepEqual(lasting, ["fill.grow", "fill.sink", "fill.rest", "fill.settle", "step1.lift", "step1.rest"]);
});

test("every plot has its data", async () => {
  const content = await contentOf(page);
  const count = (/** @type {string} */ selector) => page.locator(selector).count();
  assert.ok((await count(".test-drawing svg path")) >= 5);
  assert.ok((await count(".test-drawing svg text")) >= 4);
  assert.ok((await count("#law svg path")) >= content.law.length);
  const marks = await page
    .locator("#search .with-card svg g[aria-label=dot] path, #search .with-card svg g[aria-label=dot] circle")
    .count();
  assert.ok(marks >= content.search.history.length, `${marks} marks of ${content.search.history.length} simulations`);
  assert.equal(await count("#open svg g[aria-label=rect] rect"), content.search.map?.miss.length);
  assert.ok((await count("#open tbody tr")) >= 1);
});

test("hovering shows a candidate, and so do the arrow keys", async () => {
  const plot = page.locator("#search .with-card svg.history");
  await page.mouse.move(0, 0); // so that no dot comes to lie under it
  await plot.scrollIntoViewIfNeeded();
  const shown = page.locator(".candidate");
  const first = await shown.innerText();
  assert.match(first, /confirmation/, "a confirmed run is shown to begin with");
  assert.match(first, /Misfit [\d.]+ mm\n/, "the misfit has its unit");
  const dot = plot.locator("g[aria-label=dot]").first().locator("path, circle").first();
  const { x, y, width, height } = (await dot.boundingBox()) ?? assert.fail("there is no dot");
  await page.mouse.move(x + 30, y + 30);
  await page.mouse.move(x + width / 2, y + height / 2);
  const isOther = (/** @type {string} */ text) =>
    /** @type {HTMLElement} */ (document.getElementsByClassName("candidate")[0]).innerText !== text;
  await page.waitForFunction(isOther, first);
  assert.match(await shown.innerText(), /Simulation \d+/);
  assert.ok((await page.locator(".candidate-picture circle").count()) > 0);
  const heap = (await page.locator(".candidate-picture.sketch polyline.own").getAttribute("points")) ?? "";
  assert.ok(heap.split(" ").length > 20, heap);
  assert.equal(await page.locator(".candidate-picture.sketch .read").count(), 1, "the height that was measured");
  await page.locator(".with-card").focus();
  await page.keyboard.press("ArrowRight");
  assert.match(await shown.innerText(), /Simulation \d+/);
});

/** @type {Record<string, import("playwright-core").BrowserContextOptions>} */
const windows = {
  light: { colorScheme: "light" },
  dark: { colorScheme: "dark" },
  phone: { colorScheme: "light", viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 },
};
for (const [name, options] of Object.entries(windows))
  test(`the page fits its window: ${name}`, async () => {
    const other = await openPage(browser, file, options);
    await filmIsThere(other);
    await drawn(other);
    const [wide, window] = await other.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(wide <= window, `${wide} pixels in a window of ${window}`);
    if (shots) await other.screenshot({ path: join(shots, `${name}.png`), fullPage: true });
    assert.deepEqual(other.faults, []);
    await other.context().close();
  });

test(
  "a test without a heap has drawings of its own, and no film of what is over at once",
  { skip: !dropped },
  async () => {
    const other = await openPage(browser, dropped);
    await other.locator(".test-drawing svg").first().waitFor();
    assert.deepEqual(await other.locator(".test-drawing strong").allTextContents(), [
      "Drop on the level plate",
      "Drop on the plate tilted by 40 degrees",
    ]);
    assert.ok((await other.locator(".test-drawing svg path").count()) >= 6);
    assert.equal(await other.locator(".player").count(), 0);
    if (shots) await other.screenshot({ path: join(shots, "drop.png"), fullPage: true });
    assert.deepEqual(other.faults, []);
    await other.context().close();
  },
);

const sheet = { width: 703, height: 1032 }; // A4 less 12 mm on each side, in CSS pixels

/**
 * On paper: height of the certificate, of the parts behind it, and the number of sheets.
 * @param {string} name
 * @param {OpenedPage} paper
 */
async function printed(name, paper) {
  await paper.emulateMedia({ media: "print" });
  await drawn(paper);
  const [first, all] = await paper.evaluate(() => [
    document.getElementById("certificate")?.getBoundingClientRect().height ?? 0,
    document.body.scrollHeight,
  ]);
  const pdf = await paper.pdf({ preferCSSPageSize: true, ...(shots ? { path: join(shots, `${name}.pdf`) } : {}) });
  return { first, rest: all - first, sheets: [...pdf.toString("latin1").matchAll(/\/Type\s*\/Page\b/g)].length };
}

test("on paper the page begins with one sheet to hand over, with answer and numbers", async () => {
  const paper = await openPage(browser, file, { viewport: sheet });
  await filmIsThere(paper);
  assert.equal(await paper.locator("#certificate").isVisible(), false, "on a screen there is none");
  const { first, rest, sheets } = await printed("print", paper);
  assert.ok(first <= sheet.height, `the certificate is ${first} pixels high, a sheet ${sheet.height}`);
  const [content, certificate] = [inWords(await contentOf(paper)), await paper.locator("#certificate").innerText()];
  const wanted = [
    `NOT CONFIRMED: ${content.verdict.unconfirmed}`,
    content.title,
    String(new Date().getFullYear()),
    content.provenance.program,
    content.provenance.study_hash,
    ...content.verdict.reservations,
    ...content.type_in.map(({ title }) => title),
    ...content.type_in.flatMap(({ rows }) => rows.map(({ quantity, value }) => `${quantity}\t${value}`)),
  ];
  for (const one of wanted) assert.ok(certificate.includes(one), one);
  assert.ok(!certificate.includes("Signature"), "what is not confirmed is not signed");
  const measured = content.tests[0].readings.filter((one) => one.measured !== undefined);
  assert.equal(
    await paper.locator("#certificate .packing").count(),
    measured.length * card.confirmation.packings.length,
  );
  assert.ok((await paper.locator("#certificate .sheet-drawing path").count()) >= 5);
  assert.equal(await paper.locator("nav").isVisible(), false);
  assert.ok(
    sheets <= 1 + Math.ceil((1.3 * rest) / sheet.height),
    `${sheets} sheets for ${rest / sheet.height} sheets full behind the first`,
  );
  if (shots) await paper.screenshot({ path: join(shots, "print.png"), fullPage: true });
  assert.deepEqual(paper.faults, []);
  await paper.context().close();
});

test(
  "the sheet of a confirmed material with two drawings is one as well, to be signed",
  { skip: !dropped },
  async () => {
    const paper = await openPage(browser, dropped, { viewport: sheet });
    const { first } = await printed("print-drop", paper);
    assert.ok(first <= sheet.height, `the certificate is ${first} pixels high, a sheet ${sheet.height}`);
    assert.equal(await paper.locator("#certificate .sheet-drawing").count(), 2);
    assert.match(await paper.locator("#certificate").innerText(), /^(?!.*NOT CONFIRMED).*Signature/s);
    await paper.context().close();
  },
);

test("every reading shows its error in the table, that of its difference as well", async () => {
  const content = await contentOf(page);
  const measured = content.tests.flatMap(({ readings }) => readings.filter((one) => one.measured !== undefined));
  for (const { name, standard_error: error = 0 } of measured) {
    if (error === 0) continue;
    const row = page.locator("#readings tr", { hasText: words(name) }).first();
    const cells = await row.locator("td").allTextContents();
    assert.match(cells[1], /\u00b1/, name);
    assert.match(cells[3], /\u00b1/, name);
  }
});

test(
  "the page of a calibration that goes on shows how far it is, and looks again by itself",
  { skip: !live },
  async () => {
    const other = await openPage(browser, live, {}, (one) => one.clock.install());
    await other.locator("#verdict.goes").waitFor();
    assert.ok((await other.locator("#search .history path, #search .history circle").count()) > 0);
    if (shots) await other.screenshot({ path: join(shots, "live.png"), fullPage: true });
    copyFileSync(file, live); // as the calibration does it when it ends
    await other.clock.fastForward(11_000);
    await other.locator("#verdict:not(.goes) h1").waitFor();
    assert.equal(await other.locator("h1").textContent(), card.title);
    assert.deepEqual(other.faults, []);
    await other.context().close();
  },
);

test("yield stresses are the card's, and beside a measured one they are multiples of it", async () => {
  const stresses = (await contentOf(page)).tests[0].yield_stress ?? {};
  const rows = page.locator(".yield-stress tbody tr");
  assert.equal(await rows.count(), Object.keys(stresses).length);
  assert.ok((await rows.count()) > 0);
  assert.equal(await page.locator(".yield-stress thead th").count(), 3);
  const other = await openPage(browser, join(parts, "vane.html"));
  await other.locator(".yield-stress").waitFor();
  assert.match((await other.locator(".yield-stress caption").textContent()) ?? "", /measured 400 \u00b1 50 Pa/);
  const { simulated } = stresses["step1.height_mm"];
  const told = await other.locator(".yield-stress tbody tr").first().locator("td").last().textContent();
  assert.match(told ?? "", new RegExp(`^\u00d7 ${Number((simulated / 400).toPrecision(2))} \\(`));
  await other.context().close();
});

for (const name of existsSync(parts) ? readdirSync(parts).filter((one) => /(?<!^report)\.html$/.test(one)) : [])
  test(`a page of what is not whole says what is missing and shows the rest: ${name}`, async () => {
    const other = await openPage(browser, join(parts, name));
    await other.locator("h1").waitFor();
    await drawn(other);
    if (name === "interrupted.html")
      assert.match(await other.locator("#verdict, #missing").allTextContents().then(String), /stopped|no card/);
    else if (name !== "hostile.html") assert.ok((await other.locator("#missing li").count()) > 0);
    if (name === "hostile.html") {
      assert.equal(
        await other.locator("h1").textContent(),
        "</script><script>alert(1)</script><img src=x onerror=alert(2)> &lt;b&gt;",
      );
      assert.equal(await other.locator("h1 *").count(), 0);
    }
    assert.equal(await other.locator(".notice").filter({ hasText: "could not be drawn" }).count(), 0);
    if (shots) await other.screenshot({ path: join(shots, `${name}.png`), fullPage: true });
    assert.deepEqual(other.faults, []);
    await other.context().close();
  });
