import assert from "node:assert/strict";
import { test } from "node:test";
import { fill, languageOf, textsOf, wordOf } from "../../../../calibrate/browser/page/source/language.js";
import { readingOf } from "../../../../calibrate/browser/page/source/sheet.js";

/**
 * {path: text} of a table of texts.
 * @param {object} table
 * @returns {[string, string][]}
 */
const listed = (table, before = "") =>
  Object.entries(table).flatMap(([name, text]) =>
    typeof text === "string" ? [[before + name, text]] : listed(text, `${before}${name}.`),
  );

test("both languages have the same texts, with the same places in them", () => {
  const places = (/** @type {string} */ text) => (text.match(/\{\w+\}/g) ?? []).sort();
  const english = new Map(listed(textsOf("en")));
  const german = new Map(listed(textsOf("de")));
  assert.deepEqual([...german.keys()], [...english.keys()]);
  for (const [name, text] of german) {
    assert.notEqual(text.trim(), "", name);
    assert.deepEqual(places(text), places(english.get(name) ?? ""), name);
  }
});

test("every reading of the form has a label and a hint", () => {
  const texts = new Map(listed(textsOf("en")));
  for (const name of [
    "slump",
    "height",
    "spread",
    "angle",
    "height2",
    "sag",
    "flow",
    "height-after",
    "shift",
    "mass",
  ]) {
    assert.ok(readingOf(name), name);
    assert.ok(texts.has(name) && texts.has(`${name}Hint`), name);
  }
});

test("the page has the first of the reader's languages that it knows, or English", () => {
  assert.equal(languageOf(["fr-FR", "de-CH", "en"]), "de");
  assert.equal(languageOf(["en-GB", "de"]), "en");
  assert.equal(languageOf(["fr"]), "en");
  assert.equal(languageOf([]), "en");
});

test("what is put into a text is not read again", () => {
  assert.equal(fill("{a} of {b}, {c}", { a: "{b}", b: "$&" }), "{b} of $&, {c}");
});

test("a word that no table has is shown as the program names it", () => {
  assert.equal(wordOf({ search: "Suche" }, "search"), "Suche");
  assert.equal(wordOf({}, "new_phase"), "new phase");
  assert.equal(wordOf({}, "constructor"), "constructor");
});
