// Every heap that confirms a material beside the others, each over what the laboratory measured.
import { element } from "./dom.js";
import { edge, laboratoryMarks, size, sketched, sketchScale } from "./sketch.js";
import { svgLine, svgPicture } from "./svg.js";

/** @typedef {import("./content.js").Drawing} Drawing */
/** @typedef {import("./content.js").Line} Line */
/** @typedef {import("./content.js").Point} Point */

/** @type {(line: Line) => boolean} */
const isSheared = ({ by }) => by === "rejected";

/**
 * The lines of single heaps, in the order of their packings.
 * @param {Pick<Drawing, "lines">} drawing
 */
export function heapsOf({ lines }) {
  return lines.filter(({ by, packing }) => packing !== undefined && ["run", "rejected"].includes(by));
}

/**
 * The measured outline with its deviation; of a heap that was not outlined, height and width.
 * @param {Drawing} drawing
 * @param {(point: Point) => [x: number, y: number]} at
 */
function measuredMarks({ lines, lengths }, at) {
  const outline = lines.find(({ by, name }) => by === "laboratory" && name.includes("outline"));
  if (!outline)
    return laboratoryMarks(
      lengths.filter(({ by }) => by === "laboratory"),
      at,
    );
  const { points, deviation } = outline;
  /** @type {(off: number) => Point[]} */
  const moved = (off) => points.map(([x, y]) => [x, y + off]);
  const band = sketched("polygon", [...moved(deviation), ...moved(-deviation).reverse()], at, "allowed");
  return [...(deviation > 0 ? [band] : []), sketched("polyline", points, at, "read")];
}

/**
 * @param {Line} heap
 * @param {Drawing} drawing
 * @param {(point: Point) => [x: number, y: number]} at
 */
function heapPicture(heap, drawing, at) {
  const [left, right] = [edge, size[0] - edge];
  const ground = at([0, 0])[1];
  const own = sketched("polyline", heap.points, at, "own");
  const marks = [svgLine([left, ground], [right, ground], "bounds"), own, ...measuredMarks(drawing, at)];
  const state = isSheared(heap) ? ", sheared off" : "";
  const picture = svgPicture(size, "sketch", `heap of packing ${heap.packing}${state}, over the laboratory's`, marks);
  return element(
    "li",
    { class: isSheared(heap) ? "sheared" : null },
    picture,
    element(
      "span",
      {},
      `packing ${heap.packing}`,
      isSheared(heap) ? element("strong", {}, " \u2717 sheared off") : null,
    ),
  );
}

/**
 * Null of a drawing that shows no heaps.
 * @param {Drawing} drawing
 */
export function heapsSheet(drawing) {
  const heaps = heapsOf(drawing);
  if (heaps.length === 0) return null;
  const measured = drawing.lines.filter(({ by }) => by === "laboratory").flatMap(({ points }) => points);
  const ends = drawing.lengths.filter(({ by }) => by === "laboratory").flatMap(({ first, last }) => [first, last]);
  const at = sketchScale([...heaps.flatMap(({ points }) => points), ...measured, ...ends], true);
  const sheared = heaps.filter(isSheared).length;
  const said = `${heaps.length} heaps one by one, ${sheared || "none"} sheared off; dashed: the laboratory's`;
  return element(
    "details",
    { class: "heaps", open: true },
    element("summary", {}, said),
    element("ul", {}, ...heaps.map((heap) => heapPicture(heap, drawing, at))),
  );
}
