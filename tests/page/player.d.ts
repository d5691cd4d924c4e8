// What the page leaves on the element of a film for its tests.
interface Element {
  player: import("../../calibrate/report/page/source/player.js").Player;
}
