// The tests themselves: film and drawings of each.
import { element, section } from "./dom.js";
import { drawingFigure } from "./drawing.js";
import { heapsSheet } from "./heaps.js";
import { filmPlayer } from "./player.js";

/** @typedef {import("./content.js").Drawing} Drawing */
/** @typedef {import("./content.js").FilmIndex} FilmIndex */
/** @typedef {import("./content.js").Reading} Reading */
/** @typedef {import("./content.js").Test} Test */

const interval = 0.02; // [s] between two pictures of a film, as RunRecorder takes them

/**
 * Whether there is something to be seen between the first picture of a film and its last.
 * @param {FilmIndex} film
 */
export function lasts({ reels }) {
  return reels.some(({ frames }) => frames[frames.length - 1].time_s - frames[0].time_s > 1.5 * interval);
}

/** @param {Test} test */
export function filmWords({ run_shown: shown, film }) {
  if (film && !lasts(film)) return "The grains meet between two pictures of a film: there is none.";
  if (!shown || !film) return "This test was not simulated for this page: there is no film of it.";
  const same = shown.same_as_card
    ? "It is the same run as the card's, to the last bit."
    : "Its readings are not the card's to the last bit: " +
      `it was simulated by ${shown.program}, on this machine or another.`;
  return (
    `One run with the fitted parameters, on packing ${shown.packing}. ${same} ` +
    "Between its pictures grains move in straight lines."
  );
}

/**
 * The drawings of a test, their simulated lengths with the standard errors of the readings that they are.
 * @param {Pick<Test, "drawings" | "readings">} test
 * @returns {Drawing[]}
 */
export function drawingsOf({ drawings, readings }) {
  const errors = new Map(readings.map(({ name, standard_error: error = 0 }) => [name, error]));
  return drawings.map((drawing) => ({
    ...drawing,
    lengths: drawing.lengths.map((one) =>
      one.by === "simulation" ? { ...one, deviation: errors.get(one.reading) ?? 0 } : one,
    ),
  }));
}

/**
 * @param {Test} test
 * @param {number} index
 */
function testPart(test, index) {
  const bytes = document.getElementById(`film-${index}`)?.textContent;
  return [
    test.name ? element("h3", {}, `Test ${test.name}`) : null,
    test.film && bytes && lasts(test.film) ? filmPlayer(test.film, bytes) : null,
    element("p", { class: "note" }, filmWords(test)),
    ...drawingsOf(test).flatMap((drawing) => [drawingFigure(drawing), heapsSheet(drawing)]),
  ];
}

/** @param {import("./content.js").CardContent} content */
export function testsPart({ tests }) {
  const filmed = tests.some(({ film }) => film && lasts(film));
  const lead = filmed ? "Drag to turn; click, then scroll to zoom; keys: arrows and space." : null;
  return section("tests", "The test", lead, ...tests.flatMap(testPart));
}
