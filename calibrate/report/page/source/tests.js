// The tests themselves: film and drawings of each.
import { element, section } from "./dom.js";
import { drawingFigure } from "./drawing.js";
import { filmPlayer } from "./player.js";

/// Whether there is something to be seen between the first picture of a film and its last.
function lasts({ reels }) {
  return reels.some(({ frames }) => frames.at(-1).time_s - frames[0].time_s > 0.02);
}

function shownWords({ run_shown: shown, film }) {
  if (film && !lasts(film)) return "The grains meet between two pictures of a film: there is none.";
  if (!shown || !film) return "This test was not simulated for this page: there is no film of it.";
  const same = shown.same_as_card
    ? "It is the same run as the card's, to the last bit."
    : `Its readings are not the card's to the last bit: it was simulated by ${shown.program}, on this machine or another.`;
  return `One run with the fitted parameters, on packing ${shown.packing}. ${same} Between its pictures grains move in straight lines.`;
}

/// The drawing, its simulated lengths with the standard errors of the readings that they are.
export function withNoise(drawing, readings) {
  const error = (name) => readings.find((one) => one.name === name)?.standard_error ?? 0;
  return {
    ...drawing,
    lengths: drawing.lengths.map((one) => (one.by === "simulation" ? { ...one, deviation: error(one.reading) } : one)),
  };
}

function testPart(test, index) {
  const bytes = document.getElementById(`film-${index}`);
  return [
    test.name ? element("h3", {}, `Test ${test.name}`) : null,
    test.film && bytes && lasts(test.film) ? filmPlayer(test.film, bytes.textContent) : null,
    element("p", { class: "note" }, shownWords(test)),
    ...test.drawings.map((drawing) => drawingFigure(withNoise(drawing, test.readings))),
  ];
}

export function testsPart({ tests }) {
  return section(
    "tests",
    "The test",
    tests.some(({ film }) => film && lasts(film))
      ? "Drag to turn; click, then scroll to zoom; keys: arrows and space."
      : null,
    ...tests.flatMap(testPart),
  );
}
