import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

const root = new URL("../../../../calibrate/", import.meta.url);
const style = ["report/page/style/colours.css", "browser/page/style/form.css"]
  .map((name) => readFileSync(new URL(name, root), "utf8"))
  .join("\n");

/** @param {string} text of a style sheet; its colours by name */
const coloursIn = (text) =>
  Object.fromEntries([...text.matchAll(/--([\w-]+): (#[0-9a-f]{3,6});/g)].map((m) => [m[1], m[2]]));

const dark = [...style.matchAll(/@media \(prefers-color-scheme: dark\) \{\s*:root \{([^}]*)\}/g)]
  .map((m) => m[1])
  .join("");
const light = style.replace(/@media \(prefers-color-scheme: dark\) \{\s*:root \{[^}]*\}\s*\}/g, "");

/** Relative luminance of WCAG 2.2. @param {string} colour as #rrggbb */
function luminance(colour) {
  const [red, green, blue] = [1, 3, 5].map((place) => {
    const share = Number.parseInt(colour.slice(place, place + 2), 16) / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

/** @type {(one: string, other: string) => number} */
function contrast(one, other) {
  const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
  return (high + 0.05) / (low + 0.05);
}

/** Letters, and what they stand on: at least 4.5 (WCAG AA, 1.4.3). */
const letters = [
  ["text", "page"],
  ["text", "card"],
  ["soft", "page"],
  ["soft", "card"],
  ["simulation", "card"],
  ["simulation", "page"],
  ["card", "simulation"],
  ["bad", "card"],
  ["text", "bad-page"],
  ["text", "good-page"],
  ["text", "open-page"],
  ["soft", "good-page"],
  ["soft", "bad-page"],
  ["soft", "open-page"],
  ["simulation", "open-page"],
  ["good", "card"],
];

/** Edges of fields, and lines of drawings: at least 3 (1.4.11). */
const edges = [
  ["control", "page"],
  ["control", "card"],
  ["laboratory", "card"],
  ["apparatus", "card"],
];

for (const [name, colours] of Object.entries({ light: coloursIn(light), dark: coloursIn(dark) }))
  test(`in ${name} colours, texts and edges have the contrast of WCAG AA`, () => {
    for (const [pairs, least] of /** @type {[string[][], number][]} */ ([
      [letters, 4.5],
      [edges, 3],
    ]))
      for (const [front, back] of pairs) {
        const found = contrast(colours[front], colours[back]);
        assert.ok(found >= least, `${front} on ${back}: ${found.toFixed(2)}`);
      }
  });
