// What came of a simulation as a small picture: its heap from the side, or its curve.
import { svgLine, svgPicture, svgElement } from "./svg.js";

/** @typedef {import("./content.js").Length} Length */
/** @typedef {import("./content.js").Point} Point */
/** @typedef {import("./content.js").Search} Search */
/** @typedef {import("./content.js").Simulation} Simulation */

/** @type {[number, number]} */
export const size = [220, 90];
export const edge = 10;
const [width, height] = size;

/**
 * Places in the picture of points of one test, which all have one scale. Zero is in it; a heap is drawn to scale.
 * @param {Point[]} points
 * @param {boolean} heap
 * @returns {(point: Point) => [x: number, y: number]}
 */
export function sketchScale(points, heap) {
  /** @param {0 | 1} axis */
  const range = (axis) => [
    Math.min(0, ...points.map((one) => one[axis])),
    Math.max(0, ...points.map((one) => one[axis])),
  ];
  const [left, right] = range(0);
  const [low, high] = range(1);
  let across = (width - 2 * edge) / (right - left || 1);
  let up = (height - 2 * edge) / (high - low || 1);
  if (heap) across = up = Math.min(across, up);
  const margin = (width - across * (right - left)) / 2;
  return ([x, y]) => [margin + across * (x - left), height - edge - up * (y - low)];
}

/** @param {[number, number][]} places */
const listed = (places) => places.map((place) => place.map((one) => one.toFixed(1)).join(",")).join(" ");

/**
 * A line through points of a test, or the area that it encloses.
 * @param {"polyline" | "polygon"} tag
 * @param {Point[]} points
 * @param {(point: Point) => [x: number, y: number]} at
 * @param {string} kind its class
 */
export function sketched(tag, points, at, kind) {
  return svgElement(tag, { points: listed(points.map(at)), class: kind });
}

/**
 * What the laboratory read: its first height as a line across, its first width as marks at both ends.
 * @param {Length[]} lengths
 * @param {(point: Point) => [x: number, y: number]} at
 */
export function laboratoryMarks(lengths, at) {
  const upright = lengths.find(({ first, last }) => first[0] === last[0]);
  const level = lengths.find(({ first, last }) => first[0] !== last[0]);
  const marks = [];
  if (upright) {
    const y = at(upright.last)[1];
    marks.push(svgLine([edge, y], [width - edge, y], "read"));
  }
  for (const end of level ? [level.first, level.last] : []) {
    const [x, y] = at(end);
    marks.push(svgLine([x, y], [x, y - 0.3 * (height - 2 * edge)], "read"));
  }
  return marks;
}

/**
 * Thin: that of a confirmed run, and what the laboratory read of a heap.
 * @param {Simulation} simulation
 * @param {Search} search
 */
export function sketchOf({ sketch, test, number }, { history, laboratory = {} }) {
  if (!sketch) return null;
  const { heap, points } = sketch;
  const ofTest = history.filter((one) => one.sketch && one.test === test);
  const at = sketchScale(
    ofTest.flatMap((one) => one.sketch?.points ?? []),
    heap,
  );
  const confirmed = ofTest.find((one) => one.confirmation);
  const measured = heap ? laboratoryMarks(laboratory[test ?? ""] ?? [], at) : [];
  const [, ground] = at([0, 0]);
  /** @type {Element[]} */
  const marks = [svgLine([edge, ground], [width - edge, ground], "bounds")];
  if (heap) {
    /** @type {Point[]} */
    const feet = [points[points.length - 1], points[0]].map(([x]) => [x, 0]);
    marks.push(sketched("polygon", [...points, ...feet], at, "heap"));
  }
  marks.push(sketched("polyline", points, at, "own"));
  if (confirmed?.sketch && confirmed.number !== number)
    marks.push(sketched("polyline", confirmed.sketch.points, at, "fitted"));
  const label =
    `its ${heap ? "heap from the side" : "curve"}${confirmed ? "; thin: a confirmed one" : ""}` +
    (measured.length > 0 ? "; dashed: the laboratory's height and width" : "");
  return svgPicture(size, "candidate-picture sketch", label, [...marks, ...measured]);
}
