// The tests themselves: film and drawings of each.
import { element, section } from "./dom.js";
import { drawingFigure } from "./drawing.js";
import { filmPlayer } from "./player.js";

function shownWords({ run_shown: shown, film }) {
  if (!shown || !film) return "This test was not simulated for this page: there is no film of it.";
  const same = shown.same_as_card ? "It is the same run as the card's, to the last bit." : "Its readings are not the card's to the last bit: it was simulated by another program or on another machine.";
  return `One run with the fitted parameters, packing ${shown.packing}, simulated for this page. ${same} Between its pictures grains move in straight lines.`;
}

function testPart(test, index) {
  const bytes = document.getElementById(`film-${index}`);
  return [
    test.name ? element("h3", {}, `Test ${test.name}`) : null,
    test.film && bytes ? filmPlayer(test.film, bytes.textContent) : null,
    element("p", { class: "note" }, shownWords(test)),
    ...test.drawings.map(drawingFigure),
  ];
}

export function testsPart({ tests }) {
  return section("tests", "The test", "Drag to turn; click, then scroll to zoom; keys: arrows and space.", ...tests.flatMap(testPart));
}
